// Histograms of several sensors: what one knows of a cell stands for what another has seen too little of, and no wrong height goes from one to the next.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "io/lidar_intake.hpp"
#include "io/monitor_watch.hpp"
#include "io/workspace_watch.hpp"
#include "lidar_scene.hpp"
#include "watched_ring.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::int32_t kFoot = -1500, kTop = -800;  // mm, of a slope in one cell
constexpr std::int32_t kX = 9000, kY = 2550;

class MonitorOthersTest : public testing::Test {
 protected:
  MonitorOthersTest() {
    parameters.workspace_histogram = 1;
    for (auto& monitor : monitors) {
      monitor = std::make_unique<MonitorWatch>(parameters, parameters.workspace_wait_us, parameters.workspace_period_us);
      monitor->settle({SK_MAP_ORIGIN_MM, SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM});
    }
  }
  // Whether the machine must stand for what this sensor saw.
  bool see(std::size_t number, std::int32_t z_mm, int points) {
    MonitorWatch::Others others;
    for (std::size_t other = 0; other < monitors.size(); ++other)
      if (other != number) others.monitor[others.count++] = monitors[other].get();
    if (number != 0) others.scanners = monitors[0].get();
    for (int i = 0; i < points; ++i) monitors[number]->insert({kX, kY, z_mm}, now_us, others);
    return monitors[number]->step(now_us);
  }
  std::uint32_t observed(std::size_t number) const { return monitors[number]->histogram()->observed[sk_map_index(kY)][sk_map_index(kX)]; }

  berm_parameters parameters = watched_ring();
  std::int64_t now_us = 1'000'000;
  std::array<std::unique_ptr<MonitorWatch>, 3> monitors;
};

// verifies: SK-WM-71
TEST_F(MonitorOthersTest, TheTopOfASlopeThatAnotherSensorKnowsIsNobody) {
  EXPECT_FALSE(see(0, kFoot, 10));
  EXPECT_FALSE(see(1, kFoot, 10));
  EXPECT_FALSE(see(2, kFoot, SK_HISTOGRAM_ENOUGH));
  EXPECT_FALSE(see(2, kFoot + 450, 1));
  now_us += 2'000'000;
  EXPECT_FALSE(see(2, kFoot + 450, 1)) << "the one that saw more of it, in steps of less than a rise";
  now_us += 2'000'000;
  EXPECT_FALSE(see(2, kTop, 1));
  now_us += 2'000'000;
  EXPECT_FALSE(see(2, kTop, 1));
  for (const std::size_t number : {0U, 1U}) EXPECT_FALSE(see(number, kTop + 300, 9)) << number;
  for (const std::size_t number : {0U, 1U}) EXPECT_TRUE(see(number, kTop + 700, 3)) << number << ": higher than any of them knows";
}

// verifies: SK-WM-71
TEST_F(MonitorOthersTest, WithNoOtherWhoKnowsItIsSomebody) {
  EXPECT_FALSE(see(0, kFoot, 10));
  EXPECT_TRUE(see(0, kTop, 3));
}

// verifies: SK-WM-71
TEST_F(MonitorOthersTest, WhoHasSeenManyNeedsNoOther) {
  EXPECT_FALSE(see(1, kTop, SK_HISTOGRAM_ENOUGH)) << "its only knowledge";
  EXPECT_FALSE(see(0, kFoot, SK_HISTOGRAM_WELL));
  EXPECT_TRUE(see(0, kTop, 3));
}

// Run through while the bucket was near, a lidar had learned a child of a dig zone's cells: to the scanners, which knew the ground alone, he was excused.
// verifies: SK-WM-71
TEST_F(MonitorOthersTest, WhereCellsAreLearnedAnewNobodyIsExcused) {
  const auto excused = [this] {
    for (auto& monitor : monitors) {
      monitor = std::make_unique<MonitorWatch>(parameters, parameters.workspace_wait_us, parameters.workspace_period_us);
      monitor->change_lanes(parameters, false);  // a truck stands there, and the lane is watched
      monitor->settle({SK_MAP_ORIGIN_MM, SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM});
    }
    EXPECT_FALSE(see(2, kFoot + 1000, 20));
    EXPECT_FALSE(see(0, kFoot, 10));
    return !see(0, kFoot + 1000, 3);
  };
  EXPECT_TRUE(excused());
  parameters.dig_zone[0] = {kX + 200, kY - 500, kX + 900, kY + 500, -3000, 1000};
  EXPECT_FALSE(excused()) << "the cell touches the zone";
  parameters.dig_zones = 0;
  parameters.lanes = 1;
  parameters.lane[0] = {kX - 900, kY - 500, kX, kY + 500};
  EXPECT_FALSE(excused());
}

