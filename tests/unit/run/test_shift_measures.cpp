// The figures that a run is judged by, on cases computed by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "run/dig_surface.hpp"
#include "run/kinematic_bound.hpp"
#include "run/own_motion.hpp"
#include "run/percentile.hpp"
#include "run/run_result.hpp"
#include "run/shift_measures.hpp"
#include "run/trace_file.hpp"
#include "scratch.hpp"

namespace {

using namespace berm::run;
using nlohmann::json;

constexpr JointLimit kUnit{1.0, 2.0};  // reaches 1 rad/s after half a second and a quarter of a radian

TEST(Percentile, IsTheValueThatTheShareLiesBelow) {
  EXPECT_EQ(percentile_of({}, 0.5), 0.0);
  EXPECT_EQ(percentile_of({7.0}, 0.95), 7.0);
  EXPECT_EQ(percentile_of({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(percentile_of({4.0, 1.0, 3.0, 2.0}, 0.5), 3.0) << "the upper one of the two in the middle";
  std::vector<double> hundred;
  for (int i = 100; i >= 1; --i) hundred.push_back(i);
  EXPECT_EQ(percentile_of(hundred, 0.95), 96.0);
  EXPECT_EQ(percentile_of(hundred, 1.0), 100.0);
}

TEST(KinematicBound, IsATriangleOrATrapezoid) {
  EXPECT_EQ(rest_to_rest_s(0.0, kUnit), 0.0);
  EXPECT_NEAR(rest_to_rest_s(0.125, kUnit), 0.5, 1e-12) << "2 sqrt(0.125 / 2)";
  EXPECT_NEAR(rest_to_rest_s(0.5, kUnit), 1.0, 1e-12) << "just reaches the velocity";
  EXPECT_NEAR(rest_to_rest_s(-2.0, kUnit), 2.5, 1e-12) << "2 / 1 + 1 / 2";
}

TEST(KinematicBound, TurnsRoundAtTheDumpUnlessItIsOnTheWay) {
  EXPECT_NEAR(through_dump_s(0.0, 2.0, 0.0, kUnit), 5.0, 1e-12);
  EXPECT_NEAR(through_dump_s(0.0, 1.0, 2.0, kUnit), 2.5, 1e-12) << "passed without a rest";
  EXPECT_NEAR(through_dump_s(2.0, 1.0, 0.0, kUnit), 2.5, 1e-12);
  EXPECT_NEAR(through_dump_s(0.0, -2.0, 2.0, kUnit), 2.5 + 4.5, 1e-12);
  EXPECT_NEAR(through_dump_s(1.0, 1.0, 3.0, kUnit), 2.5, 1e-12);
}

TEST(KinematicBound, IsTheSlowestJoints) {
  JointLimits limits{kUnit, kUnit, kUnit, {0.5, 2.0}};
  EXPECT_NEAR(kinematic_bound_s({0, 0, 0, 0}, {2, 0, 0, 0}, {0, 0, 0, 0}, limits), 5.0, 1e-12);
  EXPECT_NEAR(kinematic_bound_s({0, 0, 0, 0}, {2, 0, 0, 2}, {0, 0, 0, 0}, limits), 2 * (4.0 + 0.25), 1e-12);
}

json phase(const char* name, double time_s, int truck = 1) { return {{"event", "phase"}, {"phase", name}, {"time_s", time_s}, {"truck", truck}}; }

TEST(KinematicRatio, IsOfEveryPassThatADigOfTheSameTruckFollows) {
  const std::vector<json> events{phase("dig", 0), phase("lift", 10), phase("swing to truck", 11), phase("dump", 14), phase("swing to dig", 17),
                                 phase("dig", 22),
                                 phase("dig", 23), phase("lift", 30), phase("swing to dig", 33), phase("dig", 40, 2),
                                 phase("lift", 50, 2), phase("dig", 52, 2),
                                 phase("lift", 60, 2), phase("lift", 61, 2), phase("swing to dig", 65, 2), phase("dig", 70, 2),
                                 phase("lift", 80, 2)};
  const auto spans = pass_spans(events);
  ASSERT_EQ(spans.size(), 2u) << "not to another truck, not without a dump, not without an end";
  EXPECT_EQ(spans[0].lift_s, 10.0);
  EXPECT_EQ(spans[0].emptied_s, 17.0);
  EXPECT_EQ(spans[0].dig_s, 22.0);
  EXPECT_EQ(spans[1].lift_s, 61.0);
  std::vector<TraceRow> rows;
  for (int k = 0; k <= 8000; ++k) {
    const double t = 0.01 * k, swing = t < 10 ? 0.0 : t < 17 ? 2.0 * (t - 10) / 7 : t < 22 ? 2.0 - 2.0 * (t - 17) / 5 : 0.0;
    rows.push_back({t, {swing, 0, 0, 0}, {}});
  }
  const auto ratios = kinematic_ratios(events, rows, {kUnit, kUnit, kUnit, kUnit});
  ASSERT_EQ(ratios.size(), 1u) << "nothing moved in the second: no bound";
  EXPECT_NEAR(ratios[0], 12.0 / 5.0, 1e-6);
}

StopEvent stop(double time_s, const char* reason) { return {time_s, reason, false, 0, 0, 0}; }

TEST(OwnMotionStops, LeaveOutWhatAnIntruderOrAFaultMayHaveCaused) {
  std::vector<TraceRow> rows;
  for (int k = 0; k < 2000; ++k) {
    const double t = 0.1 * k;
    rows.push_back({t, {}, {{t >= 50 && t < 60 ? 11.0 : 30.0, 0.0}}});
  }
  const std::vector<StopEvent> stops{stop(40, "overpass"), stop(55, "overpass"), stop(69, "stale_ground"), stop(71, "stale_ground"),
                                     stop(90, "overpass"), stop(129, "overpass"), stop(131, "overpass")};
  // Somebody within 12 m from 50 to 60 s, something wrong from 90 to 120 s, a memory of 10 s.
  const auto own = own_motion_stops(stops, {{90, 120}}, rows, 12.0, 10.0);
  EXPECT_EQ(own, (std::map<std::string, int>{{"overpass", 2}, {"stale_ground", 1}})) << "at 40, 131 and 71 s";
  EXPECT_EQ(own_motion_stops(stops, {{90, 120}}, rows, 5.0, 10.0).at("stale_ground"), 2) << "farther away than 5 m he is not near";
}

// The plant's 22.01 and the kernel's are not the same number.
TEST(OwnMotionStops, LeaveOutTheStopInTheVeryCycleOfADisturbance) {
  const double pressed = 22.01, told = 2201 * 0.01 - 4e-15;
  ASSERT_LT(told, pressed);
  EXPECT_TRUE(own_motion_stops({stop(told, "operator")}, {{pressed, 22.51}}, {}, 12.0, 10.0).empty());
  EXPECT_EQ(own_motion_stops({stop(pressed - 0.01, "operator")}, {{pressed, 22.51}}, {}, 12.0, 10.0).at("operator"), 1) << "a cycle before";
}

TEST(OwnMotionStops, LeaveOutWhomTheKernelToldOfBeforeHisMiddleWasInTheRegion) {
  const std::vector<TraceRow> rows{{184.9, {}, {{-13.96, -7.04}}}, {185.1, {}, {{-13.82, -7.01}}}};
  const StopEvent front{185.15, "intruder", true, -13.35, -7.05, 1.4}, elsewhere{185.15, "intruder", true, -9.75, -6.15, 0.8};
  EXPECT_TRUE(own_motion_stops({front}, {}, rows, 15.0, 10.0).empty());
  EXPECT_EQ(own_motion_stops({elsewhere}, {}, rows, 15.0, 10.0).at("intruder"), 1) << "he is 4 m from there";
  StopEvent placeless = front;
  placeless.has_place = false;
  EXPECT_EQ(own_motion_stops({placeless}, {}, rows, 15.0, 10.0).at("intruder"), 1);
}

TEST(OwnMotionStops, DisturbancesAreThePlantsAndTheProcessFault) {
  RunOptions options;
  options.fault = ProcessFault{FaultKind::kill_app, 33.0};
  const json truth = {{"disturbances", {{{"what", "dust"}, {"from_s", 5.0}, {"to_s", 7.0}}, {{"what", "base"}, {"from_s", 9.0}, {"to_s", nullptr}}}}};
  const auto all = disturbances_of(truth, options);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].from_s, 33.0);
  EXPECT_TRUE(std::isinf(all[0].to_s) && std::isinf(all[2].to_s));
  EXPECT_EQ(all[1].to_s, 7.0);
  EXPECT_TRUE(disturbances_of(json::object(), RunOptions{}).empty());
}

// A plane of height -1, dug along bearing 0 from r 6 to 4 at -1.2, followed to 4.5, and along 90 degrees.
TEST(DigSurface, IsTheMeanDistanceFromTheLastDigsPlan) {
  const HeightField flat{0.0, -1.0, 0.5, 20, 20, std::vector<double>(400, -1.0)};
  const PlannedDig ahead{0.0, {{{6.0, -1.2}, {4.0, -1.2}}}, 4.5};
  EXPECT_NEAR(dig_surface_error_m(flat, {ahead}, 0.45).value(), 0.2, 1e-9);
  const PlannedDig again{0.0, {{{6.0, -1.05}, {4.0, -1.05}}}, 4.0};
  EXPECT_NEAR(dig_surface_error_m(flat, {ahead, again}, 0.45).value(), 0.05, 1e-9) << "the last counts";
  // The second dig was followed over a quarter of the first's length only: one of three columns of cells (5.75; 5.25 and 4.75 are the first's).
  const PlannedDig shorter{0.0, {{{6.0, -1.05}, {4.0, -1.05}}}, 5.5};
  EXPECT_NEAR(dig_surface_error_m(flat, {ahead, shorter}, 0.45).value(), (0.05 + 2 * 0.2) / 3, 1e-9);
  const PlannedDig aside{std::numbers::pi / 2, {{{6.0, -1.3}, {4.0, -1.3}}}, 4.0};
  EXPECT_NEAR(dig_surface_error_m(flat, {aside}, 0.45).value(), 0.3, 1e-9) << "its cells lie at y 4 to 6, x to 0.45";
  const PlannedDig steep{0.0, {{{6.0, -2.0}, {4.0, 0.0}}}, 4.0};
  EXPECT_NEAR(dig_surface_error_m(flat, {steep}, 0.45).value(), 0.5 * std::numbers::sqrt2 / 2, 1e-9) << "in the plane, not in height: 0.75, 0.25 ...";
  EXPECT_FALSE(dig_surface_error_m(flat, {}, 0.45).has_value());
}

TEST(DigSurface, DigsAreTheAppsEvents) {
  const std::vector<json> events{{{"event", "dig"}, {"bearing_deg", 90.0}, {"shape", {{7.0, -1.0}, {6.0, -1.5}, {5.0, -1.0}}}},
                                 {{"event", "dug"}, {"r_m", 5.6}},
                                 {{"event", "dig"}, {"bearing_deg", 0.0}, {"shape", {{7.0, -1.0}, {5.0, -1.0}}}},
                                 {{"event", "dig"}, {"bearing_deg", 0.0}}};
  const auto digs = planned_digs(events);
  ASSERT_EQ(digs.size(), 2u);
  EXPECT_NEAR(digs[0].bearing, std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(digs[0].reached_r, 5.6);
  EXPECT_EQ(digs[1].reached_r, 5.0) << "all of it, where the app did not tell of its end";
}

TEST(DigSurface, HeightFieldsAndTracesAreReadOrRefused) {
  const berm::test::Scratch scratch;
  const HeightField field = read_height_field(scratch.write("t.csv", "-1,2,0.5,2,2\n1,2\n3,4\n"));
  EXPECT_EQ(field.y0, 2.0);
  EXPECT_EQ(field.height, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_THROW(read_height_field(scratch.write("short.csv", "-1,2,0.5,2,2\n1,2\n3\n")), std::runtime_error);
  EXPECT_THROW(read_height_field(scratch.path("none.csv")), std::runtime_error);
  const std::string head = "time_s,swing_rad,boom_rad,stick_rad,bucket_rad,truck_1_x_m,truck_1_y_m,eve_x_m,eve_y_m\n";
  const auto rows = read_trace(scratch.write("trace.csv", head + "0.01,1,2,3,4,5,6,7,8\n0.02,1,2,3,5,5,6,7,9\n"));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].angle[3], 5.0);
  EXPECT_EQ(rows[1].intruder, (std::vector<std::array<double, 2>>{{7, 9}})) << "a truck is no intruder";
  EXPECT_EQ(row_at(rows, 0.02).angle[3], 5.0);
  EXPECT_EQ(row_at(rows, 9.0).time_s, 0.02);
  EXPECT_THROW(read_trace(scratch.write("foreign.csv", "a,b\n1,2\n")), std::runtime_error);
  EXPECT_THROW(read_trace(scratch.write("cut.csv", head + "0.01,1,2\n")), std::runtime_error);
}

TEST(TraceFile, WhereTheBaseStandsIsNobody) {
  const berm::test::Scratch folder;
  const std::string head = "time_s,swing_rad,boom_rad,stick_rad,bucket_rad,base_x,base_y,truck_1_x_m,truck_1_y_m,person_x_m,person_y_m\n";
  const auto rows = read_trace(folder.write("trace.csv", head + "1.0,0,0,0,0,-5.0,0.5,1.0,2.0,-8.0,3.5\n"));
  ASSERT_EQ(rows.size(), 1U);
  ASSERT_EQ(rows[0].intruder.size(), 1U) << "the person, and neither truck nor base";
  EXPECT_DOUBLE_EQ(rows[0].intruder[0][0], -3.0);
  EXPECT_DOUBLE_EQ(rows[0].intruder[0][1], 3.0);
}

TEST(DigSurface, DigsLieWhereTheMachineStoodThen) {
  std::vector<PlannedDig> digs(3);
  digs[0].time_s = 10, digs[1].time_s = 50, digs[2].time_s = 90;
  place_digs(digs, json{{"bench_moves", {{{"to_s", 40.0}, {"x_m", -1.0}, {"y_m", 0.0}}, {{"to_s", 80.0}, {"x_m", -2.5}, {"y_m", 0.5}}}}});
  EXPECT_EQ(digs[0].base_x, 0.0);
  EXPECT_EQ(digs[1].base_x, -1.0);
  EXPECT_EQ(digs[2].base_x, -2.5);
  EXPECT_EQ(digs[2].base_y, 0.5);
}

TEST(ShiftMeasures, AreInResultAndSummaryAndNullWhereThereIsNothing) {
  RunResult r;
  r.truth = {{"simulated_seconds", 60.0}, {"target_kg", 18000.0}, {"truck_load_kg", {18000.0}}};
  for (const char* key : {"pass_seconds_median", "pass_seconds_p95", "kinematic_ratio_median", "dig_surface_error_m", "plan_ms_max", "soil"})
    EXPECT_TRUE(flat_json(r).at(key).is_null()) << key;
  EXPECT_EQ(flat_json(r).at("own_motion_stops"), json::object());
  r.options.soil = "dry_sand";
  for (const double s : {20.0, 30.0, 22.0}) r.app_events.push_back({{"event", "pass"}, {"seconds", s}});
  r.app_events.push_back({{"event", "next_dig"}, {"plan_ms", 3.5}});
  r.app_events.push_back({{"event", "dump"}, {"plan_ms", 7.25}});
  r.app_events.push_back({{"event", "phase"}, {"plan_ms", 99.0}});
  r.measures.kinematic_ratios = {2.0, 1.5, 1.75};
  r.measures.own_motion_stops = {{"stale_ground", 2}};
  r.measures.dig_surface_error_m = 0.125;
  const json j = flat_json(r);
  EXPECT_EQ(j.at("soil"), "dry_sand");
  EXPECT_EQ(j.at("pass_seconds_median"), 22.0);
  EXPECT_EQ(j.at("pass_seconds_p95"), 30.0);
  EXPECT_EQ(j.at("kinematic_ratio_median"), 1.75);
  EXPECT_EQ(j.at("plan_ms_max"), 7.25);
  EXPECT_EQ(j.at("dig_surface_error_m"), 0.125);
  EXPECT_EQ(j.at("own_motion_stops").at("stale_ground"), 2);
  const std::string text = summary_text(r);
  for (const char* words : {"soil dry_sand", "median 22.0, p95 30.0, 20.0 to 30.0", "median 1.75 times", "12.5 cm from the plan", "7.2 ms",
                            "stale_ground 2"})
    EXPECT_THAT(text, testing::HasSubstr(words));
}

}  // namespace
