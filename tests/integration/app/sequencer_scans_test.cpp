// The sequencer's swings and the scanners that lead them: each swing begins with its scanner at the trigger angle, and waits for it, but not for ever.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/scan_wait.hpp"
#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

constexpr std::size_t left_scanner = 0, right_scanner = 1;

TEST(SequencerScans, EachSwingBeginsWithItsScannerAtTheTriggerAngleAndMostlyNeedNotWait) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  while (events.named("pass").size() < 5 && run.seconds < 200.0) run.step();
  const auto begun = events.named("leads");
  ASSERT_GE(begun.size(), 10U);
  double waited_s = 0.0;
  for (const auto& swing : begun) {
    EXPECT_GT(swing.at("ahead_deg").get<double>(), swing.at("trigger_deg").get<double>() - 0.5) << swing;  // a look at the script earlier
    EXPECT_GT(swing.at("trigger_deg").get<double>(), 20.0) << swing;
    waited_s += swing.at("waited_s").get<double>();
  }
  EXPECT_TRUE(events.named("scanner_late").empty());
  EXPECT_LT(waited_s / static_cast<double>(begun.size()), 0.1) << "it comes out while the bucket still fills and pours";
}

// Put under the boom as the bucket comes out of the soil, or as it opens.
TEST(SequencerScans, ASwingWaitsForAScannerThatIsStillOnItsWay) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  std::uint16_t before = BERM_PHASE_WAIT;
  while (events.named("pass").size() < 3 && run.seconds < 200.0) {
    run.step();
    if (run.last.phase == BERM_PHASE_LIFT && before != BERM_PHASE_LIFT) run.plant.put_pan(left_scanner, radians(5.0));
    if (run.last.phase == BERM_PHASE_DUMP && before != BERM_PHASE_DUMP) run.plant.put_pan(right_scanner, radians(10.0));
    before = run.last.phase;
  }
  const auto begun = events.named("leads");
  ASSERT_GE(begun.size(), 6U);
  for (const char* way : {"to truck", "to dig"}) {
    double longest = 0.0;
    for (const auto& swing : begun)
      if (swing.at("way") == way) longest = std::max(longest, swing.at("waited_s").get<double>());
    EXPECT_GT(longest, 0.1) << way;
  }
  for (const auto& swing : begun) EXPECT_GT(swing.at("ahead_deg").get<double>(), swing.at("trigger_deg").get<double>() - 0.5) << swing;
  EXPECT_TRUE(events.named("scanner_late").empty());
}

TEST(SequencerScans, ForAScannerThatDoesNotComeASwingWaitsABoundedTime) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  while (events.named("pass").size() < 2 && run.seconds < 200.0) {
    run.step();
    if (run.last.phase == BERM_PHASE_LIFT) run.plant.put_pan(left_scanner, radians(-10.0));
  }
  ASSERT_EQ(events.named("pass").size(), 2U);
  const auto late = events.named("scanner_late");
  ASSERT_EQ(late.size(), 2U);
  for (const auto& event : late) {
    EXPECT_EQ(event.at("way"), "to truck");
    EXPECT_NEAR(event.at("waited_s").get<double>(), ScanWait::at_most_s, 0.05);
  }
}

}  // namespace
