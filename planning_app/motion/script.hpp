// Parameterised scripts (stentz-1999, 4.4 and Figure 14). Each joint has its own script: a list of rules with conditions on joint angles and
// events at the left and a joint goal at the right. From start on exactly one rule of each joint is active; rules advance in order only.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "motion/angles.hpp"

namespace berm::app {

// What happened besides joint motion. Bits, so that several can hold at once.
enum Event : std::uint32_t {
  event_none = 0,
  event_emptied = 1,  // the bucket has let its load go
  event_weighed = 2,  // it holds no more than it may, or what it holds does not matter yet
  event_empties = 4,  // what is still in it will have left before the swing has gone far
  event_scanned = 8,  // the scanner that leads the coming swing is as far ahead as the swing needs
};

struct Condition {
  enum class Relation {
    above,        // angle > threshold
    below,        // angle < threshold
    falls_below,  // angle < threshold after having been at or above it since the rule before became active, or having been stopped
    rises_above,  // the mirror of falls_below
    near          // |angle - threshold| <= tolerance
  };
  Joint joint = swing;
  Relation relation = Relation::above;
  double threshold = 0.0;
  double tolerance = 0.0;
  bool since_start = false;  // a crossing may have been seen from its other side before the rule's turn, since the script's start
};

// What the app has to know of a rule besides its motion.
enum class RuleMark {
  none,
  leaves,   // the swing goes to the truck
  extends,  // boom or stick reaches out to the spill point
  opens,    // the bucket opens over the bed
  returns   // the swing goes back to the dig
};

struct Rule {
  std::string name;
  std::vector<Condition> conditions;    // all must hold
  std::uint32_t events = event_none;    // all must have happened
  double goal = 0.0;
  double pace = 1.0;                    // share of the joint's speed limit: gentle where a fast stop would reach too far
  RuleMark mark = RuleMark::none;
};

// The script of one joint. The first rule becomes active at the start ("when digging finishes"); its conditions are not looked at.
class JointScript {
public:
  JointScript() = default;
  explicit JointScript(std::vector<Rule> rules) : rules_(std::move(rules)) {}

  void start();
  // Motion was not the script's for a while, after a stop: a joint may have passed what the next rules wait for, and will not come back to pass it again.
  // From now on a crossing need not be seen from its other side.
  void interrupted() { interrupted_ = true; }
  // The rules whose turn has not come wait for what those of another binding of the same script wait for. Nothing else changes: goals, paces, the active rule.
  // A crossing whose threshold comes sooner now has to be seen from its other side anew.
  void wait_as(const JointScript& other);
  // One pass: activates the next rule when its left-hand side holds; at most one step a pass.
  void evaluate(const Joints& angle, std::uint32_t events);

  // Whether with this event besides the next rule would become active, and without it does not.
  bool waits_only_for(Event event, const Joints& angle, std::uint32_t events) const;

  bool running() const { return active_ >= 0; }
  int active() const { return active_; }  // -1 before the start
  bool at_last() const { return active_ + 1 == static_cast<int>(rules_.size()); }
  // Whether the rule with this mark is active, or has been.
  bool reached(RuleMark mark) const;
  // Whether the active rule waited for this joint's angle: what it does then is meant for how that joint moves.
  bool waited_for(Joint joint) const;
  double pace() const { return rules_[static_cast<std::size_t>(active_)].pace; }
  double goal() const { return rules_[static_cast<std::size_t>(active_)].goal; }
  const std::vector<Rule>& rules() const { return rules_; }

private:
  void look(const Joints& angle);
  bool next_holds(const Joints& angle, std::uint32_t events) const;

  std::vector<Rule> rules_;
  bool interrupted_ = false;
  std::vector<std::vector<bool>> armed_;  // of each rule's conditions: a crossing has been seen from its other side
  int active_ = -1;
};

class Script {
public:
  Script() = default;
  explicit Script(std::array<JointScript, joints> scripts) : scripts_(std::move(scripts)) {}

  void start();
  void interrupted();
  void wait_as(const Script& other);
  void evaluate(const Joints& angle, std::uint32_t events);  // at a fixed rate
  bool running() const { return scripts_[swing].running(); }
  Joints goals() const;
  Joints paces() const;
  const JointScript& of(Joint joint) const { return scripts_[joint]; }
  // Every joint's last rule is active.
  bool at_last() const;

private:
  std::array<JointScript, joints> scripts_;
};

}  // namespace berm::app
