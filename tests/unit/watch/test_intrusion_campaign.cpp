// Many intrusions: what is shared between them changes no result.
#include "watch/intrusion_campaign.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "watch/intrusion_line.hpp"

namespace berm::watch {
namespace {

constexpr std::uint64_t seed = 3;

Intrusion numbered(int run) {
  Intrusion intrusion;
  intrusion.seed = seed;
  intrusion.run = run;
  return intrusion;
}

TEST(IntrusionLine, SaysAllThatTheReportTakes) {
  IntrusionResult r;
  r.intrusion = numbered(17);
  r.outcome = Outcome::detected;
  r.record.name = "child \"one\"\n";
  r.record.entered_s = 1.0 / 3.0;
  r.record.detected_s = 2.5;
  r.record.stopped_s = 2.25;
  r.record.detected_by = BERM_STOP_INTRUDER;
  r.record.stopped_by = 3;
  r.record.distance_at_detection_m = 4.0;
  r.record.inside_s = 1.25;
  r.record.stood_at_entry = true;
  r.alarms = {{2.5, -1.0, 2.0, 0.75, ""}, {3.5, 1.0, 2.0, 1.75, "child"}};
  r.false_alarms = 1;
  r.appeared_s = 0.25;
  r.unsafe_s = 6.0;
  r.truck_distance_m = 0.125;
  r.closest_m = 3.0;
  r.ended_s = 7.0;
  const std::string line = line_of(r);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const IntrusionResult again = result_of(line, numbered);
  EXPECT_EQ(line_of(again), line);
  EXPECT_EQ(again.intrusion.run, 17);
  EXPECT_EQ(again.outcome, Outcome::detected);
  EXPECT_EQ(again.record.name, r.record.name);
  EXPECT_EQ(again.record.entered_s, r.record.entered_s) << "to the last bit";
  EXPECT_FALSE(again.record.standstill_s);
  EXPECT_FALSE(again.contact_s);
  EXPECT_EQ(again.unsafe_s, 6.0);
  EXPECT_TRUE(again.record.stood_at_entry);
  ASSERT_EQ(again.alarms.size(), 2U);
  EXPECT_EQ(again.alarms[1].nearest, "child");
  EXPECT_EQ(again.false_alarms, 1);
  EXPECT_THROW(result_of("{}", numbered), std::exception);
}

TEST(IntrusionCampaign, ATrialAloneIsTheSameAsAmongOthers) {
  const Bench bench = make_bench(BERM_MACHINES "/zx200.toml", false, BERM_PLANT_PROFILES);
  constexpr int count = 5;
  Campaign campaign;
  campaign.seed = seed;
  int told = 0;
  run_campaign(bench, count, 2, campaign, [&](const IntrusionResult&) { EXPECT_EQ(campaign.results.size(), static_cast<std::size_t>(++told)); });
  ASSERT_EQ(told, count);
  int appeared = 0;
  for (int run = 0; run < count; ++run) {
    const IntrusionResult& r = campaign.results[static_cast<std::size_t>(run)];
    ASSERT_EQ(r.intrusion.run, run) << "in the order of their numbers";
    appeared += r.appeared_s ? 1 : 0;
  }
  EXPECT_GE(appeared, 4);
  for (const int run : {1, 4}) {
    const IntrusionResult alone = run_intrusion(bench, draw_intrusion(seed, run, bench.intrusion_site), {});
    EXPECT_EQ(line_of(alone), line_of(campaign.results[static_cast<std::size_t>(run)])) << run;
  }
}

}  // namespace
}  // namespace berm::watch
