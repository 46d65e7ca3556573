#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "machine_file.hpp"
#include "plant/machine/joint_dynamics.hpp"

namespace berm::plant::testing {
namespace {

constexpr double kCycle = 0.01;
const DigForces kFree{};

TEST(JointDynamics, CommandTakesEffectAfterItsDeadTime) {
  const PlantProfile p = profile();
  for (std::size_t j = 0; j < 4; ++j) {
    JointDynamics d(p.dynamics, p.shape, 1, pose(0, 45, -100, -60));
    std::array<double, 4> command{};
    command[j] = 0.4;
    double t = 0.0;
    while (d.state().velocity[j] == 0.0 && t < 1.0) {
      d.step(kCycle, Drive::obey, command, kFree, 0);
      t += kCycle;
    }
    EXPECT_GT(t, p.dynamics.joint[j].dead_time - 0.001) << kJoints[j];
    EXPECT_LT(t, p.dynamics.joint[j].dead_time + 1.5 * kCycle) << kJoints[j];
  }
}

TEST(JointDynamics, ReachesTheCommandedSpeedWithinItsRipple) {
  const PlantProfile p = profile();
  for (std::size_t j = 0; j < 4; ++j) {
    JointDynamics d(p.dynamics, p.shape, 3, pose(-90, -40, -140, -130));
    std::array<double, 4> command{};
    command[j] = 0.3;
    for (int i = 0; i < 300; ++i) d.step(kCycle, Drive::obey, command, kFree, 500);
    if (j == 0) { EXPECT_NEAR(d.state().velocity[j], 0.3, 0.3 * p.dynamics.joint[j].ripple + 1e-3); }
    EXPECT_GT(d.state().angle[j], pose(-90, -40, -140, -130).angle[j] + 0.3) << kJoints[j];
  }
}

TEST(JointDynamics, DeadBandMovesNothing) {
  const PlantProfile p = profile();
  JointDynamics d(p.dynamics, p.shape, 1, pose(0, 45, -100, -60));
  std::array<double, 4> command{};
  for (std::size_t j = 0; j < 4; ++j) command[j] = 0.9 * p.dynamics.joint[j].dead_band;
  for (int i = 0; i < 200; ++i) d.step(kCycle, Drive::obey, command, kFree, 0);
  EXPECT_EQ(d.state().angle, pose(0, 45, -100, -60).angle);
}

TEST(JointDynamics, SharedPumpFlowScalesAllJoints) {
  const PlantProfile p = profile();
  JointDynamics d(p.dynamics, p.shape, 1, pose(0, -50, -140, -130));
  std::array<double, 4> command{};
  for (std::size_t j = 0; j < 4; ++j) command[j] = p.dynamics.joint[j].velocity_max;
  double largest = 0.0;
  for (int i = 0; i < 400; ++i) {
    d.step(kCycle, Drive::obey, command, kFree, 0);
    double flow = 0.0;
    for (std::size_t j = 0; j < 4; ++j) flow += std::abs(d.state().velocity[j]) / p.dynamics.joint[j].velocity_max;
    largest = std::max(largest, flow);
  }
  EXPECT_LE(largest, p.dynamics.flow_limit * 1.001);
  EXPECT_GT(largest, 1.5);
}

TEST(JointDynamics, SoilSlowsAndStopsAJoint) {
  const PlantProfile p = profile();
  JointDynamics d(p.dynamics, p.shape, 1, pose(0, 30, -60, -60));
  const std::array<double, 4> command{0, 0, -0.5, 0};
  for (int i = 0; i < 60; ++i) d.step(kCycle, Drive::obey, command, kFree, 0);
  EXPECT_LT(d.state().velocity[2], -0.45);
  DigForces half{}, full{};
  half.resist_speed_factor[2] = 0.5;
  full.resist_speed_factor[2] = 0.0;
  for (int i = 0; i < 30; ++i) d.step(kCycle, Drive::obey, command, half, 0);
  EXPECT_NEAR(d.state().velocity[2], -0.25, 0.01);
  for (int i = 0; i < 30; ++i) d.step(kCycle, Drive::obey, command, full, 0);
  EXPECT_EQ(d.state().velocity[2], 0.0);
}

TEST(JointDynamics, HardStopsHold) {
  const PlantProfile p = profile();
  JointDynamics d(p.dynamics, p.shape, 1, pose(0, 60, -60, 20));
  for (int i = 0; i < 500; ++i) d.step(kCycle, Drive::obey, {0, 0.4, 1.0, 1.0}, kFree, 0);
  for (std::size_t j = 1; j < 4; ++j) {
    EXPECT_LE(d.state().angle[j], p.dynamics.joint[j].high) << kJoints[j];
    EXPECT_NEAR(d.state().angle[j], p.dynamics.joint[j].high, 0.01) << kJoints[j];
  }
}

TEST(JointDynamics, SameSeedSameMotionOtherSeedOtherMotion) {
  const PlantProfile p = profile();
  const auto run = [&](std::uint64_t seed) {
    JointDynamics d(p.dynamics, p.shape, seed, pose(0, 45, -100, -60));
    for (int i = 0; i < 200; ++i) d.step(kCycle, Drive::obey, {0.5, -0.1, 0.2, 0.1}, kFree, 0);
    return d.state();
  };
  EXPECT_EQ(run(5).angle, run(5).angle);
  EXPECT_NE(run(5).angle, run(6).angle);
}

// Over the kernel's horizon (state latency, command latency, one cycle) no command sequence takes a joint faster away from standstill, in either
// direction, than acceleration_max allows: also not through a braked reversal.
TEST(JointDynamics, NoCommandSequenceExceedsTheKernelsAccelerationBound) {
  const PlantProfile p = profile();
  const MachineFile m;
  constexpr std::size_t kHorizon = 13;
  std::mt19937_64 random(20240611);
  for (int trial = 0; trial < 40; ++trial) {
    JointDynamics d(p.dynamics, p.shape, static_cast<std::uint64_t>(trial), pose(0, 20, -95, -60));
    std::deque<std::array<double, 4>> past;
    std::array<double, 4> command{};
    for (int i = 0; i < 1500; ++i) {
      if (random() % 8 == 0) {
        for (std::size_t j = 0; j < 4; ++j) {
          const double unit = static_cast<double>(random() % 2001) / 1000.0 - 1.0;
          command[j] = random() % 4 == 0 ? 0.0 : unit * (random() % 2 == 0 ? 0.1 : 1.0) * m.velocity_max[j];
        }
      }
      d.step(kCycle, random() % 200 == 0 ? Drive::brake : Drive::obey, command, kFree, static_cast<double>(trial % 3) * 900.0);
      for (std::size_t j = 0; j < 4; ++j) {  // a hard stop takes the speed at once: the window begins anew behind it
        if (d.state().angle[j] <= m.low[j] || d.state().angle[j] >= m.high[j]) past.clear();
      }
      past.push_front(d.state().velocity);
      if (past.size() > kHorizon + 1) past.pop_back();
      for (std::size_t back = 1; back < past.size(); ++back) {
        for (std::size_t j = 0; j < 4; ++j) {
          const double change = m.acceleration[j] * kCycle * static_cast<double>(back) + 1e-9;
          ASSERT_LE(past[0][j], std::max(0.0, past[back][j] + change)) << kJoints[j] << " trial " << trial << " cycle " << i << " back " << back;
          ASSERT_GE(past[0][j], std::min(0.0, past[back][j] - change)) << kJoints[j] << " trial " << trial << " cycle " << i << " back " << back;
          ASSERT_LE(std::abs(past[0][j]), m.velocity_max[j]) << kJoints[j];
        }
      }
    }
  }
}

// The boom going up at a steady speed, then this for that long.
struct BrokenBoom {
  PlantProfile p = profile();
  JointDynamics d{p.dynamics, p.shape, 1, pose(0, -20, -100, -60)};
  void run(Drive drive, double boom, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kCycle + 0.5); ++i) d.step(kCycle, drive, {0.0, boom, 0.0, 0.0}, kFree, 0);
  }
  double speed() const { return d.state().velocity[1]; }
  double angle() const { return d.state().angle[1]; }
};

