// The kernel's braking table must bound the plant's true stop angle and time for every speed, reach and payload up to the heaviest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "machine_file.hpp"
#include "plant/machine/joint_dynamics.hpp"

namespace berm::plant::testing {
namespace {

struct Stop { double angle, time; };

// Brakes one joint of the true machine from a speed to standstill.
Stop brake(const PlantProfile& p, JointState start, std::size_t joint, double speed, double payload_kg) {
  start.velocity = {};
  start.velocity[joint] = speed;
  JointDynamics dynamics(p.dynamics, p.shape, 1, start);
  double time = 0.0;
  while (dynamics.state().velocity[joint] != 0.0 && time < 20.0) {
    dynamics.step(0.001, Drive::brake, {}, DigForces{}, payload_kg);
    time += 0.001;
  }
  return {std::abs(dynamics.state().angle[joint] - start.angle[joint]), time};
}

TEST(BrakingTable, CoversEverySwingStopOverAFineGridOfPoses) {
  const PlantProfile p = profile();
  const MachineFile m;
  double worst = 0.0;
  for (double boom = -55; boom <= 70; boom += 2.5) {
    for (double stick = -145; stick <= -45; stick += 2.5) {
      for (double bucket = -136; bucket <= 35; bucket += 3) {
        const JointState s = pose(0, boom, stick, bucket);
        const std::size_t row = m.row(p.shape, s);
        ASSERT_LT(row, m.reach_m.size()) << "reach beyond the table at boom " << boom << ", stick " << stick << ", bucket " << bucket;
        // constant deceleration; the simulated stops below show that this is what the dynamics does
        const double inertia = swing_inertia(p.dynamics, p.shape, s, p.shape.bucket_payload_max_kg);
        const double deceleration = p.dynamics.swing_brake_torque / inertia;
        for (std::size_t k = 1; k < 8; ++k) {
          const double speed = p.dynamics.joint[0].velocity_max * static_cast<double>(k) / 7.0;
          const double angle = speed * speed / (2.0 * deceleration);
          worst = std::max(worst, angle / m.angle_rad[0][row][k]);
          ASSERT_LE(angle, m.angle_rad[0][row][k]) << "boom " << boom << ", stick " << stick << ", bucket " << bucket << ", column " << k;
          ASSERT_LE(speed / deceleration, m.time_s[0][row][k]) << "boom " << boom << ", stick " << stick << ", bucket " << bucket << ", column " << k;
        }
      }
    }
  }
  fmt::print("worst swing stop angle over its table entry: {:.3f}\n", worst);
  EXPECT_GT(worst, 0.8) << "the table is far too coarse: the grid does not reach what it was derived for";
}

TEST(BrakingTable, CoversSimulatedStopsOfEveryJoint) {
  const PlantProfile p = profile();
  const MachineFile m;
  std::array<double, 4> worst{};
  for (const double boom : {-50.0, -20.0, 0.0, 20.0, 45.0, 65.0}) {
    for (const double stick : {-140.0, -110.0, -80.0, -50.0}) {
      for (const double bucket : {-130.0, -80.0, -20.0, 30.0}) {
        const JointState s = pose(0, boom, stick, bucket);
        const std::size_t row = m.row(p.shape, s);
        ASSERT_LT(row, m.reach_m.size());
        for (const double payload : {0.0, 0.5 * p.shape.bucket_payload_max_kg, p.shape.bucket_payload_max_kg}) {
          for (std::size_t joint = 0; joint < 4; ++joint) {
            for (const int column : {-7, -4, -1, 1, 4, 7}) {
              const double speed = p.dynamics.joint[joint].velocity_max * column / 7.0;
              const Stop stop = brake(p, s, joint, speed, payload);
              const auto k = static_cast<std::size_t>(std::abs(column));
              ASSERT_LE(stop.angle, m.angle_rad[joint][row][k]) << kJoints[joint] << " boom " << boom << " payload " << payload << " column " << column;
              ASSERT_LE(stop.time, m.time_s[joint][row][k] + 0.001) << kJoints[joint] << " boom " << boom << " payload " << payload;
              worst[joint] = std::max(worst[joint], stop.angle / m.angle_rad[joint][row][k]);
            }
          }
        }
      }
    }
  }
  fmt::print("worst simulated stop angle over its table entry: swing {:.3f}, boom {:.3f}, stick {:.3f}, bucket {:.3f}\n", worst[0], worst[1], worst[2], worst[3]);
}

TEST(BrakingTable, StopAngleGrowsWithReachAndPayload) {
  const PlantProfile p = profile();
  const double speed = p.dynamics.joint[0].velocity_max;
  const JointState tucked = pose(0, 60, -140, -120), stretched = pose(0, 20, -50, 0);
  const double full = p.shape.bucket_payload_max_kg;
  const double near_empty = brake(p, tucked, 0, speed, 0).angle, near_full = brake(p, tucked, 0, speed, full).angle;
  const double far_empty = brake(p, stretched, 0, speed, 0).angle, far_full = brake(p, stretched, 0, speed, full).angle;
  EXPECT_LT(near_empty, near_full);
  EXPECT_LT(near_full, far_empty);
  EXPECT_GT(far_full, 1.5 * far_empty);
}

TEST(BrakingTable, SimulatedSwingStopIsTheOneOfTorqueOverInertia) {
  const PlantProfile p = profile();
  const JointState s = pose(0, 30, -90, -60);
  const double inertia = swing_inertia(p.dynamics, p.shape, s, 1200);
  const double speed = 0.8;
  EXPECT_NEAR(brake(p, s, 0, speed, 1200).angle, speed * speed * inertia / (2 * p.dynamics.swing_brake_torque), 0.002);
}

}  // namespace
}  // namespace berm::plant::testing
