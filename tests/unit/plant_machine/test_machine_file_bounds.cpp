// What the kernel's machine file says of the machine must bound the plant's true values.
#include <gtest/gtest.h>

#include "machine_file.hpp"

namespace berm::plant::testing {
namespace {

// Is the point inside the convex, counter-clockwise outline?
bool inside(const std::vector<OutlinePoint>& outline, const OutlinePoint& p) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const OutlinePoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x) < 0.0) return false;
  }
  return true;
}

TEST(MachineFileBounds, PrismsCoverTheTrueOutlines) {
  const PlantProfile p = profile();
  const MachineFile m;
  constexpr int kSteps = 20;
  for (const SolidPart& part : p.shape.parts) {
    for (std::size_t i = 0; i < part.outline.size(); ++i) {
      const OutlinePoint &a = part.outline[i], &b = part.outline[(i + 1) % part.outline.size()];
      for (int k = 0; k < kSteps; ++k) {  // along the edge: one prism may cover one end and another the other
        const double f = static_cast<double>(k) / kSteps;
        const OutlinePoint q{a.x + f * (b.x - a.x), a.z + f * (b.z - a.z)};
        bool covered = false;
        for (const SolidPart& prism : m.parts) {
          covered = covered || (prism.link == part.link && prism.half_width >= part.half_width && inside(prism.outline, q));
        }
        EXPECT_TRUE(covered) << "link " << part.link << " at " << q.x << ", " << q.z;
      }
    }
  }
}

TEST(MachineFileBounds, KinematicsRangesSpeedsAndAccelerations) {
  const PlantProfile p = profile();
  const MachineFile m;
  const auto& k = m.root.at("kinematics");
  EXPECT_EQ(p.shape.boom_pin_x, as_number(k.at("boom_pin_x")));
  EXPECT_EQ(p.shape.boom_pin_z, as_number(k.at("boom_pin_z")));
  EXPECT_EQ(p.shape.boom, as_number(k.at("boom")));
  EXPECT_EQ(p.shape.stick, as_number(k.at("stick")));
  EXPECT_EQ(p.shape.bucket, as_number(k.at("bucket")));
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_LE(p.dynamics.joint[j].velocity_max, m.velocity_max[j]) << kJoints[j];
    EXPECT_LE(p.dynamics.joint[j].acceleration, m.acceleration[j]) << kJoints[j];
    EXPECT_EQ(p.dynamics.joint[j].low, m.low[j]) << kJoints[j];
    EXPECT_EQ(p.dynamics.joint[j].high, m.high[j]) << kJoints[j];
  }
}

TEST(MachineFileBounds, OwnBodyLiesInsideItsRadius) {
  const PlantProfile p = profile();
  const double radius = as_number(MachineFile().root.at("kinematics").at("own_body_radius"));
  ASSERT_FALSE(p.shape.upper_body.empty());
  ASSERT_FALSE(p.shape.tracks.empty());
  for (const auto* boxes : {&p.shape.upper_body, &p.shape.tracks}) {
    for (const AxisBox& box : *boxes) {
      const double x = std::max(std::abs(box.low[0]), std::abs(box.high[0])), y = std::max(std::abs(box.low[1]), std::abs(box.high[1]));
      EXPECT_LT(std::hypot(x, y), radius);
    }
  }
}

TEST(MachineFileBounds, ScannersStandWhereTheKernelTakesThemToBe) {
  const PlantProfile p = profile();
  const MachineFile m;
  const auto& scanners = m.root.at("scanner").as_array();
  ASSERT_EQ(scanners.size(), p.shape.scanner.size());
  for (std::size_t i = 0; i < scanners.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(p.shape.scanner[i].position[axis], as_number(scanners[i].at("position").as_array()[axis]));
    EXPECT_EQ(p.shape.scanner[i].pan_low, radians(as_number(scanners[i].at("pan_range_deg").as_array()[0])));
    EXPECT_EQ(p.shape.scanner[i].pan_high, radians(as_number(scanners[i].at("pan_range_deg").as_array()[1])));
  }
}

TEST(MachineFileBounds, DeadTimeAndOneCycleStayWithinTheCommandLatency) {
  const PlantProfile p = profile();
  const MachineFile m;
  const auto& latency = m.root.at("latency");
  for (const JointConfig& joint : p.dynamics.joint) EXPECT_LE(joint.dead_time + 0.01, as_number(latency.at("command")));
  EXPECT_LE(p.controller.heartbeat_silence + 0.01, as_number(latency.at("command")));
}

}  // namespace
}  // namespace berm::plant::testing
