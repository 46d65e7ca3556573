// For every stop reason of the contract: when the operator is called, and with what he can do about it.
#include <gtest/gtest.h>

#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "app/operator_advice.hpp"
#include "app/recovery.hpp"
#include "app_bench/bench_machine.hpp"
#include "app_bench/events.hpp"
#include "recovery_observations.hpp"

namespace {

using namespace berm::app;
using namespace berm::app_bench;

constexpr double at_once = 0.0, in_time = 30.0, gone_by_then = 38.0;  // s

struct Expected {
  std::uint8_t reason;
  bool latches;               // berm_contract.h: latched, or a fault
  double called_after_s;
  std::vector<const char*> words;  // what he is to look at, and do
};

const Expected expected[] = {
    {BERM_STOP_COLLISION_PREDICTED, false, in_time, {"clear the place", "relearn"}},
    {BERM_STOP_UNKNOWN_GROUND, false, in_time, {"hides the ground", "scanners", "lift"}},
    {BERM_STOP_STALE_GROUND, false, in_time, {"hides the ground", "scanners", "lift"}},
    {BERM_STOP_DIG_FLOOR, false, in_time, {"bucket", "too low", "dig zone's floor", "by hand"}},
    {BERM_STOP_REQUEST_HOLD, false, in_time, {"app's requests", "computer", "start it anew"}},
    {BERM_STOP_APP_SILENT, true, at_once, {"app", "computer"}},
    {BERM_STOP_STATE_FRAME, true, at_once, {"bus", "joint", "inclination"}},
    {BERM_STOP_SCANNER_SILENT, true, at_once, {"scanner", "lidar", "power and cable"}},
    {BERM_STOP_OPERATOR, true, at_once, {"stop key", "spotter"}},
    {BERM_STOP_EMERGENCY, true, at_once, {"emergency stop", "danger", "release it"}},
    {BERM_STOP_JOINT_RANGE, false, in_time, {"joint back into its range"}},
    {BERM_STOP_BRAKING, true, at_once, {"slow down", "valves"}},
    {BERM_STOP_MACHINE_FAULT, true, at_once, {"error of its own", "display"}},
    {BERM_STOP_INTERNAL, true, at_once, {"error in itself", "start both anew"}},
    {BERM_STOP_CLOCK, true, at_once, {"clock", "kernel's computer"}},
    {BERM_STOP_BASE_MOVED, true, at_once, {"tilted", "set it firmly", "site file"}},
    {BERM_STOP_UNCOMMANDED, true, at_once, {"otherwise than it was told", "keep everybody away", "levers"}},
    {BERM_STOP_OVERPASS, false, in_time, {"send away", "admit the truck", "away from over it"}},
    {BERM_STOP_TAIL, true, at_once, {"behind the machine"}},
    {BERM_STOP_INTRUDER, false, gone_by_then, {"send away who"}},
    {BERM_STOP_SEPARATION, false, in_time, {"see all round"}},
    {BERM_STOP_SENSOR_BLOCKED, true, at_once, {"windows", "clean"}},
    {BERM_STOP_DUST, false, in_time, {"dust"}},
};
static_assert(std::size(expected) == BERM_STOP_REASONS - 1, "a stop reason is missing here");

// Those that want the same of him.
std::string action_of(std::uint8_t reason) { return reason == BERM_STOP_STALE_GROUND ? "unknown ground" : stop_reason_name(reason); }

class EachReason : public ::testing::TestWithParam<Expected> {};

TEST_P(EachReason, CallsTheOperatorOnceInItsTimeWithWhatHelps) {
  const Expected& e = GetParam();
  Recovery recovery(berm::app_bench::zx200());
  const Events events;
  const ProgressLog log(events.fd());
  for (double t = 0.0; t < 120.0; t += 0.1) {
    Observation o = stopped(t, e.reason);
    o.latched = e.latches;
    recovery.step(o, log);
  }
  const auto calls = events.named("operator_needed");
  ASSERT_EQ(calls.size(), 1U);
  EXPECT_NEAR(calls[0].at("time_s").get<double>(), e.called_after_s, 0.2);
  EXPECT_EQ(calls[0].at("reason"), stop_reason_name(e.reason));
  const auto advice = calls[0].at("advice").get<std::string>();
  for (const char* word : e.words) EXPECT_NE(advice.find(word), std::string::npos) << "\"" << word << "\" is not in: " << advice;
  EXPECT_EQ(advice.find('\n'), std::string::npos);
  const bool resets = advice.find("switch run off, press reset, switch run on") != std::string::npos;
  EXPECT_EQ(resets, e.latches && e.reason != BERM_STOP_INTERNAL) << advice;  // a kernel that has found itself wrong is started anew
}

INSTANTIATE_TEST_SUITE_P(Contract, EachReason, ::testing::ValuesIn(expected), [](const auto& test) {
  std::string name = stop_reason_name(test.param.reason);
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

TEST(OperatorAdvice, IsSharedOnlyByWhatWantsTheSameOfHim) {
  for (const Expected& a : expected)
    for (const Expected& b : expected)
      EXPECT_EQ(std::string(operator_advice(a.reason)) == operator_advice(b.reason), action_of(a.reason) == action_of(b.reason))
          << stop_reason_name(a.reason) << ", " << stop_reason_name(b.reason);
}

TEST(OperatorAdvice, ReasonsAreEachOnceInTheContractsOrder) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    EXPECT_EQ(expected[i].reason, i + 1);
    EXPECT_TRUE(names.insert(stop_reason_name(expected[i].reason)).second);
  }
}

// A kernel of another version: never without a word.
TEST(OperatorAdvice, AReasonThatTheContractDoesNotHaveIsToldToo) {
  Recovery recovery(berm::app_bench::zx200());
  const Events events;
  const ProgressLog log(events.fd());
  Observation o = stopped(0.0, BERM_STOP_REASONS);
  o.latched = true;
  EXPECT_TRUE(recovery.step(o, log).operator_called);
  EXPECT_FALSE(events.named("operator_needed")[0].at("advice").get<std::string>().empty());
}

TEST(OperatorAdvice, NamesTheWindowsOnWhichSomethingLies) {
  berm_state state{};
  state.kernel_state = BERM_STATE_FAULT;
  state.stop_reason = BERM_STOP_SENSOR_BLOCKED;
  state.sight = BERM_SIGHT_BLOCKED(1) | BERM_SIGHT_BLOCKED(2) | BERM_SIGHT_DUST_SLOW | BERM_SIGHT_LEARNS;
  Recovery recovery(berm::app_bench::zx200());
  const Events events;
  recovery.step(observe(state), ProgressLog(events.fd()));
  const auto calls = events.named("operator_needed");
  ASSERT_EQ(calls.size(), 1U);
  EXPECT_EQ(calls[0].at("advice").get<std::string>().rfind("right scanner, lidar 1: ", 0), 0U) << calls[0];
}

}  // namespace
