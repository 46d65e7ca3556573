// Every valid state times every input times every kind of time.
#include <gtest/gtest.h>

#include <set>

#include "stop_space.hpp"
#include "stop_table.hpp"

namespace berm::core_test {
namespace {

struct Step {
  sk_stop_state before;
  sk_stop_input in;
  sk_stop_state after;
  sk_stop_output out;
  bool named;     // all reason codes are the contract's
  bool quiet;     // no reason holds
  bool go;
  bool cut;
};

template <class Check>
void for_every_step(Check check) {
  std::size_t steps = 0;
  const std::vector<sk_stop_state> states = valid_states();
  for (const std::int64_t now_us : times()) {
    const std::vector<sk_stop_input> all = inputs(now_us);
    for (const sk_stop_state& before : states) {
      for (const sk_stop_input& in : all) {
        Step t{before, in, before, {}, false, false, in.operator_run && in.inputs_ready, false};
        sk_stop_step(&t.after, &in, &t.out);
        t.named = in.fault_reason < 24 && in.latch_reason < 24 && in.hold_reason < 24;
        t.quiet = in.fault_reason == 0 && in.latch_reason == 0 && in.hold_reason == 0;
        t.cut = !t.named || (in.fault_reason && in.fault_category_0) || (in.latch_reason && in.latch_category_0);
        ++steps;
        check(t);
        if (testing::Test::HasFailure()) {
          FAIL() << name(before.code) << " reason " << int{before.reason} << " category " << int{before.category} << " rank " << int{before.rank}
                 << " released " << before.reset_seen_released << " run release " << std::hex << before.run_release << std::dec << " -> " << name(t.after.code) << "; inputs: fault " << int{in.fault_reason} << " latch "
                 << int{in.latch_reason} << " hold " << int{in.hold_reason} << " cut " << in.fault_category_0 << in.latch_category_0 << " ready "
                 << in.inputs_ready << " standstill " << in.standstill << " run " << in.operator_run << " off " << in.operator_run_off << " reset " << in.operator_reset << " now " << now_us;
        }
      }
    }
  }
  EXPECT_EQ(steps, states.size() * times().size() * 8192u);
}

// verifies: SK-ST-4, SK-ST-5, SK-ST-6, SK-ST-7, SK-ST-10, SK-ST-11, SK-ST-12, SK-ST-13, SK-ST-14, SK-ST-20, SK-ST-21, SK-ST-22, SK-ST-24, SK-ST-32, SK-ST-33
TEST(StopTransitions, AreThoseOfTheTable) {
  for_every_step([](const Step& t) {
    const sk_stop_state expected = expected_state(t.before, t.in);
    EXPECT_TRUE(same(t.after, expected)) << "expected " << name(expected.code) << " reason " << int{expected.reason} << " category "
                                         << int{expected.category} << " rank " << int{expected.rank} << " released " << expected.reset_seen_released
                                         << " since " << expected.since_us << " run release " << expected.run_release << "; is " << t.after.run_release << " reason " << int{t.after.reason} << " category "
                                         << int{t.after.category} << " rank " << int{t.after.rank} << " released " << t.after.reset_seen_released
                                         << " since " << t.after.since_us;
  });
}

// verifies: SK-ST-1, SK-ST-2, SK-ST-3
TEST(StopTransitions, MotionOnlyInRunWithNothingInTheWay) {
  for_every_step([](const Step& t) {
    EXPECT_EQ(t.out.motion_enabled, t.after.code == SK_STATE_RUN);
    if (!t.out.motion_enabled) return;
    EXPECT_TRUE(t.quiet && t.go);
    EXPECT_TRUE(!t.before.latched && (t.before.code == SK_STATE_STANDBY || t.before.code == SK_STATE_RUN || t.before.code == SK_STATE_STOPPED));
  });
}

// verifies: SK-ST-6, SK-ST-7
TEST(StopTransitions, WhatWasLeftOnStartsNothing) {
  for_every_step([](const Step& t) {
    const bool seen_before = t.before.run_release == kSeen, seen = t.after.run_release == kSeen;
    const bool stands_by = t.before.code == SK_STATE_STANDBY && t.after.code == SK_STATE_STANDBY;
    const bool off = t.in.operator_run_off && !t.in.operator_run;
    if (t.before.code == SK_STATE_STANDBY && t.after.code == SK_STATE_RUN) {
      EXPECT_TRUE(seen_before);
    }
    if (seen != seen_before) {
      EXPECT_TRUE(seen ? stands_by && off : t.after.latched);
    }
    if (stands_by && off) {
      EXPECT_TRUE(seen);
    }
    if (t.before.latched || t.after.latched) {
      EXPECT_FALSE(seen);
    }
  });
}

// verifies: SK-ST-22, SK-ST-20, SK-ST-21
TEST(StopTransitions, LatchedEndsOnlyByTheReset) {
  for_every_step([](const Step& t) {
    EXPECT_TRUE(valid_state(t.after));
    if (t.before.latched && !t.after.latched) {
      EXPECT_EQ(t.after.code, SK_STATE_STANDBY);
      EXPECT_TRUE(t.before.code == SK_STATE_STOPPED || t.before.code == SK_STATE_FAULT);
      EXPECT_TRUE(t.quiet && t.in.standstill && t.in.operator_reset && t.before.reset_seen_released);
    }
    if (t.in.fault_reason || !t.named) {
      EXPECT_EQ(t.after.rank, SK_RANK_FAULT);
    }
    if (t.in.latch_reason && t.before.code != SK_STATE_INIT) {
      EXPECT_TRUE(t.after.latched);
    }
  });
}

// verifies: SK-ST-30, SK-ST-31, SK-ST-32
TEST(StopTransitions, Power) {
  for_every_step([](const Step& t) {
    const bool keeps = t.after.code == SK_STATE_RUN || (t.after.code == SK_STATE_STOPPING && t.after.category != 0) ||
                       (t.after.code == SK_STATE_STOPPED && t.after.rank == SK_RANK_HOLD);
    EXPECT_EQ(t.out.heartbeat_enable, keeps);
    if (t.cut) {
      EXPECT_FALSE(t.out.heartbeat_enable);
    }
    if (t.before.category == 0 && t.after.latched) {
      EXPECT_EQ(t.after.category, 0);
    }
  });
}

}  // namespace
}  // namespace berm::core_test
