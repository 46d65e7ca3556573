// The operator's hands: up, looking about first.
#include <gtest/gtest.h>

#include <numbers>

#include "plant/machine/kinematics.hpp"
#include "plant/process/hand_lift.hpp"

namespace berm::plant {
namespace {

constexpr double kCycle = 0.01, kDegree = std::numbers::pi / 180;

struct Lifted {
  PlantProfile profile = load_plant_profile(BERM_PLANT_PROFILES "/zx200_plant.toml");
  HandLift hands{profile};
  JointState joints{{40 * kDegree, -10 * kDegree, -70 * kDegree, -60 * kDegree}, {}};
  double t = 0.0;
  void until(double end, bool somebody = false) {
    for (; t < end; t += kCycle) {
      hands.step(t, joints, somebody);
      for (std::size_t j = 0; j < 4; ++j) joints.angle[j] += hands.levers()[j] * kCycle;
    }
  }
};

TEST(HandLift, RaisesTheBoomAloneUntilTheScannersSeeUnderTheBucket) {
  Lifted l;
  const JointState before = l.joints;
  l.hands.begin(0.0);
  l.until(2.5);
  EXPECT_EQ(l.joints.angle, before.angle) << "he looks about first";
  l.until(30.0);
  EXPECT_TRUE(l.hands.done());
  const double heads = l.profile.shape.scanner[0].position[2];
  EXPECT_GT(bucket_underside(l.profile.shape, l.joints), heads);
  EXPECT_LT(bucket_underside(l.profile.shape, l.joints), heads + 0.3) << "and no higher";
  for (const std::size_t j : {0U, 2U, 3U}) EXPECT_DOUBLE_EQ(l.joints.angle[j], before.angle[j]);
}

TEST(HandLift, TouchesNoLeverWhileSomebodyIsNear) {
  Lifted l;
  const double before = l.joints.angle[1];
  l.hands.begin(0.0);
  l.until(20.0, true);
  EXPECT_DOUBLE_EQ(l.joints.angle[1], before);
  l.until(24.0);
  EXPECT_GT(l.joints.angle[1], before);
  const double so_far = l.joints.angle[1];
  l.until(26.0, true);
  EXPECT_DOUBLE_EQ(l.joints.angle[1], so_far) << "he lets go when somebody comes";
  EXPECT_FALSE(l.hands.done());
}

TEST(HandLift, EndsAtTheBoomsStopToo) {
  Lifted l;
  l.joints.angle[2] = -150 * kDegree;  // so far drawn in that the bucket stays low
  l.joints.angle[3] = -40 * kDegree;
  l.hands.begin(0.0);
  l.until(60.0);
  EXPECT_TRUE(l.hands.done());
  EXPECT_LE(l.joints.angle[1], l.profile.dynamics.joint[1].high);
  EXPECT_GT(l.joints.angle[1], l.profile.dynamics.joint[1].high - 2 * kDegree) << "it was the stop that ended it";
}

}  // namespace
}  // namespace berm::plant
