// The file of truck classes: what stands in it, and what it refuses.
#include <gtest/gtest.h>

#include <string>

#include "config/strict_table.hpp"
#include "refused_edit.hpp"
#include "truck_scenes.hpp"

namespace berm::truck_world {
namespace {

std::string error_with(const std::string& from, const std::string& to) {
  return test::refused_edit<config::ConfigError>(BERM_TRUCK_CLASSES, from, to, [](const std::string& path) { read_truck_classes(path); });
}

void expect_refused(const std::string& from, const std::string& to, const std::string& field, const std::string& limit) {
  const std::string error = error_with(from, to);
  EXPECT_NE(error.find(field), std::string::npos) << from << " -> " << to << ": " << error;
  EXPECT_NE(error.find(limit), std::string::npos) << from << " -> " << to << ": " << error;
}

TEST(TruckWorldClasses, TheShippedFileHasThePapersTruckAndThreeMore) {
  const auto classes = shipped_classes();
  ASSERT_EQ(classes.size(), 4U);
  bool pipe = false, canopy = false, tracks = false;
  for (const TruckClass& c : classes) {
    EXPECT_GE(c.volume_m3[0], 12.0);
    EXPECT_LE(c.volume_m3[1], 23.0);
    pipe = pipe || c.bed == BedShape::half_round;
    canopy = canopy || c.canopy;
    tracks = tracks || c.tracks;
  }
  EXPECT_TRUE(pipe && canopy && tracks);
}

TEST(TruckWorldClasses, BadInputIsOneLineWithFileFieldAndLimit) {
  EXPECT_EQ(error_with("schema = 1", "schema = 1"), "");
  expect_refused("schema = 1", "schema = 2", "schema", "1 .. 1");
  expect_refused("inside_length = [4.4, 6.0]", "inside_length = [4.4, 60.0]", "class[0].inside_length", "3 .. 9");
  expect_refused("inside_length = [4.4, 6.0]", "inside_length = [6.0, 4.4]", "class[0].inside_length", "not below");
  expect_refused("inside_length = [4.4, 6.0]", "inside_length = [4.4]", "class[0].inside_length", "array of 2");
  expect_refused("inside_length = [4.4, 6.0]", "inside_length = \"long\"", "class[0].inside_length", "array of 2");
  expect_refused("inside_length = [4.4, 6.0]", "inside_length = [4.4, nan]", "class[0].inside_length", "outside");
  expect_refused("inside_length = [4.4, 6.0]\n", "", "class[0].inside_length", "missing");
  expect_refused("canopy = false", "canopy = 0", "class[0].canopy", "true or false");
  expect_refused("bed = \"half_round\"", "bed = \"round\"", "class[1].bed", "box, half_round");
  expect_refused("name = \"half_round\"", "name = \"box\"", "class[1].name", "twice");
  expect_refused("up = 0.5, down = 0.25", "up = 0.9, down = 0.25", "class[0].tailgate.up", "not 1");
  expect_refused("mud = [0.0, 0.04]", "mud = [0.0, 0.04]\nmut = 1", "class[0].mut", "not a known key");
  expect_refused("volume_m3 = [12.0, 23.0]", "volume_m3 = [35.0, 40.0]", "class[0].volume_m3", "no bed of these sizes");
  expect_refused("wall_height = [1.30, 1.80]", "wall_height = [1.00, 1.80]", "class[1].wall_height", "half the width");
  expect_refused("wall_top = [2.25, 3.20]", "wall_top = [3.80, 3.90]", "class[0].wall_top", "floor_height");
  expect_refused("[[class]]", "[[class", "line", "not valid TOML");
  EXPECT_THROW(read_truck_classes("/nowhere/classes.toml"), config::ConfigError);
}

TEST(TruckWorldClasses, OutsideMeansByTheMarginInEveryClass) {
  std::vector<TruckClass> classes(2);
  classes[0].inside_length = {4.0, 5.0};
  classes[1].inside_length = {4.0, 6.0};
  for (TruckClass& c : classes) c.inside_width = {2.3, 2.5}, c.wall_height = {1.0, 1.5};
  EXPECT_FALSE(outside_every_class(classes, {4.5, 2.4, 1.2}));
  EXPECT_FALSE(outside_every_class(classes, {5.5, 2.4, 1.2}));   // outside of the first alone
  EXPECT_FALSE(outside_every_class(classes, {6.29, 2.4, 1.2}));  // not by the margin
  EXPECT_TRUE(outside_every_class(classes, {6.31, 2.4, 1.2}));
  EXPECT_TRUE(outside_every_class(classes, {4.5, 1.99, 1.2}));
  EXPECT_TRUE(outside_every_class(classes, {4.5, 2.4, 1.81}));
}

}  // namespace
}  // namespace berm::truck_world
