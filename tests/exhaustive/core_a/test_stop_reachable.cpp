// Walks everything that can be reached from the start, so that no state is dead and no way leads round the operator.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <tuple>

#include "stop_space.hpp"

namespace berm::core_test {
namespace {

using Key = std::tuple<std::uint16_t, std::uint8_t, std::uint8_t, std::uint8_t, bool, bool, std::uint16_t>;
Key key(const sk_stop_state& s) { return {s.code, s.reason, s.category, s.rank, s.latched, s.reset_seen_released, s.run_release}; }

// Breadth first over all inputs that pass; time is either fresh or overdue, so the state's own are always kEntered.
template <class Allowed>
std::map<Key, sk_stop_state> reach(sk_stop_state from, Allowed allowed) {
  std::map<Key, sk_stop_state> seen;
  std::deque<sk_stop_state> waiting;
  from.since_us = from.hold_seen_us = kEntered;
  seen.emplace(key(from), from);
  waiting.push_back(from);
  std::vector<sk_stop_input> all = inputs(kEntered);
  const std::vector<sk_stop_input> overdue = inputs(kEntered + SK_STOPPING_LIMIT_US + 1);
  all.insert(all.end(), overdue.begin(), overdue.end());
  while (!waiting.empty()) {
    const sk_stop_state s = waiting.front();
    waiting.pop_front();
    for (const sk_stop_input& in : all) {
      if (!allowed(in)) continue;
      sk_stop_state next = s;
      sk_stop_output out{};
      sk_stop_step(&next, &in, &out);
      next.since_us = next.hold_seen_us = kEntered;
      if (seen.emplace(key(next), next).second) waiting.push_back(next);
    }
  }
  return seen;
}

bool reaches(const std::map<Key, sk_stop_state>& seen, std::uint16_t code) {
  return std::any_of(seen.begin(), seen.end(), [&](const auto& e) { return e.second.code == code; });
}

// verifies: SK-ST-4, SK-ST-23
TEST(StopReachable, AllSixAndNothingInvalid) {
  sk_stop_state start{};
  sk_stop_init(&start);
  EXPECT_EQ(start.code, SK_STATE_INIT);
  EXPECT_EQ(start.since_us, 0);
  EXPECT_TRUE(valid_state(start));
  const auto seen = reach(start, [](const sk_stop_input&) { return true; });
  for (const std::uint16_t code : kCodes) EXPECT_TRUE(reaches(seen, code)) << name(code);
  for (const auto& [k, s] : seen) EXPECT_TRUE(valid_state(s)) << name(s.code);
}

// verifies: SK-ST-22
TEST(StopReachable, WithoutTheResetKeyNoLatchedStateRunsAgain) {
  for (const sk_stop_state& s : valid_states()) {
    if (!s.latched) continue;
    const auto never = reach(s, [](const sk_stop_input& in) { return !in.operator_reset; });
    EXPECT_FALSE(reaches(never, SK_STATE_RUN) || reaches(never, SK_STATE_STANDBY)) << name(s.code);
    // a key that is stuck is not a reset either
    sk_stop_state stuck_from = s;
    stuck_from.reset_seen_released = false;
    const auto stuck = reach(stuck_from, [](const sk_stop_input& in) { return in.operator_reset; });
    EXPECT_FALSE(reaches(stuck, SK_STATE_RUN) || reaches(stuck, SK_STATE_STANDBY)) << name(s.code);
    const auto any = reach(s, [](const sk_stop_input&) { return true; });
    EXPECT_TRUE(reaches(any, SK_STATE_RUN)) << name(s.code) << ": the operator can get it going again";
  }
}

// verifies: SK-ST-6
TEST(StopReachable, WithTheRunSwitchLeftOnNothingBegins) {
  const auto left_on = [](const sk_stop_input& in) { return in.operator_run || !in.operator_run_off; };
  sk_stop_state start{};
  sk_stop_init(&start);
  EXPECT_FALSE(reaches(reach(start, left_on), SK_STATE_RUN)) << "from the start";
  for (const sk_stop_state& s : valid_states()) {
    if (!s.latched) continue;
    const auto seen = reach(s, left_on);
    EXPECT_FALSE(reaches(seen, SK_STATE_RUN)) << name(s.code);
    EXPECT_TRUE(reaches(seen, SK_STATE_STANDBY)) << name(s.code) << ": the reset is not kept from him";
  }
}

// verifies: SK-ST-3
TEST(StopReachable, WithoutTheRunSwitchNothingRuns) {
  for (const sk_stop_state& s : valid_states()) {
    if (s.code == SK_STATE_RUN) continue;
    EXPECT_FALSE(reaches(reach(s, [](const sk_stop_input& in) { return !in.operator_run; }), SK_STATE_RUN)) << name(s.code);
  }
}

}  // namespace
}  // namespace berm::core_test
