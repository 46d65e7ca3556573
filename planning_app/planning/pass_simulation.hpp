// Script, controllers and joint models run together, cycle by cycle, from a given state on: where the motion of a script leads.
#pragma once

#include "planning/pass_script.hpp"

namespace berm::app {

// Of the paces of a script's rules, what is kept to.
struct PaceShares {
  double swing = 1.0, arm = 1.0;
  bool operator==(const PaceShares&) const = default;
  Joints of(const Joints& paces) const { return {swing * paces[app::swing], arm * paces[boom], arm * paces[stick], arm * paces[bucket]}; }
};

// What a simulation takes for given besides the joints.
struct PassCourse {
  double carried_kg = 0.0;             // in the bucket, until the swing goes back to the dig
  double brake_empty = 0.0;            // rad/s2, PassTask's: of the swing with nothing in the bucket
  double dump_bucket = 0.0;            // angle of the bucket that is open
  std::uint32_t events = event_none;   // that have happened, and stay so
  PaceShares shares{};                 // what waited for the swing is slowed with it
};

// One cycle: evaluate(), and then advance(). Between the two the state may be looked at: the rules are those of this cycle.
class PassSimulation {
public:
  // machine must outlive it.
  explicit PassSimulation(const MachineModel& machine);

  // From where the joints are measured to be; script and controllers as they are by now, with the commands under way.
  void begin(const Script& script, const ArmController& arm, const Joints& angle, const Joints& velocity, const PassCourse& course);
  void evaluate();
  // Whether this is a cycle in which the reach box is to be checked: a stop reaches over more than what is moved between two of them.
  bool to_be_checked() const { return cycle_ % check_every == 0; }
  // False when the script is at its last rules and everything stands at its goals.
  bool advance();

  const Joints& angle() const { return angle_; }
  const Joints& velocity() const { return velocity_; }
  double seconds() const { return cycle_ * machine_->cycle; }  // since begin
  const Script& script() const { return script_; }
  const ArmController& arm() const { return arm_; }
  bool extends() const { return script_.of(stick).reached(RuleMark::extends); }
  bool returns() const { return script_.of(swing).reached(RuleMark::returns); }
  ReachIntervals box() const { return preview(*machine_, angle_, velocity_); }
  // What of a skyline blocks the machine here, but for what no threshold helps against. Near its range's end a joint is slowed by itself, whenever it comes
  // there: a bucket that opens far for what sticks in it comes there in every pass. Beside the truck stands its cab: how fast the swing goes towards it with
  // folded implements is the kernel's to say, which slows it smoothly. What the arm meets of its own body it meets however late the swing begins: the guard
  // slows the arm.
  std::optional<Skyline::Blocking> blocking(const Skyline& skyline, const ReachIntervals& box, double slack = Skyline::own_slack) const;

private:
  static constexpr int script_every = 2;   // cycles: 50 Hz
  static constexpr int check_every = 5;
  std::uint32_t events();

  const MachineModel* machine_;
  ArmController arm_;
  std::array<JointModel, joints> model_;
  Script script_;
  PassCourse course_;
  Joints angle_{}, velocity_{};
  double open_s_ = 0.0;
  int cycle_ = 0;
};

}  // namespace berm::app
