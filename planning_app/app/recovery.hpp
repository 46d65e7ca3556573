// What to do while the kernel does not permit motion: hold; and when it is the ground that stopped the machine and stays blocked, look again
// with both scanners and retreat slowly, which the kernel permits when the slow motion's own box is clear. From ground that has not been seen for too
// long, which the implements hide themselves, the retreat goes on until it is seen: wherever it ends before, to stand is not permitted. Where standing
// is permitted and moving is not, attempts follow one another at growing pauses; then the implements swing back, for they hide what stands behind and
// beside them and the map keeps what it once held there, and the scanners look from there. While what is too high to pass over still stands in the map
// another attempt would be another stop: it is looked at instead, for as long as that may help. What none of this mends is the operator's: who is told
// what to do, once for each thing that keeps it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/observation.hpp"
#include "app/progress_log.hpp"

namespace berm::app {

// What the newest map shows where the machine is kept.
struct PlaceInMap {
  bool too_high = false;  // what stands at Recovery::too_high() is still so high
  bool unseen = false;    // at Recovery::unseen(), or next to it, is ground that was never seen or too long ago
};

class Recovery {
public:
  explicit Recovery(const MachineModel& machine) : machine_(machine) {}

  struct Advice {
    bool in_charge = false;   // velocity below is to be requested in place of the plan's
    Joints velocity{};
    bool rescan = false;      // just now: begin a full sweep
    bool resumed = false;     // just now: the plan is in charge again
    bool moved = false;       // with resumed: the implements were moved meanwhile, by the app or by hand
    bool operator_called = false;  // just now
  };
  Advice step(const Observation& o, const ProgressLog& log, const PlaceInMap& in_map = {});

  struct Place { double x, y; };
  // Of the ground that keeps the machine, or last did, if it is too high to pass over; if it was not seen, or too long ago.
  std::optional<Place> too_high() const { return over_high_ ? std::optional(Place{blocked_x_, blocked_y_}) : std::nullopt; }
  std::optional<Place> unseen() const { return unseen_at_; }

private:
  Joints retreat(const Observation& o, double blocked_s) const;
  Joints short_of_range(Joints v, const Observation& o) const;
  bool call_operator(const Observation& o, const ProgressLog& log);
  void begin_stop(const Observation& o, const ProgressLog& log);
  Advice running(const Observation& o, const ProgressLog& log);
  bool moved_by_hand(const Observation& o) const;
  bool retreating(const Observation& o) const;
  double way_back(const Observation& o) const;
  void hand_back(const Observation& o, const ProgressLog& log, Advice& advice);
  void kept_by_ground(const Observation& o);
  bool swing_back(const Observation& o, Advice& advice);
  void look_again(const Observation& o, Advice& advice);

  MachineModel machine_;
  bool stopped_ = false;
  bool handed_back_ = true;      // the plan is in charge
  bool moved_ = false;
  PlaceInMap in_map_;            // newest
  std::vector<std::string> told_;   // advices that the operator was given in this trouble
  std::uint32_t blocked_eyes_ = 0;      // in this trouble; one half covered is judged blocked and well by turns
  bool waits_for_reset_ = false;        // the newest of them was for a stop that latches
  Joints stopped_at_{};          // rad
  double since_s_ = -1.0;        // begin of the trouble: a stop and those soon after it; negative: none yet
  double dust_s_ = -1.0, other_s_ = -1.0;  // when dust, or anything but the ground, held the machine last; negative: not in this trouble
  double stop_s_ = 0.0, running_s_ = 0.0, handed_back_s_ = 0.0;
  double pause_s_ = 0.0;         // of standing permitted, before the plan is in charge again
  double next_rescan_s_ = 0.0;
  Joints retreat_{};
  double blocked_x_ = 0.0, blocked_y_ = 0.0;  // of the last stop
  bool over_high_ = false;                    // it was for what is too high to pass over
  std::optional<Place> unseen_at_;            // where ground that was not seen, or too long ago, keeps the machine, or last did
  enum class Back { none, swings, looks } back_ = Back::none;
  double next_back_s_ = 0.0, back_began_s_ = 0.0, back_from_ = 0.0, back_way_ = 0.0;
  double came_ = 0.0;                         // the way of the plan's last swing: 1, -1; 0: none yet
};

}  // namespace berm::app
