#include <gtest/gtest.h>

#include <memory>

#include "contract/berm_contract.h"
#include "watch/intruder_watch.hpp"

namespace berm::watch {
namespace {

constexpr double cell = SK_CELL_MM * 1e-3, origin = SK_MAP_ORIGIN_MM * 1e-3;

// A region of all cells with x > 0, a kernel in RUN, a machine that moves, and one person 0.25 m in radius.
class IntruderWatchTest : public testing::Test {
 protected:
  IntruderWatchTest() {
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) rules->watched[iy][ix] = origin + cell * ix >= -1e-9 ? 1 : 0;
    rules->wait_us = 2000000;
    rules->period_us = 500000;
  }

  void step(double x, double y) {
    ++cycle;
    watch.step({0.01 * cycle, state, reason, cell_x, cell_y, 1.5, still, {monitor.get()}, {rules.get(), nullptr}}, {{present, {x, y, 0.0, 0.25}, 3.0 - 0.01 * cycle}});
  }
  void steps(int n, double x, double y) {
    for (int i = 0; i < n; ++i) step(x, y);
  }
  void alarm(double x, double y) {
    state = BERM_STATE_STOPPING;
    reason = BERM_STOP_INTRUDER;
    cell_x = x, cell_y = y;
  }
  const IntruderRecord& record() const { return watch.records().front(); }

