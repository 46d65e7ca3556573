// Between two stands of the machine: what counts as the move that was asked for, and that it is not asked for again and again.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

class BenchMove : public ::testing::Test {
protected:
  // Before soil that no bucket reaches, so that a move is asked for as soon as a truck was looked at.
  static SiteModel out_of_reach() {
    SiteModel site = app_bench::bench();
    site.dig_radius_start = 14.0, site.dig_radius_end = 13.0;
    return site;
  }
  // Whether the horn sounds within so long.
  static bool sounds(Loading& run, double seconds) {
    for (const double end = run.seconds + seconds; run.seconds < end;) {
      run.step();
      if (run.last.horn) return true;
    }
    return false;
  }
  // Until the move is asked for with the horn.
  void await_call(Loading& run, std::size_t which) const {
    for (const double end = run.seconds + 120.0; run.seconds < end && (events_.named("move_back").size() < which || !run.last.horn);)
      for (int k = 0; k < 10 && !run.last.horn; ++k) run.step();
    ASSERT_EQ(events_.named("move_back").size(), which);
    ASSERT_TRUE(run.last.horn) << "nobody is told";
  }
  // The kernel stops for that reason, and runs again.
  static void stop(Loading& run, std::uint8_t reason, double seconds) {
    run.plant.stop_reason = reason;
    run.plant.kernel_runs = false;
    run.go(seconds);
    run.plant.kernel_runs = true;
  }
  long calls(const std::string& reason) const {
    const auto all = events_.named("operator_needed");
    return std::count_if(all.begin(), all.end(), [&](const auto& e) { return e.at("reason") == reason; });
  }

  app_bench::Events events_;
};

// The operator trams without the run switch, and the kernel sees the base move.
TEST_F(BenchMove, AMovedBaseIsTheMoveThatWasAskedFor) {
  Loading run(1, start_pose(), events_.fd(), out_of_reach());
  await_call(run, 1);
  run.plant.stop_reason = BERM_STOP_BASE_MOVED;
  run.plant.kernel_runs = false;
  run.go(0.1);
  EXPECT_FALSE(sounds(run, 70.0)) << "nobody is called while he does it";
  EXPECT_EQ(events_.named("operator_needed").size(), 1u) << "nor is the operator told of his own stop";
  EXPECT_TRUE(events_.named("moved").empty()) << "before the kernel lets it work";
  const std::size_t looks = run.finder.looks.size();
  run.plant.kernel_runs = true;
  run.go(1.0);
  ASSERT_EQ(events_.named("moved").size(), 1u);
  EXPECT_EQ(events_.named("moved")[0].at("distance_m"), events_.named("move_back")[0].at("distance_m"));
  run.go(30.0);
  EXPECT_GT(run.finder.looks.size(), looks) << "the truck stands elsewhere, as seen from the machine";
}

TEST_F(BenchMove, AnotherStopIsNoMove) {
  Loading run(1, start_pose(), events_.fd(), out_of_reach());
  await_call(run, 1);
  stop(run, BERM_STOP_INTRUDER, 5.0);
  run.go(5.0);
  EXPECT_TRUE(events_.named("moved").empty());
  EXPECT_EQ(events_.named("move_back").size(), 1u);
  EXPECT_TRUE(sounds(run, 40.0)) << "it is asked for on";
}

// Moves that brought nothing: then another face is needed, not another move.
TEST_F(BenchMove, WhenMovingBackDoesNotHelpTheFaceIsExhausted) {
  Loading run(1, start_pose(), events_.fd(), out_of_reach());
  std::size_t moves = 0;
  while (events_.named("face_exhausted").empty() && moves < 6) {
    await_call(run, ++moves);
    if (HasFatalFailure()) return;
    stop(run, BERM_STOP_BASE_MOVED, 5.0);
    for (const double end = run.seconds + 120.0; run.seconds < end && events_.named("face_exhausted").empty() && events_.named("move_back").size() <= moves;) run.go(1.0);
  }
  EXPECT_EQ(moves, 2u) << "three stands in a row gave nothing";
  ASSERT_EQ(events_.named("face_exhausted").size(), 1u);
  EXPECT_EQ(events_.named("face_exhausted")[0].at("truck"), 1);
  EXPECT_EQ(events_.named("face_exhausted")[0].at("loaded_kg"), 0.0);
  EXPECT_EQ(calls("face exhausted"), 1);
  EXPECT_EQ(calls("move back"), 2);
  const auto advice = events_.named("operator_needed").back().at("advice").get<std::string>();
  EXPECT_NE(advice.find("moving back did not help"), std::string::npos) << advice;
  EXPECT_NE(advice.find("another face"), std::string::npos) << advice;
  // And there it ends: it stands, and neither the horn nor a move of the base wakes it.
  EXPECT_FALSE(sounds(run, 40.0));
  stop(run, BERM_STOP_BASE_MOVED, 5.0);
  for (int k = 0; k < 2000; ++k) {
    run.step();
    for (const double v : run.last.velocity) ASSERT_EQ(v, 0.0);
  }
  EXPECT_EQ(events_.named("moved").size(), 2u);
  EXPECT_EQ(events_.named("move_back").size(), 2u);
}

}  // namespace
