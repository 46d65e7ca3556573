// Ground from a measured point cloud: the file, the surface over its points, where the machine stands in it, what is levelled, what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "plant/machine/strict_table.hpp"
#include "plant/process/measured_ground.hpp"
#include "plant/process/point_file.hpp"
#include "plant/process/scenario.hpp"
#include "plant/process/triangulated_surface.hpp"
#include "plant/world/terrain.hpp"
#include "scratch.hpp"

namespace berm::plant::testing {
namespace {

constexpr const char* kHeader = "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                                "WIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA ascii\n";

std::string pcd(const std::vector<MeasuredPoint>& points) {
  std::string text = fmt::format(fmt::runtime(kHeader), points.size());
  for (const MeasuredPoint& p : points) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  return text;
}

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string refusal_of_points(const std::string& text) {
  const test::Scratch scratch;
  const std::string path = scratch.write("points.pcd", text);
  try {
    read_point_file(path);
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what()).rfind(path + ": ", 0), 0u) << error.what();
    return std::string(error.what()).substr(path.size() + 2);
  }
  return "accepted";
}

TEST(PointFile, IsReadWholeOrRefusedByField) {
  const std::string good = pcd({{1, 2, 3}, {-4.5, 5, 6e-3}, {7, 8, 9}});
  const test::Scratch scratch;
  const auto points = read_point_file(scratch.write("good.pcd", good));
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[1], (MeasuredPoint{-4.5, 5, 0.006}));
  const std::string kind = ", the one kind of PCD that ground is read from";
  EXPECT_EQ(refusal_of_points(edited(good, "DATA ascii", "DATA binary")), "DATA: 'binary' is not 'ascii'" + kind);
  EXPECT_EQ(refusal_of_points(edited(good, "x y z", "x y z intensity")), "FIELDS: 'x y z intensity' is not 'x y z'" + kind);
  EXPECT_EQ(refusal_of_points(edited(good, "POINTS 3", "POINTS 4")), "POINTS: says 4, there are 3");
  EXPECT_EQ(refusal_of_points(good + "1 1 1\n"), "POINTS: says 3, there are at least 4");
  EXPECT_EQ(refusal_of_points(edited(good, "7 8 9", "7 8 nan")), "DATA: point 3 is no three numbers within 1000000 m");
  EXPECT_EQ(refusal_of_points(edited(good, "7 8 9", "7 8")), "DATA: point 3 is no three numbers within 1000000 m");
  EXPECT_EQ(refusal_of_points(edited(good, "7 8 9", "7 8 9 10")), "DATA: point 3 has more than three numbers");
  const std::string endless(3'000'000, '7');
  EXPECT_EQ(refusal_of_points(edited(good, "DATA ascii", "DATA " + endless)), "DATA: '" + endless.substr(0, 60) + "...' is not 'ascii'" + kind);
  EXPECT_EQ(refusal_of_points(edited(good, "POINTS 3", "POINTS " + endless)), "POINTS: '" + endless.substr(0, 60) + "...' is no number from 3 to 20000000");
  EXPECT_EQ(refusal_of_points(edited(good, "x y z", "x \x1b[2J z")), "FIELDS: 'x ?[2J z' is not 'x y z'" + kind);
  EXPECT_EQ(refusal_of_points("[package]\n"), "FIELDS: is missing: no PCD file");
  EXPECT_EQ(refusal_of_points(""), "FIELDS: is missing: no PCD file");
  EXPECT_THROW(read_point_file(scratch.path("none.pcd")), ConfigError);
  EXPECT_THROW(read_point_file(scratch.folder()), ConfigError) << "a folder";
}