TEST(MachineFault, AWeakBrakeTakesTheWayByItsShareLonger) {
  double way[2];
  for (const bool weak : {false, true}) {
    BrokenBoom boom;
    boom.run(Drive::obey, 0.3, 1.5);
    if (weak) boom.d.break_joint({MachineFaultKind::weak_brake, 1, 0.0, 0.5});
    const double from = boom.angle();
    boom.run(Drive::brake, 0.0, 2.0);  // power or not
    EXPECT_EQ(boom.speed(), 0.0);
    EXPECT_FALSE(boom.d.out_of_control(1));
    way[weak ? 1 : 0] = boom.angle() - from;
  }
  EXPECT_NEAR(way[1], 2.0 * way[0], 0.001);
}

TEST(MachineFault, AStuckValveGoesOnUntilPowerIsRemoved) {
  BrokenBoom boom;
  boom.d.break_joint({MachineFaultKind::stuck_valve, 1, 0.0, 0.0});
  boom.run(Drive::obey, 0.0, 0.2);
  EXPECT_FALSE(boom.d.out_of_control(1)) << "it sticks when it is next opened";
  boom.run(Drive::obey, 0.3, 1.0);
  EXPECT_TRUE(boom.d.out_of_control(1));
  boom.run(Drive::obey, 0.0, 0.5);
  EXPECT_NEAR(boom.speed(), 0.3, 0.01);
  boom.run(Drive::obey, -0.3, 0.5);
  EXPECT_NEAR(boom.speed(), 0.3, 0.01);
  boom.run(Drive::brake, 0.0, 1.0);
  EXPECT_EQ(boom.speed(), 0.0);
}

