// The picture of a run shows the whole way of a short one, and of hours what a reader can follow and a viewer can draw.
#include "run/site_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "run/parameter_file.hpp"
#include "run/scenario_names.hpp"
#include "scratch.hpp"

namespace berm::run::test {
namespace {

constexpr double kRow_s = 0.1;  // of the recorder
constexpr double kHour_s = 3600.0;

// A machine that swings to and fro, a pass in 20 s, until it stands.
SitePictureInput run_of(double seconds, double stands_from_s) {
  SitePictureInput in;
  in.title = "a test";
  in.map.cell_m = 0.3;
  in.map.origin_m = -15.6;
  for (int i = 0; i < BERM_MAP_CELLS * BERM_MAP_CELLS; ++i) {
    in.map.height_mm.push_back(i * 7919 % 3000);  // no two neighbours alike: the largest map there can be
    in.map.status.push_back(BERM_CELL_OBSERVED);
  }
  in.arm = {0.2277, 1.957, 5.648, 2.889, 1.562};
  for (int row = 0; row * kRow_s < seconds; ++row) {
    const double t = std::min(row * kRow_s, stands_from_s), pass = std::sin(t * 2 * 3.14159 / 20.0);
    in.path.push_back({row * kRow_s, {0.8 + 0.8 * pass, 0.6 + 0.2 * pass, -1.6 + 0.3 * std::cos(t), -0.9 + 0.1 * std::sin(3.7 * t)}, BERM_STATE_RUN});
  }
  return in;
}

// Trucks and people who stand for most of the time and each move for a minute in ten.
void add_movers(SitePictureInput& in, int count, double seconds) {
  for (int mover = 0; mover < count; ++mover) {
    MoverPath path{"mover " + std::to_string(mover), {}};
    for (int second = 0; second < seconds; ++second) {
      const double way = 60 * (second / 600) + std::min(second % 600, 60);
      path.points.emplace_back(5 + 4 * std::sin(0.2 * way + mover), 7 + 3 * std::cos(0.17 * way));
    }
    in.movers.push_back(path);
  }
}

std::string written(const SitePictureInput& in) {
  const berm::test::Scratch scratch;
  write_site_picture(scratch.path("site.svg"), in);
  std::ifstream file(scratch.path("site.svg"), std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// Points of the lines in this colour, panel after panel.
std::vector<std::size_t> points_of(const std::string& svg, const std::string& colour) {
  std::vector<std::size_t> counts;
  std::istringstream lines(svg);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("<polyline") && line.find("stroke:" + colour) != std::string::npos) counts.push_back(static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')));
  return counts;
}

const std::string tip = "#7c3aed", mover = "#dc2626";

// Of the tip's way, from above and from the side.
std::vector<std::size_t> points_of_tip(const std::string& svg) {
  const auto points = points_of(svg, tip);
  EXPECT_EQ(points.size(), 2U);
  return points;
}

TEST(SitePicture, OfEightHoursAndOfADayAViewerDrawsIt) {
  for (const double hours : {8.0, 24.0}) {
    SitePictureInput in = run_of(hours * kHour_s, hours * kHour_s);
    add_movers(in, 27, hours * kHour_s);
    for (int i = 0; i < 1000 * static_cast<int>(hours); ++i) in.stops.push_back({i * 1.0, "ground", true, 0.3 * (i % 20), 0.3 * (i % 30), 0.0});
    const std::string svg = written(in);
    EXPECT_LT(svg.size(), 2'000'000U) << hours;
    std::printf("%.0f h: %zu bytes\n", hours, svg.size());
    EXPECT_NE(svg.find(">path of the bucket's tip, last 10 min<"), std::string::npos) << hours;
    EXPECT_NE(svg.find(", latest way<"), std::string::npos) << hours;
    for (const std::size_t points : points_of_tip(svg)) EXPECT_GT(points, 5000U) << "next to nothing is left of it";
  }
}

TEST(SitePicture, AShortRunIsDrawnWhole) {
  SitePictureInput in = run_of(300.0, 300.0);
  const std::string svg = written(in);
  for (const std::size_t points : points_of_tip(svg)) EXPECT_NEAR(static_cast<double>(points), 3000.0, 50.0);
  EXPECT_NE(svg.find(">path of the bucket's tip<"), std::string::npos);
}

TEST(SitePicture, WhoStandsAddsNothingAndHidesNothing) {
  const SitePictureInput in = run_of(2 * kHour_s, 240.0);
  const std::string svg = written(in);
  for (const std::size_t points : points_of_tip(svg)) EXPECT_NEAR(static_cast<double>(points), 2400.0, 50.0);
  EXPECT_NE(svg.find(">path of the bucket's tip<"), std::string::npos) << "all that it did is there";
}

TEST(SitePicture, OfAWayThatIsCutTheMinutesAreSaid) {
  SitePictureInput in = run_of(2 * kHour_s, 1.5 * kHour_s);
  EXPECT_NE(written(in).find(">path of the bucket's tip, last 40 min<"), std::string::npos) << "half an hour it stood, and ten minutes";
}

TEST(SitePicture, EachMoversWayIsThereWhole) {
  SitePictureInput in = run_of(60.0, 60.0);
  add_movers(in, 4, 8 * kHour_s);
  const std::string svg = written(in);
  const auto points = points_of(svg, mover);
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(svg.find("latest way"), std::string::npos);
  for (const std::size_t of_one : points) EXPECT_NEAR(static_cast<double>(of_one), 8 * 6 * 60, 300.0);
}

TEST(SitePicture, ATruckIsNotDrawnAsSomebodyWhoMayNotBeThere) {
  SitePictureInput in = run_of(60.0, 60.0);
  add_movers(in, 2, 600.0);
  in.movers[0].name = "truck_1";
  const std::string svg = written(in);
  EXPECT_EQ(points_of(svg, mover).size(), 1U);
  EXPECT_EQ(points_of(svg, "#57534e").size(), 1U);
  EXPECT_NE(svg.find("fill:#57534e\">truck_1<"), std::string::npos);
}

// The side view cuts through the face that the site's digs are planned in, wherever that lies.
TEST(SitePicture, TheDigFacesProfileLiesInTheDigZone) {
  for (const char* site : {"bench", "measured"}) {
    SitePictureInput in;
    describe_site(find_machine("zx200"), find_site(site), in);
    const auto in_a_zone = [&](double bearing) {
      constexpr double face_m = 6.7;
      const double x = face_m * std::cos(bearing), y = face_m * std::sin(bearing);
      return std::any_of(in.dig_zones.begin(), in.dig_zones.end(), [&](const std::vector<Point2>& z) { return x > z[0].first && x < z[2].first && y > z[0].second && y < z[2].second; });
    };
    EXPECT_TRUE(in_a_zone(in.dig_bearing_rad)) << site << ": " << in.dig_bearing_rad;
    EXPECT_FALSE(in_a_zone(in.truck_bearing_rad)) << site;
  }
}

}  // namespace
}  // namespace berm::run::test
