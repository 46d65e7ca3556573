// What a shift's report says, by rows and by keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "plant/process/scenario.hpp"
#include "scratch.hpp"
#include "soak/drawn_shift.hpp"
#include "soak/shift_report.hpp"

namespace berm::soak {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Half an hour: two trucks that left, one of them not full, and one that was being loaded.
run::RunResult half_an_hour() {
  run::RunResult r;
  r.options.seed = 7;
  r.truth = {{"simulated_seconds", 1800.0}, {"target_kg", 18000.0}, {"end_reason", "time limit"}, {"spill_fraction", 0.0123}, {"truck_load_kg", {17900.0, 15000.0, 4100.0, 0.0}},
             {"trucks_left", {{{"load_kg", 17900.0}, {"load_centre_offset_m", 0.05}, {"load_height_stddev_m", 0.21}}, {{"load_kg", 15000.0}, {"load_centre_offset_m", 0.11}, {"load_height_stddev_m", 0.18}}}},
             {"load_centre_offset_m", 0.42}, {"load_height_stddev_m", 0.39}, {"closest_approach_m", 1.346}, {"closest_approach_what", "person_2"},
             {"bench_moves", {{{"distance_m", 1.0}}, {{"distance_m", 1.5}}, {{"distance_m", 1.0}}}}, {"operator_presses", {{{"time_s", 700.0}}, {{"time_s", 900.0}}}}, {"hand_lifts", {{{"from_s", 710.0}}}}};
  r.app_events = {{{"event", "pass"}, {"time_s", 100.0}, {"seconds", 15.0}}, {{"event", "pass"}, {"time_s", 120.0}, {"seconds", 17.0}}, {{"event", "pass"}, {"time_s", 1500.0}, {"seconds", 19.0}}};
  r.wall_seconds = 400.0;
  r.stops = {{"intruder", 3}, {"overpass", 2}};
  r.measures.own_motion_stops = {{"overpass", 2}, {"intruder", 1}};
  r.memory = {12.34, 5.0, 7.34};
  return r;
}

std::string row(const json& report, const std::string& name) {
  const std::string text = shift_text(report), begin = "\n  " + name;
  const auto at = text.find(begin);
  if (at == std::string::npos) return "no row";
  const std::string line = text.substr(at + begin.size(), text.find('\n', at + 1) - at - begin.size());
  return line.substr(std::min(line.size(), line.find_first_not_of(' ')));
}

json report_of(const run::RunResult& r) { return shift_json(r, 0.5, {}); }

TEST(ShiftReport, HeadSaysOfWhatItIs) { EXPECT_THAT(shift_text(report_of(half_an_hour())), HasSubstr("Report of the shift (seed 7; a simulation)\n")); }

TEST(ShiftReport, TimeIsSimulatedAskedForAndBeyondRealTime) {
  EXPECT_EQ(row(report_of(half_an_hour()), "time"), "0.50 h of 0.50 h, 4.5 times real time; end: time limit");
}

TEST(ShiftReport, TrucksAreThoseThatLeft) {
  const json report = report_of(half_an_hour());
  EXPECT_EQ(row(report, "trucks"), "2 left, 1 of them loaded to 95 % or more; 3 bench moves");
  EXPECT_EQ(report["payload_kg"], json({17900.0, 15000.0}));
}

TEST(ShiftReport, TonnesAreOfAllThatWasLoadedAndByTheHour) {
  EXPECT_EQ(row(report_of(half_an_hour()), "tonnes"), "37.0, 74.0 an hour");
  run::RunResult none;
  none.truth = {{"simulated_seconds", 0.0}};
  EXPECT_EQ(row(report_of(none), "tonnes"), "0.0, 0.0 an hour");
}

TEST(ShiftReport, PassesHaveTheirMedianAndTheir95thPercentile) {
  EXPECT_EQ(row(report_of(half_an_hour()), "passes"), "3, seconds median 17.0, p95 19.0");
  run::RunResult none = half_an_hour();
  none.app_events.clear();
  EXPECT_EQ(row(report_of(none), "passes"), "0, seconds median none, p95 none");
}

TEST(ShiftReport, StopsAreByReasonAndTheNeedlessAmongThem) {
  const json report = report_of(half_an_hour());
  EXPECT_EQ(row(report, "kernel stops"), R"({"intruder":3,"overpass":2})");
  EXPECT_EQ(row(report, "needless stops"), R"(3 {"intruder":1,"overpass":2})");
  EXPECT_EQ(report["needless_stops"], 3);
  run::RunResult none = half_an_hour();
  none.measures.own_motion_stops.clear();
  EXPECT_EQ(row(report_of(none), "needless stops"), "0 {}");
}

TEST(ShiftReport, TellsWhatTheOperatorDid) { EXPECT_EQ(row(report_of(half_an_hour()), "operator's presses"), "2; lifted the implements by hand: 1"); }

TEST(ShiftReport, TheClosestApproachHasAName) {
  EXPECT_EQ(row(report_of(half_an_hour()), "closest approach"), "1.35 m person_2");
  run::RunResult alone = half_an_hour();
  alone.truth["closest_approach_m"] = nullptr;
  alone.truth["closest_approach_what"] = "";  // as the plant has it when there was nobody
  EXPECT_THAT(row(report_of(alone), "closest approach"), HasSubstr("none"));
}

TEST(ShiftReport, SpillAndTheWorstLoadAreOfTheTrucksThatLeft) {
  const json report = report_of(half_an_hour());
  EXPECT_EQ(row(report, "spill"), "1.23 % of what was dug");
  EXPECT_EQ(row(report, "worst load"), "centre 0.11 m off, height standard deviation 0.21 m") << "not of the one that is being loaded";
}

TEST(ShiftReport, MemoryGrowsOrIsNotKnown) {
  const json report = report_of(half_an_hour());
  EXPECT_EQ(row(report, "memory"), "kernel and app grow by 12.3 KiB an hour; too short to judge: under an hour");
  EXPECT_EQ(report["memory_growth_kernel_kib_per_hour"], 5.0);
  EXPECT_EQ(report["memory_growth_app_kib_per_hour"], 7.34);
  run::RunResult brief = half_an_hour();
  brief.memory = {};
  EXPECT_EQ(row(report_of(brief), "memory"), "too short to judge whether kernel and app grow");
  EXPECT_TRUE(report_of(brief)["memory_growth_kib_per_hour"].is_null());
}

// A shift of two hours with a pass every ten minutes.
TEST(ShiftReport, MemoryThatGrowsTooFastIsAShortcomingOfAnHourOrMore) {
  run::RunResult r = half_an_hour();
  r.truth["simulated_seconds"] = 7200.0;
  r.app_events.clear();
  for (int i = 1; i <= 12; ++i) r.app_events.push_back({{"event", "pass"}, {"time_s", 600.0 * i}, {"seconds", 15.0}});
  r.memory = {500.0, 100.0, 400.0};
  EXPECT_EQ(row(shift_json(r, 2.0, {}), "memory"), "kernel and app grow by 500.0 KiB an hour (at most 500)");
  EXPECT_THAT(shortcomings(shift_json(r, 2.0, {})), IsEmpty());
  r.memory = {500.5, 100.0, 400.5};
  EXPECT_THAT(shortcomings(shift_json(r, 2.0, {})), ElementsAre("kernel and app grow by 500.5 KiB an hour"));
  EXPECT_THAT(shortcomings(shift_json(r, 2.0, {}, 501.0)), IsEmpty()) << "--memory-growth";
  EXPECT_THAT(shortcomings(shift_json(r, 2.0, {}, 20.0)), ElementsAre("kernel and app grow by 500.5 KiB an hour"));
  r.truth["simulated_seconds"] = 3500.0;
  EXPECT_THAT(shortcomings(shift_json(r, 3500.0 / 3600, {})), IsEmpty()) << "too short to judge";
  r.memory = {};
  r.truth["simulated_seconds"] = 7200.0;
  EXPECT_THAT(shortcomings(shift_json(r, 2.0, {})), IsEmpty());
}

TEST(ShiftReport, ContactsAreCountedAndAShortcoming) {
  run::RunResult r = half_an_hour();
  r.contacts = 2;
  r.app_events.push_back({{"event", "pass"}, {"time_s", 800.0}, {"seconds", 15.0}});
  std::sort(r.app_events.begin(), r.app_events.end(), [](const json& a, const json& b) { return a["time_s"] < b["time_s"]; });
  EXPECT_EQ(row(report_of(r), "contacts (oracle)"), "2");
  EXPECT_THAT(shortcomings(report_of(r)), ElementsAre("2 contact(s)"));
  r.contacts = 0;
  EXPECT_THAT(shortcomings(report_of(r)), IsEmpty());
  EXPECT_THAT(shortcomings(shift_json(r, 0.6, {})), ElementsAre("the shift ended early: time limit"));
}

// From 120 to 1500 s no pass: more than a quarter of an hour, and what the app said last of what it waits for.
TEST(ShiftReport, AShiftThatIsStuckSaysSinceWhenAndForWhat) {
  run::RunResult r = half_an_hour();
  r.app_events.push_back({{"event", "operator_needed"}, {"reason", "move back"}, {"advice", "tram it"}});
  EXPECT_EQ(row(report_of(r), "longest without pass"), "1380 s from 120 s: STUCK; move back: tram it");
  EXPECT_THAT(shortcomings(report_of(r)), ElementsAre("no pass for 1380 s"));
  r.app_events[2]["time_s"] = 1000.0;
  EXPECT_EQ(row(report_of(r), "longest without pass"), "880 s from 120 s");
  r.app_events[2]["time_s"] = 130.0;
  EXPECT_EQ(row(report_of(r), "longest without pass"), "1670 s from 130 s: STUCK; move back: tram it") << "to the shift's end, too";
}

TEST(ShiftReport, SoilIsWhatTheScenarioHasOfChanges) {
  const test::Scratch folder;
  const DrawnShift drawn = draw_shift(8.0, 3);
  const std::string file = folder.path("scenario.toml");
  std::ofstream(file) << scenario_text(drawn);
  const auto changes = plant::load_scenario(file, BERM_PLANT_PROFILES).world.soil_changes;
  const json soil = shift_json(half_an_hour(), 8.0, drawn)["soil"];
  ASSERT_GE(changes.size(), 3u);
  ASSERT_EQ(soil.size(), changes.size());
  const auto rise_over_run = [](const json& deg) { return std::tan(deg.get<double>() * std::acos(-1.0) / 180.0); };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    EXPECT_DOUBLE_EQ(soil[i]["at_s"].get<double>(), changes[i].at_s);
    EXPECT_NEAR(rise_over_run(soil[i]["repose_deg"]), changes[i].repose, 1e-9);
    EXPECT_NEAR(rise_over_run(soil[i]["bank_slope_deg"]), changes[i].bank_slope, 1e-9);
    EXPECT_DOUBLE_EQ(soil[i]["resistance"].get<double>(), changes[i].resistance);
    EXPECT_DOUBLE_EQ(soil[i]["stick_fraction"].get<double>(), changes[i].stick_fraction);
  }
  EXPECT_EQ(report_of(half_an_hour())["soil"], json::array()) << "drawn, and nothing came";
}

TEST(ShiftReport, TheSoilsRowHasTheChangesThatCame) {
  DrawnShift drawn;
  drawn.soil = {{900.0, 41.5, 59.0, 0.59, 0.055}, {1700.0, 36.2, 50.4, 0.5, 0.002}, {1900.0, 40.0, 55.0, 0.55, 0.04}};
  EXPECT_EQ(row(shift_json(half_an_hour(), 0.6, drawn), "soil"), "from 900 s repose 41.5 deg, 5.5 % sticks; from 1700 s repose 36.2 deg, 0.2 % sticks");
  EXPECT_EQ(row(report_of(half_an_hour()), "soil"), "did not change");
}

}  // namespace
}  // namespace berm::soak