TEST(MachineFault, ARunawayMovesUntoldUntilPowerIsRemoved) {
  BrokenBoom boom;
  boom.run(Drive::obey, 0.0, 0.5);
  ASSERT_EQ(boom.speed(), 0.0);
  boom.d.break_joint({MachineFaultKind::runaway, 1, 0.0, 0.5});
  boom.run(Drive::brake, 0.0, 0.5);
  EXPECT_EQ(boom.speed(), 0.0) << "not without power";
  boom.run(Drive::obey, 0.0, 1.0);
  EXPECT_NEAR(boom.speed(), 0.5 * boom.p.dynamics.joint[1].velocity_max, 0.01);
  boom.run(Drive::brake, 0.0, 1.0);
  EXPECT_EQ(boom.speed(), 0.0);
}

TEST(MachineFault, AMendedJointObeysAndBrakesAsBefore) {
  double way[2];
  for (const bool was_broken : {false, true}) {
    BrokenBoom boom;
    for (const MachineFaultKind kind : {MachineFaultKind::weak_brake, MachineFaultKind::stuck_valve, MachineFaultKind::runaway}) {
      if (!was_broken) continue;
      const MachineFault fault{kind, 1, 0.0, 0.5};
      boom.d.break_joint(fault);
      boom.d.mend_joint(fault);
    }
    boom.run(Drive::obey, 0.3, 1.5);
    EXPECT_FALSE(boom.d.out_of_control(1));
    const double from = boom.angle();
    boom.run(Drive::obey, 0.0, 2.0);
    EXPECT_EQ(boom.speed(), 0.0);
    way[was_broken ? 1 : 0] = boom.angle() - from;
  }
  EXPECT_EQ(way[0], way[1]);
}

TEST(MachineFault, AStuckValveThatIsMendedLetsGo) {
  BrokenBoom boom;
  const MachineFault fault{MachineFaultKind::stuck_valve, 1, 0.0, 0.0};
  boom.d.break_joint(fault);
  boom.run(Drive::obey, 0.3, 1.0);
  ASSERT_TRUE(boom.d.out_of_control(1));
  boom.d.mend_joint(fault);
  boom.run(Drive::obey, 0.0, 1.0);
  EXPECT_EQ(boom.speed(), 0.0);
  boom.run(Drive::obey, 0.3, 1.0);
  EXPECT_FALSE(boom.d.out_of_control(1)) << "it does not stick again";
}

}  // namespace
}  // namespace berm::plant::testing
