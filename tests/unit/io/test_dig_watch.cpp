// Dig zones with histograms of heights: watched, but for where the bucket moves soil.
#include "io/dig_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/height_map.h"
#include "io/workspace_watch.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr std::int64_t kNow = 1000000;

class DigWatchTest : public testing::Test {
 protected:
  DigWatchTest() {
    parameters.workspace_watched = parameters.workspace_histogram = 1;
    parameters.truck_zones = parameters.lanes = 0;
    parameters.dig_zones = 1;
    parameters.dig_zone[0] = {3900, -4200, 10500, 4200, -3400, 1100};
  }
  static JointAngles digging(double swing_deg = 0.0) { return {swing_deg * kDegree, 20 * kDegree, -70 * kDegree, -60 * kDegree}; }
  static JointAngles carrying() { return {0.0, 45 * kDegree, -90 * kDegree, -70 * kDegree}; }
  static const DigWatch::Cell* cell_at(const DigWatch& digs, double x_m, double y_m) {
    const auto found = std::find_if(digs.cells().begin(), digs.cells().end(), [&](const auto& c) {
      return c.at.ix == sk_map_index(static_cast<std::int32_t>(x_m * 1e3)) && c.at.iy == sk_map_index(static_cast<std::int32_t>(y_m * 1e3));
    });
    return found == digs.cells().end() ? nullptr : &*found;
  }
  // Of the bucket in the swing plane.
  double bucket_from(const JointAngles& joints) const { return std::min(pin(joints).x(), Kinematics(parameters).implements(joints).tip.x()); }
  double bucket_to(const JointAngles& joints) const { return std::max(pin(joints).x(), Kinematics(parameters).implements(joints).tip.x()); }
  Eigen::Vector2d pin(const JointAngles& joints) const { return Kinematics(parameters).implements(joints).link[2].pin; }

  berm_parameters parameters = berm::test::demo_parameters();
};

// verifies: SK-WM-69
TEST_F(DigWatchTest, NearIsWhereALowBucketMovesSoil) {
  DigWatch digs(parameters);
  EXPECT_EQ(cell_at(digs, 3.0, 0.0), nullptr) << "not of a dig zone";
  ASSERT_NE(cell_at(digs, 6.0, 0.0), nullptr);
  digs.step(digging(), false, false, kNow);
  const double from = bucket_from(digging()), to = bucket_to(digging());
  ASSERT_GT(from, 5.5);
  ASSERT_LT(to, 9.0);
  EXPECT_TRUE(cell_at(digs, 0.5 * (from + to), 0.0)->stirred);
  EXPECT_TRUE(cell_at(digs, from - 1.4, 0.0)->stirred) << "towards the machine, where it is pulled";
  EXPECT_FALSE(cell_at(digs, to + 1.6, 0.0)->stirred) << "beyond the teeth";
  EXPECT_TRUE(cell_at(digs, 0.5 * (from + to), 1.0)->stirred);
  EXPECT_FALSE(cell_at(digs, 0.5 * (from + to), 1.8)->stirred) << "beside it";
  EXPECT_FALSE(cell_at(digs, 0.5 * (from + to), 0.0)->was_stirred);
  digs.step(digging(25.0), false, true, kNow + 1);
  const double r = 0.5 * (from + to);
  EXPECT_TRUE(cell_at(digs, r * std::cos(25 * kDegree), r * std::sin(25 * kDegree))->stirred) << "it swings with the upper body";
  EXPECT_FALSE(cell_at(digs, r, 0.0)->stirred);
  EXPECT_TRUE(cell_at(digs, r, 0.0)->was_stirred);
}

// verifies: SK-WM-69
TEST_F(DigWatchTest, ABucketAboveTheCeilingMovesNone) {
  DigWatch digs(parameters);
  ASSERT_GT(std::min(pin(carrying()).y(), Kinematics(parameters).implements(carrying()).tip.y()), 1.1) << "the pose tests nothing";
  digs.step(carrying(), false, false, kNow);
  EXPECT_TRUE(std::none_of(digs.cells().begin(), digs.cells().end(), [](const auto& c) { return c.stirred; }));
}

