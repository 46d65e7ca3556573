// Lidars in the kernel's whole cycle: what the Workspace Monitor is fed takes nothing from the height map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "cycle_rig.hpp"
#include "lidar_scene.hpp"
#include "watched_ring.hpp"

namespace berm::kernel::test {
namespace {

// A machine at rest between a box and somebody who comes after a second and a half; its two lidars see both.
struct Scene {
  explicit Scene(bool watched, bool histogram) {
    const berm_parameters ring = watched_ring();
    berm_parameters parameters = berm::test::demo_parameters();
    parameters.workspace_watched = watched ? 1 : 0;
    parameters.workspace_histogram = histogram ? 1 : 0;
    parameters.workspace_learn_us = 1000000;
    parameters.truck_zones = parameters.lanes = 0;
    parameters.lidars = 2;
    parameters.sight_blind_permille = 1000;  // the scene's machine hides more of its lidars' views than a real one
    for (int i = 0; i < 2; ++i) source.emplace_back(parameters.lidar[i] = ring.lidar[i], false, 0.02);
    scene.boxes = {{{-6.0, 2.5, 0.0}, {-4.65, 4.0, 1.2}}};
    scene.people = {{6.0, -3.0, 0.25, 1.8, 1.5}};
    rig = std::make_unique<CycleRig>(parameters);
  }
  void step() {
    rig->gather();
    for (int i = 0; i < 2; ++i) {
      std::vector<LidarSource::Packet> packets;
      source[static_cast<std::size_t>(i)].until(0.01 * ++cycles[i], scene, [](double) { return 0.0; }, packets);
      for (const auto& p : packets) ASSERT_TRUE(rig->in->take_lidar(i, p.data(), p.size()));
    }
    rig->cycle->step(*rig->in, *rig->out);
    rig->obey();
  }

  LidarScene scene;
  std::vector<LidarSource> source;
  int cycles[2] = {};
  std::unique_ptr<CycleRig> rig;
};

// verifies: SK-LI-6
TEST(CycleLidars, WatchingTheWorkspaceChangesNothingOfTheHeightMap) {
  for (const bool histogram : {false, true}) {
    Scene watched(true, histogram), unwatched(false, false);
    bool held = false;
    for (int k = 0; k < 400; ++k) {
      watched.step();
      unwatched.step();
      held = held || watched.rig->state().stop_reason == BERM_STOP_INTRUDER;
      ASSERT_EQ(std::memcmp(&watched.rig->cycle->map(), &unwatched.rig->cycle->map(), sizeof(sk_height_map)), 0) << "cycle " << k << ", histogram " << histogram;
    }
    EXPECT_TRUE(held) << "nobody was told of, so that nothing was shown; histogram " << histogram;
    EXPECT_EQ(unwatched.rig->state().stop_count[BERM_STOP_INTRUDER], 0U);
    std::int32_t highest = INT32_MIN;
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) highest = std::max(highest, sk_map_top(&unwatched.rig->cycle->map(), iy, ix));
    EXPECT_GT(highest, 700) << "the box is in the map";
  }
}

}  // namespace
}  // namespace berm::kernel::test
