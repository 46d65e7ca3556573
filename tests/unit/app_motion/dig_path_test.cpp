#include <gtest/gtest.h>

#include "app_bench/bench_machine.hpp"
#include "motion/dig_path.hpp"

namespace {

using namespace berm::app;

const std::vector<DigWaypoint> drag{{7.3, -0.8, radians(-92)}, {7.2, -1.9, radians(-95)}, {6.4, -1.3, radians(-125)}, {5.6, -0.2, radians(-170)}};

TEST(DigPath, PassesItsWaypointsWithinTheJointsRanges) {
  const MachineModel m = berm::app_bench::zx200();
  const auto path = DigPath::solve(m, drag);
  ASSERT_TRUE(path);
  const ArmPoints from = forward(m, path->at(0.0)), to = forward(m, path->at(path->length()));
  EXPECT_NEAR(from.tip.r, 7.3, 1e-6);
  EXPECT_NEAR(from.tip.z, -0.8, 1e-6);
  EXPECT_NEAR(to.tip.r, 5.6, 1e-6);
  EXPECT_NEAR(to.tip.z, -0.2, 1e-6);
  EXPECT_NEAR(to.bucket_attitude, radians(-170), radians(1));
  for (double s = 0.0; s < path->length(); s += 0.01) {
    const Joints q = path->at(s);
    for (const std::size_t j : {boom, stick, bucket}) {
      EXPECT_GT(q[j], m.joint[j].low + radians(7.0));
      EXPECT_LT(q[j], m.joint[j].high - radians(7.0));
    }
  }
}

// Far out the stick's range forbids the attitude.
TEST(DigPath, GoesAlongAJointsRangeWithoutJumps) {
  const MachineModel m = berm::app_bench::zx200();
  const auto path = DigPath::solve(m, {{8.0, -1.0, radians(-95)}, {7.2, -2.2, radians(-95)}});
  ASSERT_TRUE(path);
  const double farthest_out = m.joint[stick].high - radians(7.5);
  double along_range = 0.0;
  for (double s = 0.0; s + 0.04 < path->length(); s += 0.04) {
    const Joints q = path->at(s), next = path->at(s + 0.04);
    if (q[stick] > farthest_out - radians(0.05)) along_range += 0.04;
    for (const std::size_t j : {boom, stick, bucket}) EXPECT_LT(std::fabs(next[j] - q[j]), radians(0.6)) << j << " at " << s;
  }
  EXPECT_GT(along_range, 0.3);
}

TEST(DigPath, OutOfReachIsRefused) { EXPECT_FALSE(DigPath::solve(berm::app_bench::zx200(), {{7.0, -1.0, radians(-90)}, {11.0, -1.0, radians(-90)}})); }

TEST(DigFollower, BringsTheTipAlongThePath) {
  const MachineModel m = berm::app_bench::zx200();
  auto path = DigPath::solve(m, drag);
  ASSERT_TRUE(path);
  ArmController arm(m);
  DigFollower follower;
  Joints q = path->at(0.0), v{};
  std::vector<JointModel> plant;
  for (std::size_t j = 0; j < joints; ++j) {
    plant.emplace_back(response_of(m, j), m.cycle);
    plant.back().reset(q[j], 0.0);
  }
  const double length = path->length();
  const DigPath reference = *path;
  follower.begin(std::move(*path));
  double farthest_off = 0.0;
  int k = 0;
  for (; k < 1500 && !follower.finished(); ++k) {
    const Joints command = follower.step(m, arm, 0.0, 0.75, q, v);
    EXPECT_EQ(command[swing], 0.0);
    arm.sent(command);
    for (std::size_t j = 0; j < joints; ++j) {
      plant[j].advance(command[j]);
      q[j] = plant[j].angle();
      v[j] = plant[j].velocity();
    }
    double nearest = 1e9;
    for (double s = 0.0; s <= length; s += 0.02) {
      const ArmPoints a = forward(m, q), b = forward(m, reference.at(s));
      nearest = std::min(nearest, std::hypot(a.tip.r - b.tip.r, a.tip.z - b.tip.z));
    }
    farthest_off = std::max(farthest_off, nearest);
  }
  EXPECT_TRUE(follower.finished());
  EXPECT_LT(k * m.cycle, 10.0);
  EXPECT_LT(farthest_off, 0.22);  // it cuts the corner where the drag turns inward
}

TEST(DigFollower, WaitsForJointsThatSoilHolds) {
  const MachineModel m = berm::app_bench::zx200();
  auto path = DigPath::solve(m, drag);
  ASSERT_TRUE(path);
  const Joints held = path->at(0.0);
  ArmController arm(m);
  DigFollower follower;
  follower.begin(std::move(*path));
  for (int k = 0; k < 600; ++k) arm.sent(follower.step(m, arm, 0.0, 0.75, held, {}));
  EXPECT_FALSE(follower.finished());
  EXPECT_GT(follower.stalled_s(), 0.3);
}

TEST(DigFollower, AsksForNothingBeforeAPathWasBegun) {
  const MachineModel m = berm::app_bench::zx200();
  ArmController arm(m);
  DigFollower follower;
  for (const double v : follower.step(m, arm, 0.0, 1.0, DigPath::solve(m, drag)->at(0.0), {})) EXPECT_EQ(v, 0.0);
}

// Follows a short path without a machine that lags: the joints are where the reference was.
Joints follow_to_end(const MachineModel& m, const DigFollower::Departure& departure) {
  ArmController arm(m);
  DigFollower follower;
  follower.begin(*DigPath::solve(m, drag));
  Joints angle = DigPath::solve(m, drag)->at(0.0), velocity{};
  for (int k = 0; k < 1500 && !follower.finished(); ++k) {
    arm.heard(velocity, {-9, -9, -9, -9}, {9, 9, 9, 9});
    follower.depart(departure);
    velocity = follower.step(m, arm, 0.0, 1.0, angle, velocity);
    arm.asked(velocity);
    for (const std::size_t j : {boom, stick, bucket}) angle[j] += velocity[j] * m.cycle;
  }
  EXPECT_TRUE(follower.finished());
  return angle;
}

TEST(DigFollower, DepartsFromThePathAsFarAsItIsTold) {
  const MachineModel m = berm::app_bench::zx200();
  const ArmPoints on = forward(m, follow_to_end(m, {})), under = forward(m, follow_to_end(m, {-0.4, 0.0})), curled = forward(m, follow_to_end(m, {0.0, radians(-178)}));
  EXPECT_NEAR(on.tip.z, -0.2, 0.15);
  EXPECT_NEAR(under.tip.z - on.tip.z, -0.4, 0.05);
  EXPECT_NEAR(under.tip.r, on.tip.r, 0.05);
  EXPECT_LT(curled.bucket_attitude, on.bucket_attitude - radians(4));
}

}  // namespace
