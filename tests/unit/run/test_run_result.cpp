// What a run's summary and JSON say of the time under the kernel's governor, of the trucks' loads, and of what was recognised.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "run/recognised_truck.hpp"
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

std::string row(const RunResult& r, const std::string& name = "slowed by the kernel") {
  const std::string text = summary_text(r), begin = "\n  " + name + " ";
  const auto at = text.find(begin);
  return at == std::string::npos ? "no row" : text.substr(at + begin.size(), text.find('\n', at + 1) - at - begin.size());
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

TEST(Loads, AreOfTheTrucksThatWereLoaded) {
  RunResult r = with_events({});
  r.truth["truck_load_kg"] = {17900.0, 17800.0, 0.0, 0.0};
  EXPECT_THAT(row(r, "payload"), testing::HasSubstr("17.90 t (99.4 %), 17.80 t (98.9 %) of 18.00 t"));
  EXPECT_NE(row(r, "load"), "no row");
  r.truth["truck_load_kg"] = {0.0, 0.0};
  EXPECT_THAT(row(r, "payload"), testing::EndsWith(" none"));
  EXPECT_EQ(row(r, "load"), "no row");
}

TEST(Loads, AreAsFarOffAndUnevenAsTheWorstOfThem) {
  RunResult r = with_events({});
  r.truth["truck_load_kg"] = {17900.0, 17800.0, 17700.0};
  r.truth["load_centre_offset_m"] = 0.05;
  r.truth["load_height_stddev_m"] = 0.31;
  r.truth["trucks_left"] = {{{"load_centre_offset_m", 0.12}, {"load_height_stddev_m", 0.22}}, {{"load_centre_offset_m", 0.02}, {"load_height_stddev_m", 0.24}}};
  const json j = flat_json(r);
  EXPECT_EQ(j.at("load_centre_offset_m"), 0.05) << "of the last";
  EXPECT_EQ(j.at("load_centre_offset_m_worst"), 0.12);
  EXPECT_EQ(j.at("load_height_stddev_m_worst"), 0.31);
  EXPECT_THAT(row(r, "load"), testing::HasSubstr("centre 0.12 m off the bed's, height standard deviation 0.31 m, at most"));
  EXPECT_EQ(worst_of_trucks_left(r.truth, "load_height_stddev_m"), 0.24);
  r.truth.erase("trucks_left");
  EXPECT_EQ(worst_of_trucks_left(r.truth, "load_height_stddev_m"), std::nullopt);
  EXPECT_EQ(flat_json(r).at("load_centre_offset_m_worst"), 0.05);
}

json recognised(int truck, double x, double yaw_deg) {
  return {{"event", "recognised"}, {"truck", truck}, {"x_m", x}, {"y_m", 6.0}, {"yaw_deg", yaw_deg}, {"length_m", 5.0}, {"width_m", 2.4}, {"wall_top_m", 0.3}};
}

// A run of one full truck, with a fault due at 999 s.
RunResult with_fault(FaultKind kind, bool struck) {
  RunResult r = with_events({});
  r.options.fault = ProcessFault{kind, 999.0};
  r.fault_struck = struck;
  return r;
}

TEST(Shortcomings, AFaultThatTheRunDidNotReachIsOne) {
  for (const FaultKind kind : {FaultKind::kill_app, FaultKind::kill_kernel, FaultKind::kill_journal})
    EXPECT_THAT(shortcomings(with_fault(kind, false)), testing::ElementsAre("the run ended before the fault (999 s): after 60.0 s"));
  EXPECT_THAT(shortcomings(with_fault(FaultKind::kill_app, true)), testing::ElementsAre("the machine did not come to a standstill after the fault"));
  for (const FaultKind kind : {FaultKind::kill_journal, FaultKind::pause_app, FaultKind::pause_kernel}) EXPECT_THAT(shortcomings(with_fault(kind, true)), testing::IsEmpty());
  RunResult interrupted = with_fault(FaultKind::kill_app, false);
  interrupted.interrupted = "Interrupt";
  EXPECT_THAT(shortcomings(interrupted), testing::ElementsAre("interrupted (Interrupt) after 60.0 s"));
}

TEST(Recognition, IsJudgedByTheWorstCornerInSpaceOfEachTrucksFirstAnswer) {
  RunResult r = with_events({recognised(1, 1.0, 180.0), recognised(1, 9.0, 180.0), recognised(2, 1.0, 180.0)});
  json bed = recognised(1, 1.03, 180.0);
  bed["wall_top_m"] = 0.34;
  r.truth["truck_bed"] = {bed, recognised(2, 1.0, 0.0)};
  const auto errors = flat_json(r).at("recognition_error_m").get<std::vector<double>>();
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NEAR(errors[0], 0.05, 1e-9);
  EXPECT_NEAR(errors[1], std::hypot(5.0, 2.4), 1e-9) << "the wrong way round";
  EXPECT_THAT(summary_text(r), testing::HasSubstr("trucks recognised"));
}

TEST(Recognition, OfNoTruckThereIsNoError) {
  EXPECT_TRUE(flat_json(with_events({recognised(1, 1.0, 180.0)})).at("recognition_error_m").empty()) << "no truth";
  EXPECT_TRUE(recognised_bed({}).empty());
  const auto outline = recognised_bed({recognised(1, 0.0, 0.0), {{"event", "pass"}}, recognised(2, 1.0, 90.0)});
  ASSERT_EQ(outline.size(), 4u);
  EXPECT_NEAR(outline[0].first, 1.0 - 1.2, 1e-9);
  EXPECT_NEAR(outline[0].second, 6.0 + 2.5, 1e-9);
}

}  // namespace