// verifies the interpolation by hand: z = 1 + x / 2 - y / 4 on four corners and one point off that plane.
TEST(TriangulatedSurface, IsLinearBetweenThePointsAndNothingWhereNoneAre) {
  TriangulatedSurface plane({{0, 0, 1}, {4, 0, 3}, {0, 4, 0}, {4, 4, 2}}, 6.0);
  EXPECT_NEAR(plane.height(1.0, 1.0).value(), 1.25, 1e-12);
  EXPECT_NEAR(plane.height(3.5, 2.0).value(), 2.25, 1e-12);
  EXPECT_FALSE(plane.height(4.1, 2.0).has_value()) << "outside the hull";
  TriangulatedSurface tent({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {1, 1, 1}}, 6.0);
  EXPECT_NEAR(tent.height(1.0, 0.5).value(), 0.5, 1e-12);
  EXPECT_NEAR(tent.height(1.0, 1.0).value(), 1.0, 1e-12);
  TriangulatedSurface wide({{0, 0, 1}, {9, 0, 3}, {0, 9, 0}}, 6.0);
  EXPECT_FALSE(wide.height(1.0, 1.0).has_value()) << "a side of more than the gap";
}

// A survey whose heights are 10 + 0.1 x + 0.02 y, points half a metre apart.
std::vector<MeasuredPoint> slope_survey() {
  std::vector<MeasuredPoint> points;
  for (int i = -50; i <= 50; ++i)
    for (int j = -50; j <= 50; ++j) points.push_back({100 + 0.5 * i, 200 + 0.5 * j, 10 + 0.05 * i + 0.01 * j});
  return points;
}

std::string scenario_on(const std::string& points, const std::string& more = "") {
  std::ifstream in(std::string(BERM_SCENARIOS) + "/measured.toml");
  std::stringstream text;
  text << in.rdbuf();
  std::string scenario = text.str();
  const std::size_t begin = scenario.find("[terrain]"), end = scenario.find("[[dig_zone]]");
  return scenario.replace(begin, end - begin,
                          fmt::format("[terrain]\nx = [-10, 10]\ny = [-8, 8]\ncell = 0.5\nroughness = 0.0\n[terrain.measured]\nfile = \"{}\"\n"
                                      "origin = [100, 200]\nyaw_deg = 90\nlevel = 10\n{}\n",
                                      points, more));
}

Scenario loaded_from(const test::Scratch& scratch, const std::string& text) {
  return load_scenario(scratch.write("scenario.toml", text), BERM_PLANT_PROFILES);
}

TEST(MeasuredGround, StandsInTheSurveyByOriginYawAndLevel) {
  const test::Scratch scratch;
  const std::string file = scratch.write("slope.pcd", pcd(slope_survey()));
  const Scenario s = loaded_from(scratch, scenario_on(file));
  const Terrain terrain(s.world.terrain, s.world.soil, 1);
  // The base's x is the survey's y, its y the survey's -x: z = 0.02 x - 0.1 y.
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{{0, 0}, {3.25, -2.75}, {-9.25, 7.25}})
    EXPECT_NEAR(terrain.as_built(x, y), 0.02 * x - 0.1 * y, 1e-9);
  const HeightGrid& grid = terrain.grid();
  EXPECT_EQ(grid.count_x(), 40);
  EXPECT_EQ(grid.count_y(), 32);
  EXPECT_NEAR(grid.at(0, 31), 0.02 * -9.75 - 0.1 * 7.75, 1e-9);
  EXPECT_NEAR(terrain.as_built(500, 500), s.world.terrain.measured->beyond, 1e-12);
  EXPECT_LT(std::abs(s.world.terrain.measured->beyond), 1.0);
}

TEST(MeasuredGround, IsCutAndFilledToALevelWithBanksRoundIt) {
  const test::Scratch scratch;
  const std::string file = scratch.write("slope.pcd", pcd(slope_survey()));
  const Scenario s = loaded_from(scratch, scenario_on(file, "[[terrain.measured.levelled]]\nx = [-2, 2]\ny = [-3, 3]\nz = -0.5\nslope_deg = 45\n"));
  const Terrain terrain(s.world.terrain, s.world.soil, 1);
  EXPECT_NEAR(terrain.as_built(-1.75, 2.75), -0.5, 1e-9);
  EXPECT_NEAR(terrain.as_built(1.75, -2.75), -0.5, 1e-9);
  // Half a metre outside on the side that is cut (0.28 high there), a bank of 45 degrees; farther out as measured.
  EXPECT_NEAR(terrain.as_built(0.25, -3.25), -0.25, 1e-9);
  EXPECT_NEAR(terrain.as_built(0.25, -5.75), 0.02 * 0.25 + 0.575, 1e-9);
}