// Zones that overlap have a cell once, with the higher ceiling.
// verifies: SK-WM-69
TEST_F(DigWatchTest, OfTwoZonesTheHigherCeilingCounts) {
  parameters.dig_zones = 2;
  parameters.dig_zone[1] = {5000, -1000, 8000, 1000, -3400, 500};
  DigWatch digs(parameters);
  EXPECT_EQ(cell_at(digs, 6.0, 0.0)->ceiling_m, 1.1);
  EXPECT_EQ(std::count_if(digs.cells().begin(), digs.cells().end(), [&](const auto& c) { return c.at.ix == sk_map_index(6000) && c.at.iy == sk_map_index(0); }), 1);
}

// The whole of the watch, one cell of the zone near the bucket, one far from it.
class DugWorkspaceTest : public DigWatchTest {
 protected:
  DugWorkspaceTest() {
    watch = std::make_unique<WorkspaceWatch>(parameters);
    watch->begin();
    watch->dig(carrying(), false, now);
    for (const double x : {near_m, far_m}) see(x, 0, SK_HISTOGRAM_ENOUGH);
    watch->step(now);
    now += parameters.workspace_learn_us;
    watch->step(now);
  }
  void see(double x_m, std::int32_t z_mm, int points) {
    for (int i = 0; i < points; ++i) {
      blocks->count = 1;
      blocks->block[0] = berm_scan_block{};
      blocks->block[0].count = blocks->block[0].used[0] = 1;
      blocks->block[0].point_mm[0][0] = static_cast<std::int32_t>(x_m * 1e3);
      blocks->block[0].point_mm[0][1] = 150;
      blocks->block[0].point_mm[0][2] = z_mm;
      watch->take(*blocks, joints, now);
    }
  }
  std::uint16_t state(double x_m) const { return watch->histogram()->state[sk_map_index(150)][sk_map_index(static_cast<std::int32_t>(x_m * 1e3))]; }

  int points_seen(double x_m) const {
    const auto& bins = watch->histogram()->seen[sk_map_index(150)][sk_map_index(static_cast<std::int32_t>(x_m * 1e3))];
    return std::accumulate(std::begin(bins), std::end(bins), 0);
  }

  static constexpr double near_m = 6.6, far_m = 9.9;
  std::int64_t now = kNow;
  JointHistory joints;
  std::unique_ptr<WorkspaceWatch> watch;
  std::unique_ptr<ScanBlocks> blocks = std::make_unique<ScanBlocks>();
};

// verifies: SK-WM-46, SK-WM-69
TEST_F(DugWorkspaceTest, WhoComesIntoADigZoneStopsItAwayFromTheBucket) {
  watch->dig(digging(), false, now);
  see(far_m, 900, 3);
  EXPECT_TRUE(watch->step(now));
  berm_parameters without = parameters;
  without.workspace_histogram = 0;
  const auto plain = std::make_unique<WorkspaceWatch>(without);
  EXPECT_EQ(plain->rules().watched[sk_map_index(150)][sk_map_index(9900)], 0) << "the plain version leaves dig zones out";
}

// verifies: SK-WM-69
TEST_F(DugWorkspaceTest, SoilHeapedUpBesideTheBucketIsTheGroundWhenItIsGone) {
  watch->dig(digging(), false, now);
  EXPECT_EQ(state(near_m), SK_CELL_LEARNING);
  see(near_m, 900, SK_HISTOGRAM_ENOUGH);
  EXPECT_FALSE(watch->step(now)) << "beside the bucket";
  now += DigWatch::kLearnsOnUs;
  watch->dig(carrying(), false, now);
  EXPECT_EQ(state(near_m), SK_CELL_CLEAR);
  see(near_m, 950, 3);
  EXPECT_FALSE(watch->step(now)) << "learned while it was there";
  see(near_m, 1800, 3);
  EXPECT_TRUE(watch->step(now)) << "watched again";
}

// Of a face that the bucket hid the foot was seen first: all of it is its ground.
// verifies: SK-WM-69
TEST_F(DugWorkspaceTest, WhenTheBucketHasGoneASweepIsLearned) {
  watch->dig(digging(), false, now);
  see(near_m, -1300, SK_HISTOGRAM_ENOUGH);
  for (int i = 0; i < 2; ++i) {  // it comes back once
    now += DigWatch::kLearnsOnUs - 1;
    watch->dig(carrying(), false, now);
    EXPECT_EQ(state(near_m), SK_CELL_LEARNING);
    see(near_m, -600, SK_HISTOGRAM_ENOUGH / 2);
    EXPECT_FALSE(watch->step(now));
    if (i == 0) watch->dig(digging(), false, now);
  }
  watch->dig(carrying(), false, ++now);
  EXPECT_EQ(state(near_m), SK_CELL_CLEAR);
  see(near_m, -600, 3);
  EXPECT_FALSE(watch->step(now));
  see(near_m, 500, 3);
  EXPECT_TRUE(watch->step(now));
}

