// The machine file: what the default says, and every kind of bad input.
#include <gtest/gtest.h>

#include <cmath>

#include "config/machine_file.hpp"
#include "config/strict_table.hpp"
#include "edited_file.hpp"

namespace berm::config::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

// verifies: IF-CF-5
TEST(MachineFileTest, TheDefaultInSiUnits) {
  const MachineFile m = load_machine_file(machine_path());
  EXPECT_EQ(m.name, "zx200");
  EXPECT_DOUBLE_EQ(m.boom, 5.648);
  EXPECT_DOUBLE_EQ(m.boom_pin_x, 0.2277);
  EXPECT_DOUBLE_EQ(m.joint[0].low, -kPi);
  EXPECT_DOUBLE_EQ(m.joint[2].high, -45.0 * kPi / 180.0);
  EXPECT_DOUBLE_EQ(m.joint[0].velocity_max, 50.0 * kPi / 180.0);
  EXPECT_DOUBLE_EQ(m.joint[3].acceleration_max, 4.64);
  EXPECT_DOUBLE_EQ(m.bucket_payload, 1600.0);
  EXPECT_DOUBLE_EQ(m.command_latency, 0.09);
  ASSERT_EQ(m.braking.reach.size(), 4u);
  EXPECT_DOUBLE_EQ(m.braking.angle[0][3][7], 102.97 * kPi / 180.0);
  EXPECT_DOUBLE_EQ(m.braking.time[0][3][7], 4.097);
  ASSERT_EQ(m.part.size(), 4u);
  EXPECT_EQ(m.part[3].link, 3);
  EXPECT_DOUBLE_EQ(m.part[3].outline[3][0], 1.62);
  EXPECT_DOUBLE_EQ(m.scanner[1].position[1], -1.35);
  EXPECT_DOUBLE_EQ(m.kernel.request_hold, 0.05);
}

// verifies: IF-CF-23
TEST(MachineFileTest, JointModelsAreThereOrNot) {
  const MachineFile m = load_machine_file(machine_path());
  ASSERT_TRUE(m.response);
  EXPECT_NEAR(m.response->payload, 1800.0, 10.0);
  ASSERT_EQ(m.response->reach.size(), 4u);
  const auto& [up, down] = m.response->joint[0];
  EXPECT_NEAR(up.dead_time, 0.06, 0.002);
  EXPECT_NEAR(up.lag, 0.12, 0.005);
  ASSERT_EQ(up.slowing[1].size(), 4u);
  EXPECT_GT(up.slowing[0][3], 1.5 * up.slowing[1][3]) << "the heaviest payload at the farthest reach";
  EXPECT_NEAR(down.gain, 1.0, 0.01);
  EXPECT_LT(m.response->joint[1][1].slowing[1][0], m.response->joint[1][1].slowing[0][0]) << "a boom that is lowered under load";

  const Scratch scratch;
  std::string text = read_text(machine_path());
  text.resize(text.find("[response]"));
  EXPECT_FALSE(load_machine_file(scratch.write("machine.toml", text)).response);
}

// verifies: IF-CF-5
TEST(MachineFileTest, TheOneWithLidarsWatchesItsTail) {
  EXPECT_FALSE(load_machine_file(machine_path()).tail.watched);
  EXPECT_TRUE(load_machine_file(machine_path()).lidar.empty());
  const MachineFile m = load_machine_file(BERM_CONFIG_FILES "/machines/zx200_rear.toml");
  EXPECT_TRUE(m.tail.watched);
  EXPECT_DOUBLE_EQ(m.tail.radius, 2.9);
  ASSERT_EQ(m.lidar.size(), 2u);
  EXPECT_DOUBLE_EQ(m.lidar[1].position[1], -1.40);
  EXPECT_DOUBLE_EQ(m.lidar[0].pitch, 80.0 * kPi / 180.0);
  EXPECT_DOUBLE_EQ(m.lidar[1].yaw, -145.0 * kPi / 180.0);
}

// verifies: IF-CF-5
TEST(MachineFileTest, TheOneWithLidarsAllRoundWatchesItsWorkspace) {
  EXPECT_FALSE(load_machine_file(machine_path()).workspace.watched);
  const MachineFile m = load_machine_file(BERM_CONFIG_FILES "/machines/zx200_ring.toml");
  EXPECT_TRUE(m.workspace.watched);
  EXPECT_FALSE(m.tail.watched);
  EXPECT_DOUBLE_EQ(m.workspace.radius, 15.0);
  EXPECT_DOUBLE_EQ(m.workspace.lidar_wait, 0.10);
  EXPECT_DOUBLE_EQ(m.workspace.lidar_period, 0.05);
  ASSERT_EQ(m.lidar.size(), 2u);
  for (const LidarFile& lidar : m.lidar) {
    EXPECT_EQ(lidar.roll, 0.0) << "level";
    EXPECT_EQ(lidar.pitch, 0.0);
    EXPECT_LT(std::hypot(lidar.position[0], lidar.position[1]), m.own_body_radius);
  }
}

// verifies: IF-CF-1, IF-CF-2, IF-CF-6, IF-CF-7, IF-CF-25
TEST(MachineFileTest, EachBadInputGivesOneLineWithFileFieldAndLimit) {
  const Scratch scratch;
  const std::string good = read_text(machine_path());
  for (const BadEdit& edit : bad_machine_edits()) {
    const std::string path = scratch.write("machine.toml", replaced(good, edit.from, edit.to));
    try {
      load_machine_file(path);
      ADD_FAILURE() << edit.name << ": taken";
    } catch (const ConfigError& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.find(path + ": " + edit.field), 0u) << edit.name << ": " << line;
      EXPECT_NE(line.find(edit.reason), std::string::npos) << edit.name << ": " << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << edit.name << ": " << line;
    }
  }
}

// verifies: IF-CF-2
TEST(MachineFileTest, WhatIsNoTomlFile) {
  const Scratch scratch;
  std::string noise;
  for (int i = 0; i < 4000; ++i) noise += static_cast<char>(i * 7919 % 251);
  for (const std::string& path : {scratch.path("missing.toml"), scratch.path(""), scratch.write("empty.toml", ""), scratch.write("noise.toml", noise),
                                  scratch.write("foreign.toml", "[package]\nname = 'x'\n")}) {
    try {
      load_machine_file(path);
      ADD_FAILURE() << path << ": taken";
    } catch (const ConfigError& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.find(path + ": "), 0u) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
  }
}

// verifies: IF-CF-1
TEST(MachineFileTest, WholeNumbersAreNumbers) {
  const Scratch scratch;
  const std::string path = scratch.write("machine.toml", replaced(read_text(machine_path()), "half_width = 0.60", "half_width = 1"));
  EXPECT_DOUBLE_EQ(load_machine_file(path).part[3].half_width, 1.0);
}

}  // namespace
}  // namespace berm::config::test
