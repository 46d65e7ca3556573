// The sequencer's swings and the scanners that lead them: each swing to the truck begins with its scanner at the trigger angle, and waits for it, but not for ever;
// the swing back does not wait.
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

constexpr std::size_t left_scanner = 0;

TEST(SequencerScans, EachSwingBeginsWithItsScannerAtTheTriggerAngleAndMostlyNeedNotWait) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  while (events.named("pass").size() < 5 && run.seconds < 200.0) run.step();
  const auto begun = events.named("leads");
  ASSERT_GE(begun.size(), 10U);
  double waited_s = 0.0;
  int to_truck = 0;
  for (const auto& swing : begun) {
    const double spare = swing.at("ahead_deg").get<double>() - swing.at("trigger_deg").get<double>();
    EXPECT_GT(swing.at("trigger_deg").get<double>(), 20.0) << swing;
    if (swing.at("way") == "to dig") {
      EXPECT_EQ(swing.at("waited_s").get<double>(), 0.0) << swing;
      continue;
    }
    ++to_truck;
    EXPECT_GT(spare, -0.5) << swing;  // a look at the script earlier
    waited_s += swing.at("waited_s").get<double>();
  }
  EXPECT_TRUE(events.named("scanner_late").empty());
  ASSERT_GE(to_truck, 5);
  EXPECT_LT(waited_s / to_truck, 0.1) << "it comes out while the bucket still fills";
}

// Put under the boom as the bucket comes out of the soil.
TEST(SequencerScans, ASwingWaitsForAScannerThatIsStillOnItsWay) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  std::uint16_t before = BERM_PHASE_WAIT;
  while (events.named("pass").size() < 3 && run.seconds < 200.0) {
    run.step();
    if (run.last.phase == BERM_PHASE_LIFT && before != BERM_PHASE_LIFT) run.plant.put_pan(left_scanner, radians(5.0));
    before = run.last.phase;
  }
  const auto begun = events.named("leads");
  ASSERT_GE(begun.size(), 6U);
  double longest = 0.0;
  for (const auto& swing : begun) {
    const double waited_s = swing.at("waited_s").get<double>();
    if (swing.at("way") == "to dig") continue;
    longest = std::max(longest, waited_s);
    EXPECT_GT(swing.at("ahead_deg").get<double>(), swing.at("trigger_deg").get<double>() - 0.5) << swing;
  }
  EXPECT_GT(longest, 0.1);
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
