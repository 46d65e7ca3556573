#include <gtest/gtest.h>

#include <algorithm>

#include "app_bench/bench_machine.hpp"
#include "motion/arm_kinematics.hpp"
#include "motion/reach_preview.hpp"

namespace {

using namespace berm::app;

const Joints carry{0.0, radians(38.3), radians(-100.7), radians(-115.6)};

TEST(BucketUnderside, IsTheShellsLowestPointWhenCurledAndTheTeethWhenHanging) {
  const MachineModel m = berm::app_bench::zx200();
  const ArmPoints arm = forward(m, carry);
  EXPECT_NEAR(bucket_underside(m, carry), arm.bucket_pin.z - 0.85, 0.06);  // mouth up: the shell's outline is 0.85 m deep
  const Joints hanging{0.0, radians(30.0), radians(-80.0), radians(-40.0)};
  EXPECT_NEAR(bucket_underside(m, hanging), forward(m, hanging).tip.z, 0.08);
}

TEST(BucketUnderside, ClearsTheTruckInTheCarryingPose) {
  const MachineModel m = berm::app_bench::zx200();
  EXPECT_GT(bucket_underside(m, carry), 0.30 + 0.30 + 0.5);  // wall, the kernel's margin, the spread of a stop
  EXPECT_LT(reach_of(m, carry), m.braking.reach.front());    // first row of the braking table
}

// Level and straight a link's frame lies along the swing plane's r: the outline's own x, from its pin on.
TEST(ExtentOf, IsTheOutlinesWhereTheLinkLiesLevelAndNoFartherThanTheReach) {
  const MachineModel m = berm::app_bench::zx200();
  const Joints level{};
  const ArmPoints arm = forward(m, level);
  for (const Prism& part : m.parts) {
    double low = 1e9, high = -1e9;
    for (const auto& point : part.outline) low = std::min(low, point[0]), high = std::max(high, point[0]);
    const double pin = part.link == boom ? arm.boom_pin.r : part.link == stick ? arm.stick_pin.r : arm.bucket_pin.r;
    EXPECT_NEAR(extent_of(m, part, level).near, pin + low, 1e-9) << part.link;
    EXPECT_NEAR(extent_of(m, part, level).far, pin + high, 1e-9) << part.link;
    EXPECT_LE(extent_of(m, part, carry).far, reach_of(m, carry)) << part.link;
  }
}

TEST(StopTravel, GrowsWithSpeedAndReachAndCoversTheTable) {
  const MachineModel m = berm::app_bench::zx200();
  double before = 0.0;
  for (double speed = 0.0; speed <= radians(50.0); speed += radians(1.0)) {
    const double travel = stop_travel(m, swing, m.braking.reach[1], speed);
    EXPECT_GE(travel, before);
    before = travel;
  }
  // Full speed at the second row's reach: the table's last column in its second row, and the way during the latencies and until a machine that hears nothing brakes by itself.
  const double known = m.braking.angle[swing][1].back() + radians(50.0) * (m.state_latency + m.command_latency + heartbeat_silence + kernel_sends_within);
  EXPECT_GE(before, known);
  EXPECT_LE(before, known + radians(1.0));
  EXPECT_GT(stop_travel(m, swing, 9.0, radians(30.0)), stop_travel(m, swing, 6.0, radians(30.0)));
}

TEST(StopTravel, AJointThatIsSureToMoveTheOtherWayNeedsNone) {
  MachineModel m = berm::app_bench::zx200();
  for (auto& row : m.braking.angle[swing]) row.front() = 0.5 * row[1];  // the least that any motion needs
  EXPECT_NEAR(stop_travel(m, swing, 7.0, radians(-10.0)), m.joint[swing].angle_error, 1e-12);
  EXPECT_GT(stop_travel(m, swing, 7.0, 0.0), m.joint[swing].angle_error + 0.5 * m.braking.angle[swing].front()[1]);
}

TEST(Preview, LiesAroundThePoseAndAheadOfTheMotion) {
  const MachineModel m = berm::app_bench::zx200();
  const ReachIntervals rest = preview(m, carry, {});
  const ReachIntervals moving = preview(m, carry, {radians(30.0), 0.0, 0.0, 0.0});
  for (std::size_t j = 0; j < joints; ++j) {
    EXPECT_LT(rest.low[j], carry[j]);
    EXPECT_GT(rest.high[j], carry[j]);
  }
  EXPECT_GT(moving.high[swing] - carry[swing], radians(30.0));
  EXPECT_LT(carry[swing] - moving.low[swing], radians(1.0));
  EXPECT_LT(rest.swing_speed, m.dig_swing_limit);
  EXPECT_GT(moving.swing_speed, m.dig_swing_limit);
}

TEST(LowerEdge, OverIntervalsIsNeverAboveThatOfAPoseInside) {
  const MachineModel m = berm::app_bench::zx200();
  const ReachIntervals box = preview(m, carry, {0.0, radians(-15.0), radians(20.0), radians(20.0)});
  const LowerEdge whole(m, box);
  for (const double t : {0.0, 0.3, 0.5, 0.8, 1.0}) {
    Joints inside = carry;
    for (const std::size_t j : {boom, stick, bucket}) inside[j] = box.low[j] + t * (box.high[j] - box.low[j]);
    EXPECT_LE(whole.lowest(), lower_edge(m, inside).lowest() + 0.02);
    EXPECT_GE(whole.reach(), lower_edge(m, inside).reach() - 0.02);
  }
}

TEST(WithinRange, SlowsBeforeTheEndOfTheRange) {
  const MachineModel m = berm::app_bench::zx200();
  const double top = m.joint[boom].high;
  const double fast = radians(20.0);
  EXPECT_EQ(within_range(m, boom, 7.0, top - radians(30.0), fast), fast);
  const double near = within_range(m, boom, 7.0, top - radians(7.0), fast);
  EXPECT_GT(near, 0.0);
  EXPECT_LT(near, fast);
  EXPECT_EQ(within_range(m, boom, 7.0, top - radians(0.1), fast), 0.0);
  EXPECT_EQ(within_range(m, boom, 7.0, top - radians(0.1), -fast), -fast);  // away from the end at any speed
}

}  // namespace
