// CheckCell: every neighbour by itself, the thresholds to the millimetre, the border of the map.
#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>

#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min(), kMax32 = std::numeric_limits<std::int32_t>::max();

class MonitorCheck : public testing::Test {
 protected:
  MonitorCheck() { scene.ground(0); }
  int check(std::int32_t new_mm, int iy = 50, int ix = 50, int flag = SK_FLAG_NOT_VISITED) {
    scene.temporary(iy, ix, flag, new_mm);
    EXPECT_TRUE(sk_check_cell(scene.monitor.get(), scene.rules.get(), scene.now_us, iy, ix));
    return scene.temporary_flag(iy, ix);
  }
  void empty(int iy, int ix) { scene.accumulated(iy, ix, {SK_FLAG_EMPTY, -20000, -20000}); }

  MonitorScene scene{true};
};

// verifies: SK-WM-11
TEST_F(MonitorCheck, ARiseIsMoreThanTheThreshold) {
  EXPECT_EQ(check(500), SK_FLAG_NOT_VISITED);
  EXPECT_EQ(check(501), SK_FLAG_OBSTACLE);
  empty(50, 50);
  EXPECT_EQ(check(501), SK_FLAG_NOT_VISITED) << "nothing to compare with";
}

// verifies: SK-WM-12
TEST_F(MonitorCheck, AnyOneNeighbourExplains) {
  for (int iy = 49; iy <= 51; ++iy)
    for (int ix = 49; ix <= 51; ++ix) {
      if (iy == 50 && ix == 50) continue;
      scene.accumulated(iy, ix, {SK_FLAG_SET, 1400, 0});
      EXPECT_EQ(check(1700), SK_FLAG_CHANGED) << "the slope to it is an edge";
      scene.accumulated(iy, ix, {SK_FLAG_SET, 1000, 0});
      EXPECT_EQ(check(1700), SK_FLAG_OBSTACLE);
      EXPECT_EQ(check(1300), SK_FLAG_OBSTACLE) << "the neighbour is lower by just the threshold";
      EXPECT_EQ(check(1299), SK_FLAG_CHANGED);
      scene.accumulated(iy, ix, {SK_FLAG_SET, 1001, 0});
      EXPECT_EQ(check(1700), SK_FLAG_CHANGED);
      for (const int flag : std::initializer_list<int>{SK_FLAG_INTERPOLATED, SK_FLAG_CHANGED, SK_FLAG_OBSTACLE, SK_FLAG_NOT_VISITED, 0}) {
        scene.accumulated(iy, ix, {flag, 1699, 0});
        EXPECT_EQ(check(1700), SK_FLAG_OBSTACLE) << flag_name(flag) << " explains nothing";
      }
      scene.accumulated(iy, ix, {SK_FLAG_SET, 0, 0});
    }
  for (const auto& [dy, dx] : {std::pair{0, 2}, {2, 0}, {-2, 1}}) scene.accumulated(50 + dy, 50 + dx, {SK_FLAG_SET, 1700, 0});
  EXPECT_EQ(check(1700), SK_FLAG_OBSTACLE) << "two cells away is no neighbour";
}

// verifies: SK-WM-13
TEST_F(MonitorCheck, TwoEmptyNeighboursExcuseAndOneDoesNot) {
  const std::pair<int, int> neighbours[] = {{49, 49}, {49, 50}, {49, 51}, {50, 49}, {50, 51}, {51, 49}, {51, 50}, {51, 51}};
  for (const auto& a : neighbours) {
    empty(a.first, a.second);
    EXPECT_EQ(check(1700), SK_FLAG_OBSTACLE);
    for (const auto& b : neighbours) {
      if (a == b) continue;
      empty(b.first, b.second);
      EXPECT_EQ(check(1700), SK_FLAG_CHANGED);
      scene.accumulated(b.first, b.second, {SK_FLAG_SET, 0, 0});
    }
    scene.accumulated(a.first, a.second, {SK_FLAG_SET, 0, 0});
  }
}

