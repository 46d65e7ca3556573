// While the Workspace Monitor learns the ground nobody is watched, and the machine is slow: everywhere, or near the lane of a truck that has parked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr int kLearnCycles = 900;
constexpr std::uint32_t kLearning = BERM_SIGHT_LEARNS | BERM_SIGHT_LEARNS_LANE;
constexpr double kLaneM = 6.8;                                 // where the lane begins, to the left
constexpr double kNearM = kLaneM - SK_LANE_BESIDE_MM * 1e-3;

class CycleLearning : public testing::Test {
 protected:
  CycleLearning() {
    parameters = berm::test::demo_parameters();
    parameters.workspace_watched = 1;
    parameters.workspace_learn_us = 10000 * kLearnCycles;
    parameters.truck_zones = parameters.lanes = 0;
  }
  void start() {
    rig = std::make_unique<CycleRig>(parameters);
    rig->face_a_swing_to_the_left();
    while (rig->cycle->workspace().newest_us(0) < 0 && rig->machine.cycle() < 100) rig->step();
    ASSERT_TRUE(rig->reach_state(BERM_STATE_RUN, 1500)) << int{state().stop_reason};
  }
  int cycles_until_learned(int limit) {
    for (int n = 0; n <= limit; ++n) {
      if ((state().sight & kLearning) == 0) return n;
      rig->step();
    }
    return -1;
  }
  const berm_state& state() const { return rig->state(); }
  std::int32_t share(int joint) const {
    return static_cast<std::int32_t>(std::int64_t{parameters.velocity_max_urad_s[joint]} * parameters.workspace_learn_speed_permille / 1000);
  }
  // The greatest speed that goes out of a bucket that is asked to go to and fro at its largest.
  std::int32_t bucket_urad_s() {
    std::int32_t most = 0;
    for (int k = 0; k < 40; ++k) {
      rig->wanted_urad_s[BERM_BUCKET] = k % 20 < 10 ? -parameters.velocity_max_urad_s[BERM_BUCKET] : parameters.velocity_max_urad_s[BERM_BUCKET];
      rig->step();
      most = std::max(most, std::abs(state().commanded_urad_s[BERM_BUCKET]));
    }
    rig->wanted_urad_s[BERM_BUCKET] = 0;
    rig->steps(20);
    return most;
  }
  // The bucket's farthest corner in y, 7.1 m out at most in this pose, 0.6 m to the sides.
  double corner_y_m() const { return 7.1 * std::sin(rig->machine.angle_rad[0]) + 0.6 * std::cos(rig->machine.angle_rad[0]); }
  struct Swing {
    double fastest_before = 0.0, fastest_near = 0.0;  // rad/s, before the corner is near the lane, and from there
  };
  Swing swing_to_the_lane() {
    Swing swing;
    rig->wanted_urad_s[BERM_SWING] = 600000;
    for (int k = 0; k < 1200 && corner_y_m() < kLaneM; ++k) {
      rig->step();
      double& fastest = corner_y_m() < kNearM ? swing.fastest_before : swing.fastest_near;
      fastest = std::max(fastest, rig->machine.velocity_rad_s[BERM_SWING]);
    }
    return swing;
  }

  berm_parameters parameters{};
  std::unique_ptr<CycleRig> rig;
};

// verifies: SK-WM-74
TEST_F(CycleLearning, EveryJointIsSlowUntilTheGroundIsLearned) {
  start();
  ASSERT_EQ(state().sight, BERM_SIGHT_LEARNS);
  EXPECT_NEAR(bucket_urad_s(), share(BERM_BUCKET) - 250, 250) << "in the bus's steps of 500";
  EXPECT_NEAR(std::max(state().permitted_high_urad_s[BERM_BUCKET], -state().permitted_low_urad_s[BERM_BUCKET]), parameters.velocity_max_urad_s[BERM_BUCKET], 500)
      << "nothing is asked, nothing is cut";
  for (const int j : {BERM_SWING, BERM_BOOM, BERM_STICK}) {
    rig->wanted_urad_s[j] = parameters.velocity_max_urad_s[j];
    rig->step();
    EXPECT_LE(state().commanded_urad_s[j], share(j)) << j;
    EXPECT_LE(state().permitted_high_urad_s[j], share(j)) << j;
    EXPECT_GT(state().commanded_urad_s[j], 0) << j << ": it is slowed, not held";
    rig->wanted_urad_s[j] = 0;
    rig->steps(20);
  }
  ASSERT_GT(cycles_until_learned(kLearnCycles), 0);
  EXPECT_GT(bucket_urad_s(), 3 * share(BERM_BUCKET)) << "learned";
}

