// The sequencer's swings and the scanners that lead them: each swing to the truck begins with its scanner at the trigger angle, and waits for it, but not for ever;
// the swing back waits for no more than a moment.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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
  std::vector<double> back;
  for (const auto& swing : begun) {
    const double spare = swing.at("ahead_deg").get<double>() - swing.at("trigger_deg").get<double>();
    if (swing.at("way") == "to dig") back.push_back(spare);
    else { EXPECT_GT(spare, -0.5) << swing; }  // a look at the script earlier
    EXPECT_GT(swing.at("trigger_deg").get<double>(), 20.0) << swing;
    waited_s += swing.at("waited_s").get<double>();
  }
  for (const auto& late : events.named("scanner_late")) EXPECT_EQ(late.at("way"), "to dig");
  ASSERT_GE(back.size(), 5U);
  std::sort(back.begin(), back.end());
  EXPECT_GT(back[back.size() / 2], -20.0) << "the last sweep over the way back is timed by when the swing begins";
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
    if (run.last.phase == BERM_PHASE_DUMP && before != BERM_PHASE_DUMP) run.plant.put_pan(right_scanner, radians(-6.0));
    before = run.last.phase;
  }
  const auto begun = events.named("leads");
  ASSERT_GE(begun.size(), 6U);
  double longest = 0.0;
  for (const auto& swing : begun) {
    const double waited_s = swing.at("waited_s").get<double>();
    if (swing.at("way") == "to dig") {
      EXPECT_LE(waited_s, ScanWait::back_at_most_s + 0.03) << swing;
      continue;
    }
    longest = std::max(longest, waited_s);
    EXPECT_GT(swing.at("ahead_deg").get<double>(), swing.at("trigger_deg").get<double>() - 0.5) << swing;
  }
  EXPECT_GT(longest, 0.1);
  for (const auto& late : events.named("scanner_late")) EXPECT_EQ(late.at("way"), "to dig");
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
  EXPECT_EQ(std::count_if(late.begin(), late.end(), [](const auto& event) { return event.at("way") == "to truck"; }), 2);
  for (const auto& event : late) {
    if (event.at("way") != "to truck") continue;
    EXPECT_NEAR(event.at("waited_s").get<double>(), ScanWait::at_most_s, 0.05);
  }
}

}  // namespace
