#include <gtest/gtest.h>

#include "app_bench/bench_machine.hpp"
#include "motion/arm_kinematics.hpp"

namespace {

using namespace berm::app;

TEST(ArmKinematics, StraightAndLevelReachesTheSumOfTheLinks) {
  const MachineModel m = berm::app_bench::zx200();
  const ArmPoints p = forward(m, 0.0, 0.0, 0.0);
  EXPECT_NEAR(p.tip.r, 0.2277 + 5.648 + 2.889 + 1.562, 1e-12);
  EXPECT_NEAR(p.tip.z, 1.957, 1e-12);
}

TEST(ArmKinematics, HangingBucketPointsDown) {
  const MachineModel m = berm::app_bench::zx200();
  const ArmPoints p = forward(m, radians(30.0), radians(-90.0), radians(-30.0));
  EXPECT_NEAR(p.bucket_attitude, radians(-90.0), 1e-12);
  EXPECT_NEAR(p.bucket_pin.z - p.tip.z, 1.562, 1e-12);
  EXPECT_NEAR(p.tip.r, p.bucket_pin.r, 1e-12);
}

TEST(ArmKinematics, SwingIsPositiveToTheLeft) {
  const Point p = in_base({7.0, -1.0}, radians(90.0));
  EXPECT_NEAR(p.x, 0.0, 1e-12);
  EXPECT_NEAR(p.y, 7.0, 1e-12);
  EXPECT_NEAR(p.z, -1.0, 1e-12);
}

TEST(ArmKinematics, OutOfReachOrRangeHasNoSolution) {
  const MachineModel m = berm::app_bench::zx200();
  EXPECT_FALSE(inverse_pin(m, {9.5, 2.0}, radians(-90.0)));   // beyond boom and stick
  EXPECT_FALSE(inverse_pin(m, {8.6, 2.0}, radians(-90.0)));   // would need the stick straighter than -45 degrees
  EXPECT_FALSE(inverse_pin(m, {0.5, 2.0}, radians(-90.0)));   // inside the machine
  EXPECT_FALSE(inverse_tip(m, {7.0, 0.0}, radians(30.0)));    // bucket flung out
  const auto q = inverse_pin(m, {6.0, 2.9}, radians(-175.0));
  ASSERT_TRUE(q);
  EXPECT_FALSE(inverse_pin(m, {6.0, 2.9}, radians(-175.0), radians(40.0)));  // the guard takes it away
}

}  // namespace