// verifies: SK-WM-68
TEST_F(MonitorOthersTest, WhereCellsAreLearnedAnewALidarAsksTheScannersAlone) {
  parameters.dig_zone[0] = {kX - 500, kY - 500, kX + 500, kY + 500, -3000, 1000};
  for (auto& monitor : monitors) {
    monitor = std::make_unique<MonitorWatch>(parameters, parameters.workspace_wait_us, parameters.workspace_period_us);
    monitor->settle({SK_MAP_ORIGIN_MM, SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM});
  }
  EXPECT_FALSE(see(2, kFoot + 1000, 20)) << "it learned somebody";
  EXPECT_FALSE(see(1, kFoot + 1000, 3)) << "nobody it asks knows better";
  EXPECT_FALSE(see(0, kFoot, 20)) << "it asks nobody";
  monitors[1]->begin();
  monitors[1]->settle({SK_MAP_ORIGIN_MM, SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM});
  EXPECT_TRUE(see(1, kFoot + 1000, 3));
}

// Somebody whom a sensor meets that never saw the ground there would else be its ground, and his own excuse before the others.
// verifies: SK-WM-68, SK-WM-71
TEST_F(MonitorOthersTest, WhoStandsWhereOneKnowsTheGroundIsTheGroundOfNone) {
  for (const std::size_t knows : {0U, 1U, 2U}) {
    for (auto& monitor : monitors) {
      monitor->begin();
      monitor->settle({SK_MAP_ORIGIN_MM, SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM});
    }
    EXPECT_FALSE(see(knows, kFoot, 20));
    for (std::size_t number = 0; number < monitors.size(); ++number) {
      EXPECT_TRUE(see(number, kFoot + 1100, 20)) << number << ", known to " << knows;
      EXPECT_EQ(observed(number), number == knows ? 20U : 0U);
    }
  }
}

// The whole of the watch: lidars that know level ground, and panning scanners that see somebody where they never saw the ground.
// verifies: SK-WM-68
TEST_F(MonitorOthersTest, TheScannersHaveTheLidarsGround) {
  parameters.workspace_learn_us = 1'000'000;
  const auto watch = std::make_unique<WorkspaceWatch>(parameters);
  LidarScene scene;
  LidarSource source[] = {{parameters.lidar[0], false}, {parameters.lidar[1], false}};
  LidarIntake intake(parameters);
  JointHistory joints;
  const auto map = std::make_unique<sk_height_map>();
  sk_map_clear(map.get());
  OwnShadow shadow{1000000};
  const std::int32_t pose[4] = {0, static_cast<std::int32_t>(scene.own.boom_rad * 1e6), static_cast<std::int32_t>(scene.own.stick_rad * 1e6),
                                static_cast<std::int32_t>(scene.own.bucket_rad * 1e6)};
  std::int64_t time_us = 0;
  for (int cycle = 1; cycle <= 150; ++cycle) {
    time_us = cycle * 10'000;
    joints.push(time_us, pose);
    for (int i = 0; i < 2; ++i) {
      std::vector<LidarSource::Packet> packets;
      source[i].until(cycle * 0.01, scene, [](double) { return 0.0; }, packets);
      for (const LidarSource::Packet& p : packets) {
        ASSERT_TRUE(intake.take(i, p.data(), p.size(), joints, time_us, *map, shadow));
        watch->take(i, intake.packet(), joints.at(intake.middle_us(i)).angles, time_us);
      }
    }
    ASSERT_FALSE(watch->step(time_us));
  }
  // A cell that a ring of the lidars meets.
  const sk_monitor_histogram& lidar = *watch->histogram(1);
  sk_monitor_cell met{-1, -1};
  for (int ix = 0; ix < SK_MAP_CELLS && met.ix < 0; ++ix)
    if (lidar.observed[60][ix] >= SK_HISTOGRAM_ENOUGH && watch->rules(0).watched[60][ix] != 0) met = {60, ix};
  ASSERT_GE(met.ix, 0);
  ScanBlocks blocks{};
  blocks.count = 1;
  blocks.block[0].count = blocks.block[0].used[0] = 1;
  blocks.block[0].point_mm[0][0] = SK_MAP_ORIGIN_MM + SK_CELL_MM * met.ix + SK_CELL_MM / 2;
  blocks.block[0].point_mm[0][1] = SK_MAP_ORIGIN_MM + SK_CELL_MM * met.iy + SK_CELL_MM / 2;
  blocks.block[0].point_mm[0][2] = 1100;
  for (int i = 0; i < 3; ++i) watch->take(blocks, joints, time_us);
  EXPECT_TRUE(watch->step(time_us));
}

}  // namespace
}  // namespace berm::kernel::test
