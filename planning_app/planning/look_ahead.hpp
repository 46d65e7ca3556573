// Simulates the running script from where the machine is, a few seconds ahead, against the map as it is now. Where it will be blocked rules that have not fired
// are made to wait longer; where that does not help the motion is slowed.
#pragma once

#include <optional>
#include <vector>

#include "planning/later_rules.hpp"

namespace berm::app {

class LookAhead {
public:
  static constexpr double ahead_s = 2.5;    // looked at
  static constexpr double period_s = 0.15;  // from one look to the next

  // machine and scripts must outlive it.
  LookAhead(const MachineModel& machine, const ScriptSet& scripts);

  // Of a pass: what its script was bound with.
  struct Pass {
    PassTask task;
    PassPoses poses;
    PassThresholds thresholds;
  };
  struct Now {
    double time_s = 0.0;
    const Script* script = nullptr;     // runs
    const ArmController* arm = nullptr; // as it has heard the kernel in this cycle
    Joints angle{}, velocity{};
    PassCourse course;
    const Pass* pass = nullptr;         // else nothing but the paces can be changed
    const Skyline* skyline = nullptr;
  };
  struct Foreseen {
    double seconds = 0.0;               // ahead
    Skyline::Blocking by;
    PassPart part = PassPart::to_truck;
  };
  struct Change {
    enum class What { later, slowed, full_pace } what = What::full_pace;
    Foreseen foreseen;                  // not of full_pace
    LaterRules rules;                   // later: to be bound and waited for
  };

  // Another script begins, at its full pace.
  void begin();
  // Something else moves the machine, or it stands: what was begun to be looked at is not looked at to its end.
  void rest() { stage_ = Stage::waits; }
  // Once a cycle while the script moves the machine. Works on a part of a simulation, so that no cycle is late.
  std::optional<Change> step(const Now& now);

  const PaceShares& shares() const { return shares_; }
  bool slows() const { return shares_ != PaceShares{}; }
  double slows_for_s(double time_s) const { return slows() ? time_s - slows_from_s_ : 0.0; }

private:
  enum class Stage { waits, looks, tries_later, tries_slower, tries_standing, tries_full };
  enum class Judged { goes_on, clear, blocked };
  struct Demand { double from_s, to_s, slack, swing_off; };  // looked at from, to; m beyond the kernel's margin; rad that a stop may reach less far
  void simulate(const Now& now, const Script& script, const PaceShares& shares, const Demand& demand, Stage stage);
  Judged go_on(const Now& now);
  void try_next(const Now& now);
  std::optional<Change> judged(const Now& now, Judged found);
  std::optional<Change> slow(const Now& now, const PaceShares& shares);
  double proof_s(double share) const;

  const MachineModel* machine_;
  const ScriptSet* scripts_;
  PassSimulation simulation_;
  Demand demand_{};
  Foreseen found_, first_;
  std::vector<LaterRules> later_;
  std::size_t candidate_ = 0;
  PaceShares tried_, shares_;
  Stage stage_ = Stage::waits;
  double next_s_ = 0.0, slows_from_s_ = 0.0;
  int blocked_looks_ = 0, clear_looks_ = 0;  // in a row; clear: at full pace, while it is slowed
};

}  // namespace berm::app
