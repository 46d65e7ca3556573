#include <gtest/gtest.h>

#include "motion/joint_model.hpp"

namespace {

using namespace berm::app;

constexpr JointResponse response{0.1, 0.5, 1.0};

TEST(JointModel, NothingMovesBeforeTheDeadTime) {
  JointModel joint(response, 0.01);
  joint.reset(0.0, 0.0);
  for (int k = 0; k < 10; ++k) joint.advance(1.0);
  EXPECT_EQ(joint.angle(), 0.0);
  joint.advance(1.0);
  EXPECT_GT(joint.angle(), 0.0);
}

TEST(JointModel, KeepsAccelerationAndVelocityLimits) {
  JointModel joint(response, 0.01);
  joint.reset(0.0, 0.0);
  double before = 0.0;
  for (int k = 0; k < 400; ++k) {
    joint.advance(5.0);
    EXPECT_LE(joint.velocity() - before, 0.5 * 0.01 + 1e-12);
    EXPECT_LE(joint.velocity(), 1.0);
    before = joint.velocity();
  }
  EXPECT_DOUBLE_EQ(joint.velocity(), 1.0);
}

TEST(JointModel, PredictionEqualsWhatThenHappens) {
  JointModel plant(response, 0.01), predictor(response, 0.01);
  plant.reset(0.2, 0.0);
  for (int k = 0; k < 60; ++k) {
    const double command = k < 30 ? 0.8 : -0.3;
    plant.advance(command);
    predictor.remember(command);
  }
  const JointModel::State then = predictor.predict(plant.angle(), plant.velocity());
  for (int k = 0; k < 10; ++k) plant.advance(0.0);  // these act later
  EXPECT_NEAR(then.angle, plant.angle(), 1e-12);
  EXPECT_NEAR(then.velocity, plant.velocity(), 1e-12);
}

TEST(TimeToReach, TriangleAndTrapezoid) {
  EXPECT_EQ(time_to_reach(response, 1.0, 1.0), 0.0);
  EXPECT_NEAR(time_to_reach(response, 0.0, 0.5), 0.1 + 2.0, 1e-12);          // half speeding up, half braking: 2 sqrt(d / a)
  EXPECT_NEAR(time_to_reach(response, 0.0, -5.0), 0.1 + 2.0 + 2.0 + 3.0, 1e-12);  // 2 s up, 3 s at speed, 2 s down
}

}  // namespace
