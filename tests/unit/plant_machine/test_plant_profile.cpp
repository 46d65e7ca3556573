#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "machine_file.hpp"
#include "scratch.hpp"

namespace berm::plant::testing {
namespace {

std::string text_of(const std::string& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string shipped() { return text_of(BERM_PLANT_PROFILE); }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// The message that loading this text gives, without the file's name.
std::string refusal(const std::string& text) {
  const test::Scratch scratch;
  const std::string file = scratch.write("profile.toml", text);
  try {
    load_plant_profile(file);
  } catch (const ConfigError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind(file + ": ", 0), 0u) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what.substr(file.size() + 2);
  }
  return "accepted";
}

TEST(PlantProfile, ShippedProfileLoads) {
  const PlantProfile p = profile();
  EXPECT_EQ(p.name, "zx200");
  EXPECT_EQ(p.shape.parts.size(), 4u);
  EXPECT_EQ(p.shape.bucket_heaped_m3, 1.2);
  EXPECT_EQ(refusal(shipped()), "accepted");
}

// So that what is true of the one is true of the others.
TEST(PlantProfile, TheMachinesWithLidarsAreTheSameButForThem) {
  const auto body = [](const std::string& text) { return text.substr(text.find("[kinematics]"), text.find("\n[[lidar]]") - text.find("[kinematics]")); };
  for (const char* name : {"zx200_rear_plant", "zx200_ring_plant"}) {
    const std::string with = text_of(replaced(BERM_PLANT_PROFILE, "zx200_plant", name));
    EXPECT_EQ(body(with), body(shipped())) << name;
    EXPECT_EQ(refusal(with), "accepted") << name;
    EXPECT_NE(with.find("\n[[lidar]]"), std::string::npos) << name;
  }
}

// What the kernel is told of them is what is true.
TEST(PlantProfile, TheLidarsStandWhereTheKernelsMachineFileSays) {
  for (const char* name : {"zx200_rear", "zx200_ring"}) {
    const PlantProfile p = load_plant_profile(replaced(BERM_PLANT_PROFILE, "zx200_plant", std::string(name) + "_plant"));
    const toml::value file = toml::parse(replaced(BERM_MACHINE_FILE, "zx200.toml", std::string(name) + ".toml"));
    const auto& told = file.at("lidar").as_array();
    ASSERT_EQ(p.shape.lidar.size(), told.size()) << name;
    for (std::size_t i = 0; i < told.size(); ++i) {
      const LidarMount& mount = p.shape.lidar[i];
      for (std::size_t a = 0; a < 3; ++a) EXPECT_EQ(mount.position[a], as_number(told[i].at("position").at(a))) << name;
      EXPECT_EQ(mount.roll, radians(as_number(told[i].at("roll_deg")))) << name;
      EXPECT_EQ(mount.pitch, radians(as_number(told[i].at("pitch_deg")))) << name;
      EXPECT_EQ(mount.yaw, radians(as_number(told[i].at("yaw_deg")))) << name;
    }
  }
}

TEST(PlantProfile, EveryKindOfMistakeIsNamed) {
  const std::string good = shipped();
  EXPECT_EQ(refusal(replaced(good, "schema = 1", "schema = 2")), "schema: 2 is outside 1 .. 1");
  EXPECT_EQ(refusal(replaced(good, "[bucket]", "[bucket]\nteeth = 5")), "bucket.teeth: is not a known key");
  EXPECT_EQ(refusal(replaced(good, "boom = 5.648", "")), "kinematics.boom: is missing");
  EXPECT_EQ(refusal(replaced(good, "boom = 5.648", "boom = \"long\"")), "kinematics.boom: must be a number");
  EXPECT_EQ(refusal(replaced(good, "boom = 5.648", "boom = nan")), "kinematics.boom: nan is outside 0.1 .. 20");
  EXPECT_EQ(refusal(replaced(good, "lag_s = 0.12", "lag_s = -1.0")), "joint.swing.lag_s: -1 is outside 0.005 .. 1");
  EXPECT_EQ(refusal(replaced(good, "link = \"boom\"", "link = \"cab\"")), "part[0].link: 'cab' is not one of boom, stick, bucket");
  EXPECT_EQ(refusal(replaced(good, "range_deg = [-180.0, 180.0]", "range_deg = [180.0, -180.0]")), "joint.swing.range_deg: low must be below high");
  EXPECT_EQ(refusal(replaced(good, "[-0.20, -0.25], [0.40, -0.25]", "[0.40, -0.25], [-0.20, -0.25]")),
            "part[0].outline: must be strictly convex and counter-clockwise (x towards z)");
  const std::string lidar =
      "\n[[lidar]]\nposition = [0.0, 0.0, 3.0]\nroll_deg = 0.0\npitch_deg = 0.0\nyaw_deg = 0.0\n"
      "sector_deg = 180.0\nreturns = \"dual\"\noutliers = true\n";
  EXPECT_EQ(refusal(good + lidar), "accepted");
  EXPECT_EQ(refusal(good + replaced(lidar, "pitch_deg = 0.0", "pitch_deg = 200.0")), "lidar[0].pitch_deg: 200 is outside -180 .. 180");
  EXPECT_EQ(refusal(good + replaced(lidar, "sector_deg = 180.0", "sector_deg = 181.0")), "lidar[0].sector_deg: 181 is outside 1 .. 180");
  EXPECT_EQ(refusal(good + replaced(lidar, "sector_deg = 180.0\n", "")), "lidar[0].sector_deg: is missing");
  EXPECT_EQ(refusal(good + replaced(lidar, "\"dual\"", "\"last\"")), "lidar[0].returns: 'last' is not one of strongest, dual");
  EXPECT_EQ(refusal(good + replaced(lidar, "outliers = true", "outliers = 1")), "lidar[0].outliers: must be true or false");
  EXPECT_EQ(refusal("schema = = 1"), "line 1: not valid TOML");
}

TEST(PlantProfile, FileThatCannotBeReadIsNamed) {
  try {
    load_plant_profile("/nonexistent/profile.toml");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "/nonexistent/profile.toml: cannot be read");
  }
}

}  // namespace
}  // namespace berm::plant::testing
