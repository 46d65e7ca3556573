// Lidars in the kernel's whole cycle: what the Workspace Monitor is fed takes nothing from the height map; one that no longer turns stops the machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

#include "cycle_rig.hpp"
#include "lidar_scene.hpp"
#include "watched_ring.hpp"

namespace berm::kernel::test {
namespace {

// A machine at rest between a box and somebody who comes after a second and a half; its two lidars see both.
struct Scene {
  explicit Scene(bool watched, bool histogram, double person_from_s = 1.5) {
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
    scene.people = {{6.0, -3.0, 0.25, 1.8, person_from_s}};
    rig = std::make_unique<CycleRig>(parameters);
  }
  void step() {
    rig->gather();
    for (int i = 0; i < 2; ++i) {
      std::vector<LidarSource::Packet> packets;
      source[static_cast<std::size_t>(i)].until(0.01 * ++cycles[i], scene, [](double) { return 0.0; }, packets);
      for (auto& p : packets) {
        if (spoil && !spoil(i, p)) continue;
        ASSERT_TRUE(rig->in->take_lidar(i, p.data(), p.size()));
      }
    }
    rig->cycle->step(*rig->in, *rig->out);
    rig->obey();
  }

  LidarScene scene;
  std::vector<LidarSource> source;
  int cycles[2] = {};
  std::unique_ptr<CycleRig> rig;
  // What a fault makes of a lidar's packet; false: it does not come. Of none unless given.
  std::function<bool(int lidar, LidarSource::Packet& packet)> spoil;
};

unsigned azimuth_cdeg(const LidarSource::Packet& packet) { return packet[2] + 256U * packet[3]; }

// The head stands: what it saw last it sends again and again, by a clock that runs.
class Stalled {
 public:
  bool operator()(LidarSource::Packet& packet) {
    if (!seen_) last_ = packet;
    seen_ = true;
    for (std::size_t block = 0; block < 12; ++block) {
      std::copy_n(&last_[100 * block + 4], 96, &packet[100 * block + 4]);
      packet[100 * block + 2] = last_[2];
      packet[100 * block + 3] = last_[3];
    }
    return true;
  }

 private:
  bool seen_ = false;
  LidarSource::Packet last_{};
};

// Only this part of the turn comes.
bool sector_only(const LidarSource::Packet& packet) { return azimuth_cdeg(packet) >= 4500 && azimuth_cdeg(packet) < 6500; }

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

// Somebody comes up when it no longer turns. Found or not: by then the machine stands.
// verifies: SK-LI-2, SK-LI-9
TEST(CycleLidars, OneThatStopsTurningStopsTheMachineWithinHalfASecond) {
  for (const bool stalls : {true, false}) {
    for (const unsigned which : {1U, 2U, 3U}) {
      Scene scene(true, true, 3.5);
      for (int k = 0; k < 300; ++k) scene.step();
      ASSERT_EQ(scene.rig->state().kernel_state, BERM_STATE_RUN) << int{scene.rig->state().stop_reason};
      Stalled head[2];
      scene.spoil = [&](int lidar, LidarSource::Packet& packet) { return (which >> lidar & 1U) == 0 || (stalls ? head[lidar](packet) : sector_only(packet)); };
      int cycles = 0;
      while (scene.rig->state().kernel_state == BERM_STATE_RUN && cycles < 100) {
        scene.step();
        ++cycles;
      }
      EXPECT_LE(cycles, 50) << "lidars " << which << ", stalled " << stalls;
      EXPECT_GE(cycles, 20) << "a gap of a scanner's silence is no fault; lidars " << which << ", stalled " << stalls;
      EXPECT_EQ(scene.rig->state().stop_reason, BERM_STOP_SCANNER_SILENT) << "lidars " << which << ", stalled " << stalls;
      for (int k = 0; k < 100; ++k) scene.step();
      EXPECT_EQ(scene.rig->state().kernel_state, BERM_STATE_FAULT);
    }
  }
}

// verifies: SK-LI-9
TEST(CycleLidars, InitLastsUntilEveryOneHasTurnedAllRound) {
  Scene scene(true, true, 100.0);
  scene.spoil = [](int lidar, LidarSource::Packet& packet) { return lidar != 1 || sector_only(packet); };
  for (int k = 0; k < 300; ++k) scene.step();
  EXPECT_EQ(scene.rig->state().kernel_state, BERM_STATE_INIT);
  scene.spoil = nullptr;
  for (int k = 0; k < 100; ++k) scene.step();
  EXPECT_EQ(scene.rig->state().kernel_state, BERM_STATE_RUN) << int{scene.rig->state().stop_reason};
}

}  // namespace
}  // namespace berm::kernel::test
