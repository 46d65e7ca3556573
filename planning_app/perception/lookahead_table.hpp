// How far a scanner has to be panned ahead of a swing, and how far already before the swing begins, so that whatever the implements can still reach has been
// seen (leger-1998, 2.4 and Figure 5): tables by the swing's length, made once from how the machine answers and interpolated by the length.
//
// Measured: the braking angles (the machine file's table, which the kernel foresees stops by, too), how the swing takes up speed (the file's step responses,
// where it has them; else what it promises), and how hard an empty swing brakes (SwingBraking, from landings; the table is made anew when that changes).
// From the file: the latencies, with the pans' among them, and the pans' largest speeds. How fast a pan takes up speed no file says: it has the latencies'
// time for it.
#pragma once

#include <array>
#include <vector>

#include "motion/machine_model.hpp"

namespace berm::app {

class LookaheadTable {
public:
  // Of a scanline in the base frame, pan and swing together: at 30 scanlines a second that is the spacing of the lines on the ground.
  static constexpr double azimuth_rate = radians(38.0);

  // Pans from straight ahead towards where the swing goes, rad. lookahead: the largest that any moment of the swing needs; trigger: what has to be reached
  // before the swing begins, for a pan that then goes on outward is at each moment as far as that moment needs.
  struct Angles { double lookahead = 0.0, trigger = 0.0; };

  // empty_brake: rad/s2, what the landings of an empty swing are planned with at least; 0: nothing was learned.
  explicit LookaheadTable(const MachineModel& machine, double empty_brake = 0.0);

  // The left scanner leads swings to the left, the right one those to the right. length: of the swing, rad; reach_m: the implements' meanwhile.
  Angles of(std::size_t scanner, double length, double reach_m) const;
  // At a swing speed (rad/s): over all that the kernel's reach box covers if the swing is stopped now.
  double required(std::size_t scanner, double speed, double reach_m) const;
  // What a pan that moves inward still goes on after it was told to turn.
  double turn_way() const { return azimuth_rate * pan_dead_time_; }
  double empty_brake() const { return empty_brake_; }

  // The pan's speed that keeps to azimuth_rate while the swing turns the upper body; direction: of the pan, 1 or -1.
  static double pan_rate(const ScannerMount& mount, double direction, double swing_speed);

private:
  struct Reach {
    double most_m = 0.0;           // of the implements
    std::vector<double> required;  // by speed
    std::vector<Angles> angles;    // by length
  };
  Reach tabulated(const MachineModel& machine, std::size_t scanner, double reach_m) const;
  std::vector<Angles> simulated(const MachineModel& machine, std::size_t scanner, const Reach& reach) const;
  const Reach& row(std::size_t scanner, double reach_m) const;
  double required_of(const Reach& reach, double speed) const;

  double empty_brake_, fastest_, pan_dead_time_;
  std::array<std::vector<Reach>, 2> rows_;  // by scanner: by the braking table's reaches
};

}  // namespace berm::app