// verifies: SK-WM-69
TEST_F(DugWorkspaceTest, WhileItHoldsTheMachineNothingIsLearnedOn) {
  watch->dig(digging(), false, now);
  see(near_m, 0, SK_HISTOGRAM_ENOUGH);
  watch->dig(carrying(), false, ++now);
  EXPECT_EQ(state(near_m), SK_CELL_LEARNING);
  see(far_m, 900, 3);
  EXPECT_TRUE(watch->step(now));
  watch->dig(carrying(), false, ++now);
  EXPECT_EQ(state(near_m), SK_CELL_CLEAR);
}

// verifies: SK-WM-69
TEST_F(DugWorkspaceTest, WhileItHoldsTheMachineNothingIsForgotten) {
  see(near_m, 900, 3);
  EXPECT_TRUE(watch->step(now));
  watch->dig(digging(), false, now);
  EXPECT_EQ(state(near_m), SK_CELL_SOMEBODY) << "the bucket still moves while it comes to a stand";
  EXPECT_TRUE(watch->step(now));
}

// Who has stopped it walks up to the bucket: he is to stop it there too.
// verifies: SK-WM-69
TEST_F(DugWorkspaceTest, WhereTheBucketStandsIsWatchedToo) {
  watch->dig(digging(), false, now);
  see(near_m, 0, SK_HISTOGRAM_ENOUGH);
  see(far_m, 900, 3);
  EXPECT_TRUE(watch->step(now));
  watch->dig(digging(), true, now);
  EXPECT_EQ(state(near_m), SK_CELL_CLEAR) << "what stands moves no soil";
  see(near_m, 900, 3);
  EXPECT_EQ(state(near_m), SK_CELL_SOMEBODY);
  for (int i = 0; i < 3; ++i) {  // from where he came he is gone, and the dwell is over
    now += parameters.workspace_wait_us + 2 * parameters.workspace_period_us + 1;
    see(near_m, 900, 1);
    see(far_m, 0, 1);
    watch->dig(digging(), true, now);
    EXPECT_TRUE(watch->step(now)) << i;
  }
  EXPECT_EQ(state(far_m), SK_CELL_CLEAR);
  watch->dig(digging(), false, now);
  EXPECT_EQ(state(near_m), SK_CELL_SOMEBODY) << "nor forgotten when it stirs";
}

// verifies: SK-WM-69
TEST_F(DugWorkspaceTest, BeforeTheGroundIsLearnedACellThatTheBucketLeavesGoesOnLearning) {
  watch->begin();
  watch->dig(digging(), false, now);
  watch->step(now);
  watch->dig(carrying(), false, now);
  EXPECT_EQ(state(near_m), SK_CELL_LEARNING);
}

// verifies: SK-WM-67
TEST_F(DugWorkspaceTest, WhatIsLearnedCountsHalfACellBesideItToo) {
  watch->begin();
  see(9.95, 1500, SK_HISTOGRAM_ENOUGH);  // 0.05 m into its cell
  EXPECT_EQ(points_seen(9.8), SK_HISTOGRAM_ENOUGH) << "0.05 m beside it";
  EXPECT_EQ(watch->histogram()->observed[sk_map_index(150)][sk_map_index(9800)], 0U) << "but not of its own";
  EXPECT_EQ(points_seen(10.3), 0) << "0.25 m beside it";
  see(9.8, 0, SK_HISTOGRAM_ENOUGH);
  watch->step(now);
  now += parameters.workspace_learn_us;
  watch->step(now);
  see(9.85, 1400, 3);
  EXPECT_FALSE(watch->step(now)) << "the edge of what was learned";
  const int beside_before = points_seen(9.8);
  see(9.95, 1500, 20);
  EXPECT_EQ(points_seen(9.8), beside_before) << "what is no longer learning counts for its own cell alone";
}

}  // namespace
}  // namespace berm::kernel::test
