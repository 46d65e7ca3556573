// The map changes amid a pass: the sequencer sees it coming and changes its script, before its guard or the kernel has to slow the machine.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

class SequencerLooksAhead : public ::testing::Test {
protected:
  void step() {
    run_.step();
    // By the guard's own measure: what it would slow.
    if (skyline_ && run_.last.phase != BERM_PHASE_DIG && skyline_->blocking(preview(run_.machine, run_.plant.angle(), observe(run_.plant.state()).velocity), Skyline::Ranges::left_to_guard)) ++too_near_;
  }
  void to_phase(std::uint16_t phase, int times = 1) {
    for (std::uint16_t before = run_.last.phase; times > 0; before = run_.last.phase) {
      ASSERT_LT(run_.seconds, 200.0) << "no such phase";
      step();
      times -= before != phase && run_.last.phase == phase;
    }
  }
  void heap_up(double bearing_deg, double distance, double top) {
    constexpr double radius = 0.5;
    run_.plant.site().heap_up(distance * std::cos(radians(bearing_deg)), distance * std::sin(radians(bearing_deg)), radius, top);
    const app_bench::BenchSite& site = run_.plant.site();
    skyline_ = std::make_unique<Skyline>(run_.machine, app_bench::bench_with_truck(), [&site](double x, double y) { return site.height(x, y); });
  }
  void level(double bearing_deg, double distance) {
    for (double ahead = -0.6; ahead < 0.65; ahead += 0.05) run_.plant.site().cut((distance + ahead) * std::cos(radians(bearing_deg)), (distance + ahead) * std::sin(radians(bearing_deg)), radians(bearing_deg), 0.7, 0.0);
    skyline_.reset();
  }
  std::vector<std::string> told() const {
    std::vector<std::string> what;
    for (const auto& e : events_.named("look_ahead")) what.push_back(e.contains("rule") ? e.at("rule") : e.at("what"));
    return what;
  }

  app_bench::Events events_;
  Loading run_{1, start_pose(), events_.fd()};
  std::unique_ptr<Skyline> skyline_;
  int too_near_ = 0;  // cycles
};

TEST_F(SequencerLooksAhead, PassesThatAreClearAreLeftAsTheyAre) {
  to_phase(BERM_PHASE_DIG, 4);
  EXPECT_EQ(events_.named("pass").size(), 3u);
  EXPECT_EQ(told(), std::vector<std::string>{});
}

// Beside the dig, while the bucket is on its way to the truck.
TEST_F(SequencerLooksAhead, WhatIsHeapedUpMeanwhileIsReachedOutOverLater) {
  to_phase(BERM_PHASE_SWING_TO_TRUCK, 2);
  heap_up(10.0, 6.0, 0.5);
  to_phase(BERM_PHASE_DIG);
  EXPECT_EQ(told(), std::vector<std::string>{"reach out over dig"});
  ASSERT_FALSE(events_.named("look_ahead").empty()) << "it does not see it";
  const auto event = events_.named("look_ahead")[0];
  EXPECT_EQ(event.at("part"), "over dig");
  EXPECT_EQ(event.at("by"), "ground");
  EXPECT_GT(event.at("ahead_s").get<double>(), 1.0);
  EXPECT_NEAR(event.at("bearing_deg").get<double>(), 10.0, 10.0);
  EXPECT_EQ(run_.plant.findings().ground_contacts, 0);
}

// Higher than anything may be passed over, amid the way back: it is come to slowly; when it is gone the pass goes on as planned.
TEST_F(SequencerLooksAhead, TheSwingIsSlowedWhereNoRuleHelps) {
  constexpr double deg = 40.0, distance = 6.0;
  to_phase(BERM_PHASE_SWING_TO_DIG, 2);
  const auto swing_deg_s = [this] { return degrees(std::fabs(observe(run_.plant.state()).velocity[swing])); };
  heap_up(deg, distance, 1.2);
  for (const double end = run_.seconds + 3.0; told().empty() && run_.seconds < end;) step();
  ASSERT_EQ(told(), std::vector<std::string>{"slowed"});
  EXPECT_EQ(events_.named("look_ahead")[0].at("by"), "too high to pass over");
  EXPECT_GT(run_.plant.angle()[swing], radians(deg + 25.0)) << "it sees it late";
  for (const double end = run_.seconds + 1.5; run_.seconds < end;) step();
  const double share = events_.named("look_ahead")[0].at("swing_share");
  EXPECT_LT(swing_deg_s(), 1.1 * share * degrees(limits_of(run_.machine, swing, 8.0).velocity));
  EXPECT_EQ(too_near_, 0) << "the guard has to slow it";
  level(deg, distance);
  for (const double end = run_.seconds + 4.0; told().size() < 2 && run_.seconds < end;) step();
  EXPECT_EQ(told(), (std::vector<std::string>{"slowed", "full pace"}));
  to_phase(BERM_PHASE_DIG);
  EXPECT_EQ(run_.plant.findings().ground_contacts, 0);
}

}  // namespace
