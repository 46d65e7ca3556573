// Whatever the joints do: from the start on exactly one rule of each joint is active, and rules advance one at a time, in order.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "motion/script.hpp"

namespace {

using namespace berm::app;
using Relation = Condition::Relation;

JointScript any_script() {
  std::vector<Rule> rules(static_cast<std::size_t>(*rc::gen::inRange(1, 6)));
  double goal = 0.0;
  for (Rule& rule : rules) {
    rule.goal = goal++;
    rule.events = *rc::gen::inRange(0, 4) == 0 ? event_emptied : event_none;
    rule.conditions.resize(static_cast<std::size_t>(*rc::gen::inRange(0, 3)));
    for (Condition& c : rule.conditions) {
      c.joint = static_cast<Joint>(*rc::gen::inRange(0, 4));
      c.relation = static_cast<Relation>(*rc::gen::inRange(0, 5));
      c.threshold = *rc::gen::inRange(-10, 11) * 0.1;
      c.tolerance = 0.2;
    }
  }
  return JointScript(rules);
}

RC_GTEST_PROP(Script, ExactlyOneRuleActiveAndInOrder, ()) {
  Script script({any_script(), any_script(), any_script(), any_script()});
  RC_ASSERT(!script.running());
  script.start();
  std::array<int, joints> before{};
  for (std::size_t j = 0; j < joints; ++j) {
    before[j] = script.of(static_cast<Joint>(j)).active();
    RC_ASSERT(before[j] == 0);
  }
  const int passes = *rc::gen::inRange(1, 60);
  for (int k = 0; k < passes; ++k) {
    Joints q{};
    for (double& a : q) a = *rc::gen::inRange(-12, 13) * 0.1;
    script.evaluate(q, *rc::gen::inRange(0, 2) ? event_emptied : event_none);
    for (std::size_t j = 0; j < joints; ++j) {
      const JointScript& s = script.of(static_cast<Joint>(j));
      RC_ASSERT(s.active() == before[j] || s.active() == before[j] + 1);
      RC_ASSERT(s.active() < static_cast<int>(s.rules().size()));
      RC_ASSERT(script.goals()[j] == s.rules()[static_cast<std::size_t>(s.active())].goal);
      before[j] = s.active();
    }
  }
}

}  // namespace
