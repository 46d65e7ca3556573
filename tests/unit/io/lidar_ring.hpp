// Two lidars in a scene, what the kernel makes of them, and time.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "io/lidar_intake.hpp"
#include "io/workspace_watch.hpp"
#include "lidar_scene.hpp"

namespace berm::kernel::test {

struct Ring {
  explicit Ring(const berm_parameters& block, bool dual = false, double dust = 0.0)
      : parameters(block), source{{block.lidar[0], dual, dust}, {block.lidar[1], dual, dust}}, intake(block), watch(block) {
    sk_map_clear(&map);
  }
  bool step() {
    const double t = ++cycle * 0.01;
    const auto now_us = static_cast<std::int64_t>(cycle) * 10000;
    const std::int32_t pose[4] = {static_cast<std::int32_t>(std::lround(swing(t) * 1e6)), static_cast<std::int32_t>(scene.own.boom_rad * 1e6),
                                  static_cast<std::int32_t>(scene.own.stick_rad * 1e6), static_cast<std::int32_t>(scene.own.bucket_rad * 1e6)};
    joints.push(now_us, pose);
    for (int i = 0; i < 2; ++i) {
      packets.clear();
      if (silent == i) continue;
      source[i].until(t, scene, swing, packets);
      for (const LidarSource::Packet& p : packets) {
        EXPECT_TRUE(intake.take(i, p.data(), p.size(), joints, now_us, map, shadow));
        watch.take(i, intake.packet(), joints.at(intake.middle_us(i)).angles, now_us);
      }
    }
    return watch.step(now_us);
  }
  double time_s() const { return cycle * 0.01; }
  std::string where() const {
    std::int32_t x = 0, y = 0, height = 0;
    return watch.place(x, y, height) ? "at " + std::to_string(x) + " " + std::to_string(y) + ", " + std::to_string(height) + " mm" : "nowhere";
  }

  const berm_parameters& parameters;
  LidarScene scene;
  LidarSource source[2];
  int cycle = 0;
  int silent = -1;
  std::function<double(double)> swing = [](double) { return 0.0; };
  JointHistory joints;
  LidarIntake intake;
  WorkspaceWatch watch;
  sk_height_map map{};
  OwnShadow shadow{1000000};
  std::vector<LidarSource::Packet> packets;
};

}  // namespace berm::kernel::test