// verifies: SK-WM-74
TEST_F(CycleLearning, ItLastsAsLongAsTheMonitorLearnsAndBeginsAnewWithIt) {
  rig = std::make_unique<CycleRig>(parameters);
  rig->face_a_swing_to_the_left();
  rig->step();
  const auto first = static_cast<int>(rig->machine.cycle());
  ASSERT_EQ(state().sight, BERM_SIGHT_LEARNS) << "from the first cycle";
  EXPECT_NEAR(first + cycles_until_learned(2 * kLearnCycles), kLearnCycles, 30) << "the base is learned in the first cycles";
  ASSERT_TRUE(rig->reach_state(BERM_STATE_RUN, 1500)) << int{state().stop_reason};
  EXPECT_EQ(state().sight, 0U);
  rig->machine.relearn_key = true;
  rig->steps(5);
  rig->machine.relearn_key = false;
  const auto anew = static_cast<int>(rig->machine.cycle());
  EXPECT_EQ(state().sight, BERM_SIGHT_LEARNS);
  ASSERT_TRUE(rig->reach_state(BERM_STATE_RUN, 1500)) << int{state().stop_reason};
  EXPECT_NEAR(bucket_urad_s(), share(BERM_BUCKET) - 250, 250);
  ASSERT_GE(cycles_until_learned(2 * kLearnCycles), 0);
  EXPECT_NEAR(static_cast<int>(rig->machine.cycle()) - anew, kLearnCycles, 10);
}

// verifies: SK-WM-74, SK-WM-75
TEST_F(CycleLearning, UnwatchedNothingIsLearnedAndNothingSlowed) {
  parameters.workspace_watched = 0;
  parameters.lanes = 1;
  parameters.lane[0] = {-15000, -15000, 15000, 15000};
  start();
  rig->machine.spotter_present = true;
  rig->steps(20);
  EXPECT_EQ(state().sight, 0U);
  EXPECT_GT(bucket_urad_s(), 3 * share(BERM_BUCKET));
}

// verifies: SK-WM-75
TEST_F(CycleLearning, NearTheLaneOfATruckThatHasParkedTheMachineIsSlow) {
  parameters.lanes = 1;
  parameters.lane[0] = {-15000, static_cast<std::int32_t>(kLaneM * 1e3), 15000, 13000};
  const double slow = share(BERM_SWING) * 1e-6;
  for (const bool parked : {true, false}) {
    start();
    ASSERT_GE(cycles_until_learned(2 * kLearnCycles), 0);
    rig->machine.spotter_present = parked;
    rig->steps(20);
    EXPECT_EQ(state().sight, parked ? BERM_SIGHT_LEARNS_LANE : 0U);
    EXPECT_GT(bucket_urad_s(), 3 * share(BERM_BUCKET)) << "far from it";
    const Swing swing = swing_to_the_lane();
    ASSERT_GE(corner_y_m(), kLaneM) << int{state().stop_reason};
    EXPECT_GT(swing.fastest_before, 3 * slow);
    if (parked) EXPECT_LE(swing.fastest_near, 1.02 * slow);
    else EXPECT_GT(swing.fastest_near, 3 * slow);
  }
}

// verifies: SK-WM-75
TEST_F(CycleLearning, ALaneThatIsOpenOrLearnedSlowsNothing) {
  parameters.lanes = 1;
  parameters.lane[0] = {-15000, -15000, 15000, 15000};  // the machine stands in it
  start();
  ASSERT_GE(cycles_until_learned(2 * kLearnCycles), 0);
  EXPECT_GT(bucket_urad_s(), 3 * share(BERM_BUCKET)) << "open";
  rig->machine.spotter_present = true;
  rig->steps(20);
  EXPECT_NEAR(bucket_urad_s(), share(BERM_BUCKET) - 250, 250);
  EXPECT_NEAR(cycles_until_learned(2 * kLearnCycles), kLearnCycles, 100);
  EXPECT_GT(bucket_urad_s(), 3 * share(BERM_BUCKET)) << "learned";
  rig->machine.truck_leaving = true;
  rig->steps(20);
  EXPECT_EQ(state().sight, 0U);
  EXPECT_GT(bucket_urad_s(), 3 * share(BERM_BUCKET)) << "open again";
}

}  // namespace
}  // namespace berm::kernel::test