TEST(MeasuredGround, WhatIsWrongIsNamed) {
  const test::Scratch scratch;
  const std::string file = scratch.write("slope.pcd", pcd(slope_survey()));
  const auto refusal = [&](const std::string& text) -> std::string {
    try {
      loaded_from(scratch, text);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return "accepted";
  };
  const std::string good = scenario_on(file), where = scratch.path("scenario.toml: terrain.");
  EXPECT_EQ(refusal(good), "accepted");
  EXPECT_EQ(refusal(edited(good, "cell = 0.5", "cell = 0.5\ncrest_x = 6.0")), where + "crest_x: is not a known key") << "a bench beside it";
  EXPECT_EQ(refusal(scenario_on("/no/such.pcd")),
            where + "measured.file: there is no /no/such.pcd (BERM_REAL_DATA names the folder of recordings)");
  EXPECT_EQ(refusal(edited(good, "level = 10\n", "")), where + "measured.level: is missing");
  EXPECT_EQ(refusal(edited(good, "level = 10\n", "level = 90\n")).rfind(where + "measured.level: leaves ground at height -79.4 m", 0), 0u);
  EXPECT_EQ(refusal(edited(good, "origin = [100, 200]", "origin = [130, 200]")).rfind(where + "measured.file: nothing was measured within 4 m", 0), 0u);
  EXPECT_EQ(refusal(scenario_on(file, "[[terrain.measured.levelled]]\nx = [-2, 2]\ny = [-3, 3]\nz = 0\nslope_deg = 90\n")),
            where + "measured.levelled[0].slope_deg: 90 is outside 5 .. 80");
}

// The shipped scenario's ground against the points it was made of, where nothing was levelled.
TEST(MeasuredGround, OfTheShippedScenarioLiesOnThePoints) {
  const std::string path = recording_path("site_terrain/terrain_xyz.pcd");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: no " << path << " (BERM_REAL_DATA)";
  const std::string file = std::string(BERM_SCENARIOS) + "/measured.toml";
  const Scenario s = load_scenario(file, BERM_PLANT_PROFILES);
  const Terrain terrain(s.world.terrain, s.world.soil, 1);
  StrictTable measured = StrictTable::parse_file(file).table("terrain").table("measured");
  const auto origin = measured.array<2>("origin", -1e6, 1e6);
  ASSERT_EQ(measured.number("yaw_deg", -360, 360), 0.0) << "the test's transform is a shift";
  const double level = measured.number("level", -1e6, 1e6);
  StrictTable pad = measured.tables("levelled").at(0);
  const auto pad_x = pad.array<2>("x", -100, 100), pad_y = pad.array<2>("y", -100, 100);
  constexpr double bank = 1.5;  // beyond the pad, in which cut or fill may still be
  std::vector<double> apart;
  for (const MeasuredPoint& p : read_point_file(path)) {
    const double x = p[0] - origin[0], y = p[1] - origin[1];
    const bool near_pad = x > pad_x[0] - bank && x < pad_x[1] + bank && y > pad_y[0] - bank && y < pad_y[1] + bank;
    if (!terrain.grid().contains(x, y) || near_pad) continue;
    apart.push_back(std::abs(terrain.grid().surface(x, y) - (p[2] - level)));
  }
  ASSERT_GT(apart.size(), 4000u);
  std::sort(apart.begin(), apart.end());
  const double median = apart[apart.size() / 2], p95 = apart[apart.size() * 95 / 100];
  RecordProperty("points", static_cast<int>(apart.size()));
  std::cout << fmt::format("{} points: median {:.1f} mm, p95 {:.1f} mm, largest {:.0f} mm\n", apart.size(), 1000 * median, 1000 * p95, 1000 * apart.back());
  EXPECT_LT(median, 0.01);
  EXPECT_LT(p95, 0.08);
}

}  // namespace
}  // namespace berm::plant::testing
