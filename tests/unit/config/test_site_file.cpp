// The site file: what the default says, and every kind of bad input.
#include <gtest/gtest.h>

#include "config/site_file.hpp"
#include "config/strict_table.hpp"
#include "edited_file.hpp"

namespace berm::config::test {
namespace {

// verifies: IF-CF-8
TEST(SiteFileTest, TheDefaultInSiUnits) {
  const SiteFile site = load_site_file(site_path());
  EXPECT_EQ(site.name, "bench");
  ASSERT_EQ(site.dig_zone.size(), 1u);
  EXPECT_DOUBLE_EQ(site.dig_zone[0].x_low, 3.9);
  EXPECT_DOUBLE_EQ(site.dig_zone[0].x_high, 10.5);
  EXPECT_DOUBLE_EQ(site.dig_zone[0].y_low, -4.2);
  EXPECT_DOUBLE_EQ(site.dig_zone[0].y_high, 4.2);
  EXPECT_DOUBLE_EQ(site.dig_zone[0].floor, -3.4);
  EXPECT_DOUBLE_EQ(site.dig_zone[0].ceiling, 1.1);
  EXPECT_DOUBLE_EQ(site.pass_over, 0.8);
  ASSERT_EQ(site.ground_zone.size(), 3u);
  EXPECT_DOUBLE_EQ(site.ground_zone[0].y_low, 5.5);
  EXPECT_DOUBLE_EQ(site.ground_zone[2].x_low, 8.8);
  EXPECT_DOUBLE_EQ(site.ground_zone[2].y_high, -4.5);
  EXPECT_DOUBLE_EQ(site.ground_zone[0].pass_over, -0.9);
  ASSERT_EQ(site.truck_zone.size(), 1u);
  EXPECT_DOUBLE_EQ(site.truck_zone[0].x_low, -3.3);
  EXPECT_DOUBLE_EQ(site.truck_zone[0].x_high, 4.5);
  EXPECT_DOUBLE_EQ(site.truck_zone[0].y_low, 4.8);
  EXPECT_DOUBLE_EQ(site.truck_zone[0].y_high, 10.5);
  EXPECT_DOUBLE_EQ(site.truck_zone[0].ceiling, 1.3);
  EXPECT_DOUBLE_EQ(site.truck.centre[1], 6.75);
  EXPECT_DOUBLE_EQ(site.truck.target_kg, 18000.0);
  EXPECT_DOUBLE_EQ(site.dig.swing[0], radians(12.0));
  EXPECT_DOUBLE_EQ(site.dig.radius[1], 5.6);
  EXPECT_DOUBLE_EQ(site.dig.floor, -2.65);
  EXPECT_DOUBLE_EQ(site.dig.bench_height, 3.0);
  EXPECT_TRUE(site.dig.goal.empty());
}

// verifies: IF-CF-8
TEST(SiteFileTest, AGoalIsRectanglesWithALevelThatMaySlope) {
  const Scratch scratch;
  const std::string parts = "bench_height = 3.0\n[[dig.goal]]\nx = [5.0, 7.0]\ny = [0.0, 2.0]\nlevel = -1.5\n[[dig.goal]]\nx = [7.0, 9.0]\ny = [-1.0, 2.0]\nlevel = -2.0\nslope = [-0.1, 0.2] #";
  const SiteFile site = load_site_file(scratch.write("site.toml", replaced(read_text(site_path()), "bench_height = 3.0", parts)));
  ASSERT_EQ(site.dig.goal.size(), 2u);
  EXPECT_DOUBLE_EQ(site.dig.goal[0].x_low, 5.0);
  EXPECT_DOUBLE_EQ(site.dig.goal[0].x_high, 7.0);
  EXPECT_DOUBLE_EQ(site.dig.goal[0].level, -1.5);
  EXPECT_EQ(site.dig.goal[0].slope, (std::array{0.0, 0.0}));
  EXPECT_DOUBLE_EQ(site.dig.goal[1].y_low, -1.0);
  EXPECT_DOUBLE_EQ(site.dig.goal[1].y_high, 2.0);
  EXPECT_EQ(site.dig.goal[1].slope, (std::array{-0.1, 0.2}));
}

// verifies: IF-CF-16
TEST(SiteFileTest, ThereNeedBeNoZoneOfTheOverpassRule) {
  const Scratch scratch;
  std::string text = read_text(site_path());
  const std::size_t from = text.find("[[ground_zone]]"), to = text.find("[[dig_zone]]");
  ASSERT_LT(from, to);
  const SiteFile site = load_site_file(scratch.write("site.toml", text.erase(from, to - from)));
  EXPECT_TRUE(site.ground_zone.empty());
  EXPECT_TRUE(site.truck_zone.empty());
}

// verifies: IF-CF-1, IF-CF-2, IF-CF-8
TEST(SiteFileTest, EachBadInputGivesOneLineWithFileFieldAndLimit) {
  const Scratch scratch;
  const std::string good = read_text(site_path());
  for (const BadEdit& edit : bad_site_edits()) {
    const std::string path = scratch.write("site.toml", replaced(good, edit.from, edit.to));
    try {
      load_site_file(path);
      ADD_FAILURE() << edit.name << ": taken";
    } catch (const ConfigError& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.find(path + ": " + edit.field), 0u) << edit.name << ": " << line;
      EXPECT_NE(line.find(edit.reason), std::string::npos) << edit.name << ": " << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << edit.name << ": " << line;
    }
  }
}

}  // namespace
}  // namespace berm::config::test
