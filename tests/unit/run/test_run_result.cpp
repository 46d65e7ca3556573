// What a run's summary and JSON say of the time under the kernel's governor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/run_result.hpp"

namespace {

using namespace berm::run;
using nlohmann::json;

RunResult with_events(std::vector<json> events) {
  RunResult r;
  r.truth = {{"simulated_seconds", 60.0}, {"target_kg", 18000.0}, {"truck_load_kg", {18000.0}}};
  r.app_events = std::move(events);
  return r;
}

json slowed(double time_s) { return {{"event", "slowed"}, {"time_s", time_s}, {"joint", "swing"}, {"phase", "swing to truck"}}; }
json full_speed(double time_s, double slowed_s, double least) { return {{"event", "full_speed"}, {"time_s", time_s}, {"slowed_s", slowed_s}, {"least_share", least}}; }

std::string row(const RunResult& r) {
  const std::string text = summary_text(r), name = "slowed by the kernel";
  const auto at = text.find(name);
  return at == std::string::npos ? "no row" : text.substr(at + name.size(), text.find('\n', at) - at - name.size());
}

TEST(SlowedTime, IsNothingWhereNothingWasCut) {
  const RunResult r = with_events({{{"event", "connected"}}, {{"event", "exit"}, {"slowed_s", 0.0}, {"slowed_spans", 0}, {"least_share", 1.0}}});
  EXPECT_EQ(flat_json(r).at("slowed_seconds"), 0.0);
  EXPECT_EQ(flat_json(r).at("slowed_spans"), 0);
  EXPECT_THAT(row(r), testing::HasSubstr("never"));
}

TEST(SlowedTime, IsTheAppsOwnCountAtItsExit) {
  // The last span was open: its end was never told of.
  const RunResult r = with_events({slowed(10.0), full_speed(12.0, 2.0, 0.4), slowed(20.0), {{"event", "exit"}, {"slowed_s", 3.4}, {"slowed_spans", 2}, {"least_share", 0.25}}});
  EXPECT_EQ(flat_json(r).at("slowed_seconds"), 3.4);
  EXPECT_EQ(flat_json(r).at("slowed_spans"), 2);
  EXPECT_THAT(row(r), testing::HasSubstr("3.4 s in 2 spans (least 25 %)"));
}

TEST(SlowedTime, IsTheSumOfWhatAKilledAppHadTold) {
  const RunResult r = with_events({slowed(10.0), full_speed(12.0, 2.0, 0.4), slowed(20.0), full_speed(20.5, 0.5, 0.6), slowed(30.0)});
  EXPECT_EQ(flat_json(r).at("slowed_seconds"), 2.5);
  EXPECT_EQ(flat_json(r).at("slowed_spans"), 3);
  EXPECT_THAT(row(r), testing::HasSubstr("2.5 s in 3 spans (least 40 %)"));
}

TEST(SlowedTime, FieldsAreFlatNumbers) {
  const json j = flat_json(with_events({}));
  EXPECT_TRUE(j.at("slowed_seconds").is_number_float());
  EXPECT_TRUE(j.at("slowed_spans").is_number_integer());
}

}  // namespace