  std::unique_ptr<sk_monitor_rules> rules = std::make_unique<sk_monitor_rules>();
  std::unique_ptr<sk_monitor> monitor = [] {
    auto m = std::make_unique<sk_monitor>();
    for (auto& row : m->accumulated_flag)
      for (auto& flag : row) flag = SK_FLAG_SET;
    return m;
  }();
  IntruderWatch watch{{"person"}};
  int cycle = 0;
  std::uint8_t state = BERM_STATE_RUN, reason = BERM_STOP_NONE;
  double cell_x = 0.0, cell_y = 0.0;
  bool still = false, present = true;
};

TEST_F(IntruderWatchTest, enters_with_its_rim_and_is_inside_with_its_middle) {
  steps(10, -1.0, 0.0);
  EXPECT_FALSE(record().entered_s);
  steps(10, -0.2, 0.0);
  ASSERT_TRUE(record().entered_s);
  EXPECT_NEAR(*record().entered_s, 0.11, 1e-9);
  EXPECT_DOUBLE_EQ(record().inside_s, 0.0);
  steps(100, 0.5, 0.0);
  EXPECT_NEAR(record().inside_s, 1.0, 1e-9);
  EXPECT_FALSE(record().stood_at_entry);
}

TEST_F(IntruderWatchTest, who_is_not_there_enters_nothing) {
  present = false;
  steps(50, 2.0, 0.0);
  EXPECT_FALSE(record().entered_s);
  present = true;
  step(2.0, 0.0);
  EXPECT_NEAR(*record().entered_s, 0.51, 1e-9);
}

TEST_F(IntruderWatchTest, who_stood_there_from_the_first_enters_when_it_has_gone_a_metre) {
  steps(50, 2.0, 0.0);
  steps(50, 2.9, 0.0);
  EXPECT_FALSE(record().entered_s);
  step(3.1, 0.0);
  EXPECT_NEAR(*record().entered_s, 1.01, 1e-9);
}

TEST_F(IntruderWatchTest, who_leaves_its_first_place_and_comes_back_enters) {
  steps(10, 0.5, 0.0);
  steps(10, -1.0, 0.0);
  step(0.5, 0.0);
  EXPECT_NEAR(*record().entered_s, 0.21, 1e-9);
}

TEST_F(IntruderWatchTest, an_alarm_at_its_cell_is_its_detection_and_the_machine_stands_later) {
  step(-1.0, 0.0);
  steps(99, 1.0, 0.0);
  alarm(1.5, 0.3);
  steps(50, 1.0, 0.0);
  still = true;
  steps(19, 1.0, 0.0);
  EXPECT_FALSE(record().standstill_s);
  steps(5, 1.0, 0.0);
  EXPECT_NEAR(*record().detected_s, 1.01, 1e-9);
  EXPECT_EQ(record().detected_by, BERM_STOP_INTRUDER);
  EXPECT_NEAR(*record().distance_at_detection_m, 3.0 - 1.01, 1e-9);
  EXPECT_NEAR(*record().standstill_s, 1.51, 1e-9);
  EXPECT_NEAR(*record().distance_at_standstill_m, 3.0 - 1.51, 1e-9);
  ASSERT_EQ(watch.alarms().size(), 1U);
  EXPECT_EQ(watch.alarms()[0].nearest, "person");
  EXPECT_EQ(watch.false_alarms(), 0);
}

TEST_F(IntruderWatchTest, an_alarm_elsewhere_is_false_and_no_detection) {
  step(-1.0, 0.0);
  steps(99, 1.0, 0.0);
  alarm(1.0, 1.3);  // 1.05 m from the person's surface
  steps(50, 1.0, 0.0);
  EXPECT_FALSE(record().detected_s);
  EXPECT_NEAR(*record().stopped_s, 1.01, 1e-9);
  EXPECT_EQ(watch.false_alarms(), 1);
  reason = BERM_STOP_NONE;
  step(1.0, 0.0);
  alarm(1.0, 1.3);
  step(1.0, 0.0);
  EXPECT_EQ(watch.false_alarms(), 2) << "separate alarms are counted separately";
}

TEST_F(IntruderWatchTest, an_alarm_where_it_was_as_long_ago_as_the_monitor_waits_is_its_own) {
  steps(20, -1.0, 5.0);
  steps(20, 1.0, 5.0);
  steps(280, 8.0, 5.0);
  alarm(1.0, 5.0);
  step(8.0, 5.0);
  EXPECT_TRUE(record().detected_s);
  EXPECT_EQ(watch.false_alarms(), 0);
}

TEST_F(IntruderWatchTest, an_alarm_where_it_was_longer_ago_is_false) {
  steps(20, -1.0, 5.0);
  steps(20, 1.0, 5.0);
  steps(320, 8.0, 5.0);
  alarm(1.0, 5.0);
  step(8.0, 5.0);
  EXPECT_FALSE(record().detected_s);
  EXPECT_EQ(watch.false_alarms(), 1);
}

TEST_F(IntruderWatchTest, who_comes_while_an_alarm_holds_is_detected_by_its_own_cell) {
  steps(5, -1.0, 5.0);
  alarm(9.0, -9.0);
  step(-1.0, 5.0);
  steps(50, 2.0, 5.0);
  EXPECT_FALSE(record().detected_s);
  monitor->accumulated_flag[static_cast<int>((5.0 - origin) / cell)][static_cast<int>((2.5 - origin) / cell)] = SK_FLAG_OBSTACLE;
  step(2.0, 5.0);
  EXPECT_NEAR(*record().detected_s, 0.57, 1e-9);
  EXPECT_TRUE(record().stood_at_entry);
}

TEST_F(IntruderWatchTest, another_stop_counts_when_its_cell_is_the_persons) {
  step(-1.0, 0.0);
  steps(49, 1.0, 0.0);
  state = BERM_STATE_STOPPING;
  reason = BERM_STOP_COLLISION_PREDICTED;
  cell_x = 6.0;
  step(1.0, 0.0);
  EXPECT_FALSE(record().detected_s);
  EXPECT_EQ(record().stopped_by, BERM_STOP_COLLISION_PREDICTED);
  state = BERM_STATE_RUN;
  reason = BERM_STOP_NONE;
  step(1.0, 0.0);
  state = BERM_STATE_STOPPING;
  reason = BERM_STOP_OVERPASS;
  cell_x = 1.6;
  step(1.0, 0.0);
  EXPECT_NEAR(*record().detected_s, 0.53, 1e-9);
  EXPECT_EQ(record().detected_by, BERM_STOP_OVERPASS);
  EXPECT_NEAR(*record().stopped_s, 0.51, 1e-9);
  EXPECT_TRUE(watch.alarms().empty());
}

TEST_F(IntruderWatchTest, a_machine_that_stands_already_stood_at_the_detection) {
  step(-1.0, 0.0);
  still = true;
  steps(50, 1.0, 0.0);
  alarm(1.0, 0.0);
  step(1.0, 0.0);
  EXPECT_DOUBLE_EQ(*record().standstill_s, *record().detected_s);
  EXPECT_DOUBLE_EQ(*record().distance_at_standstill_m, *record().distance_at_detection_m);
}

}  // namespace
}  // namespace berm::watch
