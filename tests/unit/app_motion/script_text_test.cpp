// Scripts as text: what a file may say, and what it is refused for.
#include <gtest/gtest.h>

#include <cmath>

#include "app_bench/bench_machine.hpp"
#include "sample_script.hpp"
#include "scratch.hpp"

namespace {

using namespace berm::app;
using namespace berm::app::test;

std::string refusal(const std::string& text) {
  try {
    parsed(text);
  } catch (const ScriptError& error) {
    return error.what();
  }
  return "accepted";
}

std::string edited(const std::string& from, const std::string& to) {
  std::string text = good;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return refusal(text.replace(at, from.size(), to));
}

TEST(ScriptText, BindsParametersAndTurnsRoundWithTheTruck) {
  const std::vector<double> values{radians(96.0), 0.6, -1.5, -0.4};
  for (const double side : {1.0, -1.0}) {
    const Script script = parsed(good).bind(values, side);
    const auto& swings = script.of(swing).rules();
    ASSERT_EQ(swings.size(), 3U);
    EXPECT_EQ(swings[1].name, "go");
    EXPECT_EQ(swings[1].goal, values[0]);
    EXPECT_EQ(swings[1].pace, 0.5);
    EXPECT_EQ(swings[1].mark, RuleMark::leaves);
    EXPECT_EQ(swings[1].conditions[0].threshold, values[1] - radians(2.0));
    EXPECT_EQ(swings[1].conditions[1].relation, side > 0.0 ? Condition::Relation::falls_below : Condition::Relation::rises_above);
    EXPECT_TRUE(swings[1].conditions[1].since_start);
    EXPECT_FALSE(swings[1].conditions[0].since_start);
    EXPECT_EQ(swings[2].events, static_cast<std::uint32_t>(event_emptied));
    EXPECT_EQ(swings[2].goal, values[0] + radians(1.5));
    const auto& buckets = script.of(bucket).rules();
    EXPECT_EQ(buckets[1].goal, radians(-30.0));
    EXPECT_EQ(buckets[1].conditions[0].relation, side > 0.0 ? Condition::Relation::above : Condition::Relation::below);
    EXPECT_EQ(buckets[1].conditions[1].tolerance, radians(3.0));
  }
  EXPECT_EQ(parsed(good).pace_of(swing, RuleMark::leaves), 0.5);
  EXPECT_THROW(parsed(good).bind(std::vector<double>{0.0}, 1.0), std::invalid_argument);
}

TEST(ScriptText, RefusalsNameLineAndWhatIsAllowed) {
  EXPECT_EQ(edited("goal high\n", "goal hihg\n"), "my.script: line 8: no parameter 'hihg' (of the boom: high)");
  EXPECT_EQ(edited("goal high\n", "goal out\n"), "my.script: line 8: 'out' is no angle of the boom (of the boom: high)");
  EXPECT_EQ(edited("pace 0.5", "pace 1.5"), "my.script: line 5: pace '1.5' (allowed: 0.05 .. 1)");
  EXPECT_EQ(edited("within 3 deg", "within 3"), "my.script: line 13: tolerance has no unit (allowed: deg)");
  EXPECT_EQ(edited("event emptied", "event weighed"), "my.script: line 6: no event 'weighed' in this script (allowed: emptied)");
  EXPECT_EQ(edited("swing beyond", "swing past"), "my.script: line 13: no comparison 'past' (allowed: above, below, rises_above, falls_below, beyond, back_past, near)");
  EXPECT_EQ(edited("stick near", "stick beyond"), "my.script: line 13: 'beyond' is for the swing alone");
  EXPECT_EQ(edited("joint boom", "joint arm"), "my.script: line 7: joint 'arm' (allowed: swing, boom, stick, bucket)");
  EXPECT_EQ(edited("joint boom", "joint swing"), "my.script: line 7: joint 'swing' stands twice");
  EXPECT_EQ(edited("script pass", "script dump"), "my.script: line 2: script 'dump', must be 'pass'");
  EXPECT_EQ(edited(" mark returns", ""), "my.script: joint swing has no rule with the mark 'returns'");
  EXPECT_EQ(edited("mark returns", "mark opens"), "my.script: line 6: mark 'opens' has no meaning for the swing of this script");
  EXPECT_EQ(edited("joint stick\nrule \"out\" : goal out\n", ""), "my.script: joint stick has no rules");
  EXPECT_EQ(edited("\"up\" :", "\"up\" when event emptied :"), "my.script: line 8: the first rule of a joint is active from the start: it has no 'when'");
  EXPECT_EQ(edited(" when event emptied", ""), "my.script: line 6: a rule after the first needs 'when'");
  EXPECT_EQ(edited("goal high\n", "goal high high\n"), "my.script: line 8: does not end before 'high'");
  EXPECT_EQ(refusal(""), "my.script: holds no script; must begin with 'script pass'");
  EXPECT_EQ(refusal(std::string(70000, '\n')), "my.script: longer than 65536 bytes");
}

TEST(ScriptText, ReadsAFileAndSaysWhichCannotBeRead) {
  const berm::test::Scratch scratch;
  EXPECT_EQ(ScriptText::read(scratch.write("pass.script", good), vocabulary()).rules_of(swing), 3U);
  EXPECT_THROW(ScriptText::read(scratch.path("none.script"), vocabulary()), ScriptError);
  EXPECT_THROW(ScriptText::read(scratch.folder(), vocabulary()), ScriptError);
}

TEST(ScriptText, NamesAGoalOutsideItsJointsRange) {
  const MachineModel machine = berm::app_bench::zx200();
  EXPECT_EQ(goal_out_of_range(machine, parsed(good).bind(std::vector<double>{1.6, 0.6, -1.5, -0.4}, 1.0)), "");
  const std::string wrong = goal_out_of_range(machine, parsed(good).bind(std::vector<double>{1.6, 1.6, -1.5, -0.4}, 1.0));
  EXPECT_EQ(wrong.rfind("boom, rule 'up': goal 91.6", 0), 0U) << wrong;
  EXPECT_NE(goal_out_of_range(machine, parsed(good).bind(std::vector<double>{NAN, 0.6, -1.5, -0.4}, 1.0)), "");
}

// The scripts that come with the app are taken, and the whole pass is in them.
TEST(ScriptText, TheAppsOwnScripts) {
  const ScriptSet scripts = berm::app_bench::shipped_scripts();
  EXPECT_EQ(scripts.pass.rules_of(swing), 4U);
  EXPECT_EQ(scripts.approach.rules_of(swing), 2U);
}

}  // namespace
