#include <gtest/gtest.h>

#include "guarded_frames.hpp"
#include "machine_file.hpp"

namespace berm::plant::testing {
namespace {

constexpr std::array<double, 4> kMove{0.5, 0.1, -0.2, 0.3};

struct Bench {
  PlantProfile profile_ = profile();
  MachineController controller{profile_};
  KernelSide kernel{controller};
  JointDynamics joints{profile_.dynamics, profile_.shape, 1, pose(0, 45, -100, -60)};

  // One cycle that begins at t, after what the kernel sent at t.
  void cycle(double t, bool standstill = false) {
    controller.decide(t, standstill);
    joints.step(0.01, controller.drive(), controller.command(), DigForces{}, 0);
  }
};

// verifies: IF-CAN-14 (the simulated machine: without a Heartbeat)
TEST(MachineController, DoesNotMoveBeforeAHeartbeat) {
  Bench b;
  for (int k = 0; k < 100; ++k) {
    b.kernel.velocity(0.01 * k, kMove);
    b.cycle(0.01 * k);
  }
  EXPECT_EQ(b.joints.state().angle, pose(0, 45, -100, -60).angle);
  EXPECT_FALSE(b.controller.pilot_unlocked());
}

TEST(MachineController, MovesOnAnEnabledHeartbeatAndAVelocity) {
  Bench b;
  b.kernel.heartbeat(0.0, true);
  b.kernel.velocity(0.0, kMove);
  b.controller.decide(0.0, true);
  EXPECT_EQ(b.controller.drive(), Drive::obey);
  EXPECT_TRUE(b.controller.pilot_unlocked());
  for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(b.controller.command()[j], kMove[j], 0.00026);
}

TEST(MachineController, ZeroFrameIsRefusedAndMovesNothing) {
  Bench b;
  for (int k = 0; k < 200; ++k) {
    b.kernel.heartbeat(0.01 * k, true);
    b.kernel.zero_frame(0.01 * k);
    b.cycle(0.01 * k);
    ASSERT_EQ(b.controller.command(), (std::array<double, 4>{}));
  }
  EXPECT_EQ(b.controller.refused_frames(), 200u);
  EXPECT_EQ(b.joints.state().angle, pose(0, 45, -100, -60).angle);
}

TEST(MachineController, VelocityBeyondALimitIsRefusedWhole) {
  Bench b;
  for (std::size_t j = 0; j < 4; ++j) {
    std::array<double, 4> fast{};
    fast[j] = b.profile_.dynamics.joint[j].velocity_max + 0.002;
    b.kernel.heartbeat(0.0, true);
    b.kernel.velocity(0.0, fast);
    b.controller.decide(0.0, true);
    EXPECT_EQ(b.controller.command(), (std::array<double, 4>{})) << kJoints[j];
    EXPECT_EQ(b.controller.refused_frames(), j + 1);
  }
  std::array<double, 4> limit{};
  for (std::size_t j = 0; j < 4; ++j) limit[j] = -b.profile_.dynamics.joint[j].velocity_max;
  b.kernel.velocity(0.0, limit);
  b.controller.decide(0.0, true);
  for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(b.controller.command()[j], limit[j], 0.0006) << kJoints[j];
}

// verifies: IF-CAN-14 (the simulated machine: 50 ms, then power is removed)
TEST(MachineController, HeartbeatSilenceStopsTheMachine) {
  Bench b;
  int k = 0;
  for (; k < 200; ++k) {
    b.kernel.heartbeat(0.01 * k, true);
    b.kernel.velocity(0.01 * k, kMove);
    b.cycle(0.01 * k);
  }
  const double last = 0.01 * (k - 1);
  ASSERT_GT(b.joints.state().velocity[0], 0.4);
  for (; 0.01 * k <= last + 0.05 + 1e-9; ++k) {
    b.kernel.velocity(0.01 * k, kMove);
    b.cycle(0.01 * k);
    EXPECT_EQ(b.controller.drive(), Drive::obey) << "within 50 ms";
  }
  b.kernel.velocity(0.01 * k, kMove);
  b.cycle(0.01 * k++);
  EXPECT_EQ(b.controller.drive(), Drive::brake);
  EXPECT_FALSE(b.controller.pilot_unlocked());
  const double angle = b.joints.state().angle[0];
  for (int i = 0; i < 300; ++i, ++k) {
    b.kernel.velocity(0.01 * k, kMove);
    b.cycle(0.01 * k);
  }
  EXPECT_EQ(b.joints.state().velocity, (std::array<double, 4>{}));
  EXPECT_LT(b.joints.state().angle[0] - angle, radians(30));
}

// verifies: IF-CAN-14 (the simulated machine: unguarded ones)
TEST(MachineController, UnguardedHeartbeatsCountAsSilence) {
  Bench b;
  b.kernel.heartbeat(0.0, true);
  const berm_heartbeat m{true, 255, 2, 0, 9, 0};
  for (int k = 0; k < 20; ++k) {
    b.controller.receive(berm_encode_heartbeat(&m), 0.01 * k);
    b.controller.decide(0.01 * k, false);
    EXPECT_EQ(b.controller.drive() == Drive::obey, k <= 5) << k;
  }
}

// verifies: IF-CAN-14 (the simulated machine: the categories)
TEST(MachineController, CategoryOneKeepsPilotPressureUntilStandstillCategoryZeroDoesNot) {
  for (const std::uint8_t category : {std::uint8_t{0}, std::uint8_t{1}}) {
    Bench b;
    b.kernel.heartbeat(0.0, true);
    b.controller.decide(0.0, true);
    ASSERT_TRUE(b.controller.pilot_unlocked());
    b.kernel.heartbeat(0.01, false, category);
    b.controller.decide(0.01, false);
    EXPECT_EQ(b.controller.drive(), Drive::brake);
    EXPECT_EQ(b.controller.pilot_unlocked(), category == 1);
    b.kernel.heartbeat(0.02, false, category);
    b.controller.decide(0.02, true);
    EXPECT_FALSE(b.controller.pilot_unlocked());
  }
}

TEST(MachineController, VelocitySilenceIsAZeroCommand) {
  Bench b;
  b.kernel.velocity(0.0, kMove);
  for (int k = 0; k < 20; ++k) {
    b.kernel.heartbeat(0.01 * k, true);
    b.controller.decide(0.01 * k, false);
    EXPECT_EQ(b.controller.command() != (std::array<double, 4>{}), k <= 10) << k;
  }
}

TEST(MachineController, AtManualTheJointsObeyTheLeversAndNotTheBus) {
  Bench b;
  b.kernel.heartbeat(0.0, false);
  b.kernel.velocity(0.0, kMove);
  b.controller.select(std::array<double, 4>{0.0, 0.1, 0.0, 0.0});
  for (int k = 0; k < 100; ++k) b.cycle(0.01 * k);
  EXPECT_EQ(b.controller.command(), (std::array<double, 4>{0.0, 0.1, 0.0, 0.0}));
  EXPECT_GT(b.joints.state().angle[1], pose(0, 45, -100, -60).angle[1] + 0.05);
  EXPECT_DOUBLE_EQ(b.joints.state().angle[0], 0.0) << "what the bus asks for moves nothing";
  b.controller.select(std::nullopt);
  b.cycle(1.0);
  EXPECT_EQ(b.controller.drive(), Drive::brake) << "nobody enables the machine";
  EXPECT_EQ(b.controller.command(), (std::array<double, 4>{}));
}

TEST(MachineController, HornSoundsAsLongAsItIsSet) {
  Bench b;
  for (int k = 0; k < 10; ++k) {
    b.kernel.setting(0.05 * k, k >= 2 && k < 6);
    EXPECT_EQ(b.controller.horn(), k >= 2 && k < 6) << k;
  }
}

TEST(MachineController, PanGoalsAreHeldOnlyWhileTheyAreSent) {
  Bench b;
  const berm_pan_cmd m{1, 300000, 1000000};
  b.controller.receive(berm_encode_pan_cmd(&m), 0.0);
  EXPECT_NEAR(b.controller.pan(1, 0.1, 0.7).goal, 0.3, 0.0005);
  EXPECT_EQ(b.controller.pan(1, 0.2, 0.7).goal, 0.7);
  EXPECT_EQ(b.controller.pan(0, 0.0, 0.2).goal, 0.2);
  const berm_pan_cmd unknown{2, 300000, 1000000};
  b.controller.receive(berm_encode_pan_cmd(&unknown), 0.0);  // a scanner that does not exist
}

}  // namespace
}  // namespace berm::plant::testing
