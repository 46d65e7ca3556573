// A kernel that does not get as far as RUN and gives no reason: nobody waits without a word.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "app/start_call.hpp"
#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

class Starts : public ::testing::Test {
protected:
  using Change = std::function<void(Observation&)>;
  // A kernel in this state, everything heard, both pans sweeping; what the test changes of that.
  void go(double seconds, std::uint8_t kernel_state, const Change& change = [](Observation&) {}) {
    for (const double end = time_s_ + seconds; time_s_ < end; time_s_ += 0.05) {
      Observation o;
      o.time_s = time_s_;
      o.kernel_state = kernel_state;
      o.latched = kernel_state == BERM_STATE_FAULT;
      o.angle = {0.1, 0.6, -1.7, -1.7};
      o.pan = {std::sin(time_s_), std::cos(time_s_)};
      o.request_result = BERM_REQUEST_ACCEPTED;
      change(o);
      call_.step(o, log_);
    }
  }
  std::vector<nlohmann::json> calls() const { return events_.named("operator_needed"); }
  std::string advice() const { return calls().empty() ? "" : calls().back().at("advice").get<std::string>(); }
  bool advises(const std::string& words) const { return advice().find(words) != std::string::npos; }

  app_bench::Events events_;
  ProgressLog log_{events_.fd()};
  StartCall call_;
  double time_s_ = 0.0;
};

TEST_F(Starts, AKernelThatStaysInInitIsToldOnce) {
  go(29.0, BERM_STATE_INIT);
  EXPECT_TRUE(calls().empty()) << "it may start by itself";
  go(200.0, BERM_STATE_INIT);
  ASSERT_EQ(calls().size(), 1u);
  EXPECT_EQ(calls()[0].at("reason"), "kernel not started");
  EXPECT_NEAR(calls()[0].at("stopped_s").get<double>(), 30.0, 0.1);
  for (const char* words : {"release the emergency stop", "stop keys", "spotter", "panel", "inclination", "lidar"}) EXPECT_TRUE(advises(words)) << words << ": " << advice();
}

TEST_F(Starts, WhatIsNotHeardIsNamed) {
  const Change left_silent = [](Observation& o) { o.pan[0] = 0.0; };
  go(40.0, BERM_STATE_INIT, left_silent);
  ASSERT_EQ(calls().size(), 1u);
  EXPECT_TRUE(advises("the left scanner sends nothing"));
  EXPECT_FALSE(advises("right scanner"));
  EXPECT_TRUE(advises("release the emergency stop")) << "it may be pressed besides";
  go(40.0, BERM_STATE_INIT, [](Observation& o) { o.pan[1] = 0.7; });
  ASSERT_EQ(calls().size(), 2u) << "another thing by now";
  EXPECT_TRUE(advises("the right scanner sends nothing"));
  go(40.0, BERM_STATE_INIT, left_silent);
  EXPECT_EQ(calls().size(), 2u) << "of that he was told";
  go(40.0, BERM_STATE_INIT, [](Observation& o) { o.angle = {}; o.pan = {}; });
  EXPECT_TRUE(advises("no joint angles come"));
  EXPECT_FALSE(advises("scanner")) << "without them no scan is used";
  go(40.0, BERM_STATE_INIT, [](Observation& o) { o.blocked_eyes = BERM_SIGHT_BLOCKED(3); });
  EXPECT_TRUE(advises("window (lidar 2)"));
}

TEST_F(Starts, WhoseSwitchIsNeverOnIsToldWhateverElseKeepsTheMachine) {
  go(20.0, BERM_STATE_INIT);
  go(29.0, BERM_STATE_STANDBY);
  EXPECT_TRUE(calls().empty());
  go(60.0, BERM_STATE_STANDBY, [](Observation& o) { o.stop_reason = std::fmod(o.time_s, 2.0) < 1.0 ? BERM_STOP_INTRUDER : BERM_STOP_NONE; });
  ASSERT_EQ(calls().size(), 1u);
  EXPECT_EQ(calls()[0].at("reason"), "run switch off");
  EXPECT_TRUE(advises("switch run on"));
}

TEST_F(Starts, APauseByTheSwitchIsNobodysTroubleButAResetThatIsNotFollowedByItIs) {
  go(1.0, BERM_STATE_RUN, [](Observation& o) { o.run_switch = true; });
  go(3600.0, BERM_STATE_STANDBY);
  EXPECT_TRUE(calls().empty());
  go(1.0, BERM_STATE_RUN, [](Observation& o) { o.run_switch = true; });
  go(5.0, BERM_STATE_FAULT);
  go(40.0, BERM_STATE_STANDBY);
  EXPECT_EQ(calls().size(), 1u);
}

TEST_F(Starts, ASwitchThatIsOnWithoutEffectIsTheRequests) {
  const Change on = [](Observation& o) { o.run_switch = true; };
  go(60.0, BERM_STATE_STANDBY, [](Observation& o) { o.run_switch = o.release_awaited = true; });
  EXPECT_TRUE(calls().empty()) << "who left it on is told elsewhere";
  go(60.0, BERM_STATE_STANDBY, [](Observation& o) { o.run_switch = true; o.stop_reason = BERM_STOP_DUST; });
  EXPECT_TRUE(calls().empty()) << "what a reason keeps too";
  go(40.0, BERM_STATE_STANDBY, [](Observation& o) { o.run_switch = true; o.request_result = o.time_s > 135.0 ? BERM_REQUEST_NONE : BERM_REQUEST_VERSION; });
  ASSERT_EQ(calls().size(), 1u);
  EXPECT_EQ(calls()[0].at("reason"), "requests refused");
  EXPECT_TRUE(advises("(version)"));
  go(100.0, BERM_STATE_RUN, on);
  EXPECT_EQ(calls().size(), 1u);
}

// The sequencer's: before its first motion, whatever the app waits for.
class SequencerStarts : public ::testing::Test {
protected:
  void go(double seconds, std::uint8_t kernel_state, bool run_switch) {
    for (const double end = run_.seconds + seconds; run_.seconds < end;) {
      berm_state& state = run_.plant.mutable_segment().state;
      state.kernel_state = kernel_state;
      state.stop_reason = BERM_STOP_NONE;
      state.stop_category = 255;
      if (!run_switch) state.panel &= ~BERM_PANEL_OPERATOR_RUN;
      run_.step();
    }
  }
  app_bench::Events events_;
  Loading run_{1, start_pose(), events_.fd()};
};

TEST_F(SequencerStarts, InInitTheOperatorIsTold) {
  go(32.0, BERM_STATE_INIT, false);
  const auto calls = events_.named("operator_needed");
  ASSERT_EQ(calls.size(), 1u);
  EXPECT_EQ(calls[0].at("reason"), "kernel not started");
  EXPECT_EQ(calls[0].at("advice").get<std::string>().find("scanner"), std::string::npos) << "both pans turn: " << calls[0];
}

TEST_F(SequencerStarts, StandingByWithTheSwitchOffHeIsTold) {
  go(32.0, BERM_STATE_STANDBY, false);
  const auto calls = events_.named("operator_needed");
  ASSERT_EQ(calls.size(), 1u);
  EXPECT_EQ(calls[0].at("reason"), "run switch off");
}

}  // namespace
