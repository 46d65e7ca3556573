// Scripts as text files that a person reads and edits: rules with named parameters. The language: planning_app/scripts/SCRIPTS.md.
#pragma once

#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "motion/machine_model.hpp"
#include "motion/script.hpp"

namespace berm::app {

// what(): "FILE: line N: reason", one line; without a line where the file as a whole is wrong.
class ScriptError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// What the planner provides for a script, and what it has to find in it.
struct ScriptVocabulary {
  struct Parameter { std::string name; Joint joint; };  // an angle of that joint, rad
  struct NeededMark { Joint joint; RuleMark mark; };    // in this order within a joint

  std::string name;                    // of the script
  std::vector<Parameter> parameters;
  std::uint32_t events = event_none;   // that can happen while it runs
  std::vector<NeededMark> marks;
};

class ScriptText {
public:
  // A file of at most 64 KiB. Throws ScriptError.
  static ScriptText read(const std::string& file, const ScriptVocabulary& vocabulary);
  static ScriptText parse(std::string_view text, const std::string& file, const ScriptVocabulary& vocabulary);

  // values: one for each parameter of the vocabulary, in its order, rad. side: 1 when the truck stands to the left of the dig, else -1.
  Script bind(std::span<const double> values, double side) const;
  double pace_of(Joint joint, RuleMark mark) const;            // of the rule with this mark; 1 without
  std::size_t rules_of(Joint joint) const { return rules_[joint].size(); }
  std::vector<bool> used() const;                              // of the vocabulary's parameters: a rule names it

private:
  friend class ScriptParser;
  enum class Relation { above, below, rises_above, falls_below, beyond, back_past, near };
  struct Operand { int parameter = -1; double offset = 0.0; };  // rad; parameter -1: the offset alone
  struct TextCondition { Joint joint; Relation relation; Operand threshold; double tolerance; };
  struct TextRule {
    std::string name;
    std::vector<TextCondition> conditions;
    std::uint32_t events = event_none;
    Operand goal;
    double pace = 1.0;
    RuleMark mark = RuleMark::none;
  };

  std::size_t parameters_ = 0;
  std::array<std::vector<TextRule>, joints> rules_;
};

// The rule whose goal lies outside its joint's range by more than the measurement's error, in words; empty when there is none.
std::string goal_out_of_range(const MachineModel& machine, const Script& script);

// swing, boom, stick, bucket.
const char* joint_name(std::size_t joint);

}  // namespace berm::app