// verifies: SK-WM-13
TEST_F(MonitorCheck, BeyondTheMapIsNoNeighbour) {
  for (const int iy : {0, 50, SK_MAP_CELLS - 1})
    for (const int ix : {0, 50, SK_MAP_CELLS - 1}) EXPECT_EQ(check(1700, iy, ix), SK_FLAG_OBSTACLE) << iy << " " << ix;
  empty(0, 1);
  EXPECT_EQ(check(1700, 0, 0), SK_FLAG_OBSTACLE);
  empty(1, 0);
  EXPECT_EQ(check(1700, 0, 0), SK_FLAG_CHANGED);
}

// verifies: SK-WM-10
TEST_F(MonitorCheck, JudgesWhatIsDueAndNothingElse) {
  scene.now_us = 10'000'000;
  for (const int flag :
       std::initializer_list<int>{SK_FLAG_EMPTY, SK_FLAG_SET, SK_FLAG_INTERPOLATED, SK_FLAG_INTERPOLATED_NOT_VISITED, SK_FLAG_CHANGED, SK_FLAG_OBSTACLE, 0})
    EXPECT_EQ(check(1700, 50, 50, flag), flag) << flag_name(flag);
  const auto aged = [&](std::int64_t began_us, std::int64_t now_us, std::int32_t wait_us) {
    scene.temporary(50, 50, SK_FLAG_SET, 1700);
    scene.monitor->began_us[50][50] = began_us;
    scene.rules->wait_us = wait_us;
    sk_check_cell(scene.monitor.get(), scene.rules.get(), now_us, 50, 50);
    return scene.temporary_flag(50, 50);
  };
  EXPECT_EQ(aged(1000, 1000 + kWait - 1, kWait), SK_FLAG_SET);
  EXPECT_EQ(aged(1000, 1000 + kWait, kWait), SK_FLAG_OBSTACLE);
  EXPECT_EQ(aged(1000, 999, kWait), SK_FLAG_OBSTACLE) << "time runs backwards";
  EXPECT_EQ(aged(1000, -1, kWait), SK_FLAG_OBSTACLE);
  EXPECT_EQ(aged(1000, 1000, -1), SK_FLAG_OBSTACLE);
  EXPECT_EQ(aged(std::numeric_limits<std::int64_t>::min(), 0, kMax32), SK_FLAG_OBSTACLE);
}

// verifies: SK-WM-10, SK-WM-14
TEST_F(MonitorCheck, ExtremeHeightsAndThresholdsAreTaken) {
  for (const std::int32_t height : {kMin32, 0, kMax32})
    for (const std::int32_t threshold : {kMin32, 0, kMax32}) {
      scene.accumulated(50, 50, {SK_FLAG_SET, height, height});
      scene.accumulated(50, 51, {SK_FLAG_SET, kMax32, height});
      scene.rules->height_threshold_mm = scene.rules->neighbour_threshold_mm = scene.rules->slope_threshold_mm = threshold;
      const bool rises = std::int64_t{1700} - height > threshold;
      EXPECT_EQ(check(1700) != SK_FLAG_NOT_VISITED, rises) << height << " " << threshold;
    }
}

// verifies: SK-WM-14
TEST_F(MonitorCheck, OutsideTheMapNothingIsChecked) {
  for (const std::int32_t outside : {kMin32, -1, SK_MAP_CELLS, kMax32}) {
    EXPECT_FALSE(sk_check_cell(scene.monitor.get(), scene.rules.get(), 0, outside, 50));
    EXPECT_FALSE(sk_check_cell(scene.monitor.get(), scene.rules.get(), 0, 50, outside));
    EXPECT_FALSE(sk_merge_cell(scene.monitor.get(), scene.rules.get(), outside, 50));
    EXPECT_FALSE(sk_merge_cell(scene.monitor.get(), scene.rules.get(), 50, outside));
  }
}

// Two cells side by side rise in one update: neither is merged before the other is judged.
// verifies: SK-WM-15
TEST_F(MonitorCheck, TheOrderOfTheListDecidesNothing) {
  for (const bool left_first : {true, false}) {
    MonitorScene two(true);
    two.ground(0);
    two.see(50, left_first ? 50 : 51, 1700);
    two.see(50, left_first ? 51 : 50, 1700);
    two.settle();
    EXPECT_EQ(two.accumulated(50, 50).flag, SK_FLAG_OBSTACLE);
    EXPECT_EQ(two.accumulated(50, 51).flag, SK_FLAG_OBSTACLE);
  }
}

}  // namespace
}  // namespace berm::core_test
