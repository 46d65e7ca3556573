#include <gtest/gtest.h>

#include "machine_file.hpp"
#include "plant/machine/pan_servo.hpp"

namespace berm::plant::testing {
namespace {

TEST(PanServo, ReachesItsGoalWithinRateAndAccelerationWithoutOvershoot) {
  const ScannerMount mount = profile().shape.scanner[0];
  PanServo servo(mount);
  double speed = 0.0, t = 0.0;
  for (; t < 3.0; t += 0.01) {
    servo.step(0.01, 1.2, 1.5);
    EXPECT_LE(std::abs(servo.velocity() - speed), mount.pan_acceleration * 0.01 + 1e-9);
    EXPECT_LE(servo.velocity(), 1.5 + 1e-9);
    EXPECT_LE(servo.angle(), 1.2 + 0.002);
    speed = servo.velocity();
  }
  EXPECT_NEAR(servo.angle(), 1.2, 0.001);
}

TEST(PanServo, StaysWithinItsLimits) {
  const ScannerMount mount = profile().shape.scanner[0];
  PanServo servo(mount);
  for (int i = 0; i < 500; ++i) servo.step(0.01, 10.0, 100.0);
  EXPECT_LE(servo.angle(), mount.pan_high);
  EXPECT_NEAR(servo.angle(), mount.pan_high, 0.001);
  for (int i = 0; i < 500; ++i) {
    servo.step(0.01, -10.0, 100.0);
    EXPECT_LE(std::abs(servo.velocity()), mount.pan_rate_max + 1e-9);
  }
  EXPECT_NEAR(servo.angle(), mount.pan_low, 0.001);
}

}  // namespace
}  // namespace berm::plant::testing
