// Points both scanners so that the ground under the coming motion has been seen, densely and lately enough, before the machine gets there: the sensor motion
// planner (stentz-1999, 3; leger-1998, 2.4).
//
// Each scanner sweeps a sector back and forth; the sector follows the work phase. The rate is held so that pan and swing together turn the
// scanline by no more than azimuth_rate in the base frame. How far the scanner that leads a swing is ahead of it comes from a LookaheadTable.
#pragma once

#include <array>
#include <cstdint>

#include "motion/machine_model.hpp"
#include "perception/lookahead_table.hpp"

namespace berm::app {

struct PanRequest { double goal = 0.0, rate = 0.0; };        // rad relative to the upper body, rad/s
struct PanSector { double low = 0.0, high = 0.0; };          // rad, relative to the upper body

// What is known of the swing that comes next, or goes on.
struct ComingSwing {
  double begins_in_s = 1e9;     // at the soonest; far off: not known
  double reach_m = 0.0;         // the implements' farthest point meanwhile
};

// The scanner that leads the swing that comes next, or goes on: pans towards its side, rad.
struct Lead {
  std::size_t scanner = 0;
  double ahead = 0.0;           // its pan
  LookaheadTable::Angles needed;
  double required = 0.0;        // for the swing's speed now
  bool triggered = false;       // it is so far out, and on its way, that the swing may begin
};

class ScanScheduler {
public:
  static constexpr double azimuth_rate = LookaheadTable::azimuth_rate;
  static constexpr double look_rate = radians(30.0);

  explicit ScanScheduler(const MachineModel& machine);

  // Both scanners sweep their whole range once, and count again from now.
  void begin_full_sweep();
  // Both have seen their whole range since begin_full_sweep, or since the motion was slowed.
  bool full_sweep_done() const;
  bool swept(std::size_t scanner) const { return head_[scanner].low_seen && head_[scanner].high_seen; }  // this one

  // Sweeps one scanner over these bearings (base frame) once, from the end that is nearer, slowly enough for the truck recogniser (a scanline a degree);
  // the other sees the ground on the way to the dig, from under the boom outwards: what is near the machine's feet there the boom hides once it digs. Until
  // end_look the scanner then stays where it came to.
  void begin_look(std::size_t scanner, const PanSector& bearings);
  // The same on the way to a dig: hurries to the end that is farther from straight ahead, and keeps to the rate over the ground while the machine swings.
  void begin_look_on_the_way(std::size_t scanner, const PanSector& bearings);
  void end_look() { look_ = Look::none; }
  bool look_sweeps() const { return look_ == Look::sweeps; }
  bool look_done() const { return look_ == Look::done; }
  // Since begin_look the other scanner has been under the boom.
  bool feet_seen() const { return feet_seen_; }

  // How hard an empty swing was learned to brake (SwingBraking): the table is made anew where it is noticeably another. Takes some milliseconds then.
  void learn_braking(double empty_brake);
  // As of the last step.
  const Lead& lead() const { return lead_; }

  // phase: BERM_PHASE_*, the one the motion is about to enter where that is known (LIFT while a full bucket curls); bearings of dig and truck; measured pans, swing angle and speed.
  // slowed: the motion is let out slowly for long, and both sweep their whole ranges meanwhile, on the swing to the dig the one on the dig's side towards its
  // end there first; during a look at the truck the other keeps to the way to the dig. As soon as it is slow no more, over the truck or on the swing back,
  // the scanner on the dig's side hurries to its end there and stays until the swing has carried it past what lies beyond the dig: from over the truck it does not
  // reach so far, and what it saw there before the swing out is old by then.
  std::array<PanRequest, 2> step(std::uint16_t phase, double dig_bearing, double truck_bearing, double swing_angle, double swing_speed,
                                 const std::array<double, 2>& pan, bool slowed = false, const ComingSwing& coming = {});

private:
  struct Head { bool up = true; bool low_seen = false, high_seen = false; };
  // Bearings that are to be seen anew, all of them, by one sweep without a gap.
  struct Stretch {
    double from = 0.0, to = 0.0;
    bool seen = false;
    void begin(double bearing) { from = to = bearing, seen = false; }
    void look(double bearing, const PanSector& wanted);
  };

  PanSector sector(std::size_t scanner, std::uint16_t phase, double dig_bearing, double truck_bearing, double swing_angle) const;
  void plan_lead(std::uint16_t phase, double dig_bearing, double truck_bearing, double swing_angle, double swing_speed, const ComingSwing& coming);
  void note_bed(std::size_t scanner, double truck_bearing, double swing_angle, double pan);
  void note_face(std::size_t scanner, double dig_bearing, double truck_bearing, double swing_angle, double pan);
  PanRequest look(double swing_angle, double swing_speed, double pan);
  bool end_beyond_dig_seen(std::size_t scanner) const;
  PanSector end_beyond_dig(std::size_t scanner) const;
  void note_seen(std::size_t scanner, double pan, bool goes_beyond, double beyond_dig_by);
  PanSector beside_look(std::size_t scanner, double dig_bearing, double truck_bearing, double swing_angle) const;
  PanSector to_pans(std::size_t scanner, const PanSector& bearings, double swing_angle) const;

  MachineModel machine_;
  LookaheadTable table_;
  Lead lead_;
  double inner_ = 0.0;      // end of the leading scanner's sector, as lead_.ahead
  std::uint16_t phase_ = 0; // of the step before
  std::array<Head, 2> head_;
  enum class Look { none, goes, sweeps, done } look_ = Look::none;
  std::size_t looker_ = 0;
  PanSector look_bearings_;
  bool look_up_ = true, look_on_the_way_ = false;
  bool was_slowed_ = false;  // the whole sweep is one for slowness
  double at_end_s_ = 0.0;    // waits at the end beyond the dig
  bool feet_seen_ = false;
  bool far_seen_ = false;  // during this swing to the truck the leading scanner has seen the ground beyond the truck
  Stretch bed_, face_;      // as the scanner that does not lead has seen them during this swing
  double left_at_ = 0.0;    // where the swing to the truck began
  bool face_bare_ = false;  // it has left the face
};

}  // namespace berm::app
