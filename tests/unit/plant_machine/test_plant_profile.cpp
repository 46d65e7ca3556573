#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "machine_file.hpp"

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
  const std::string file = ::testing::TempDir() + "plant_profile_test.toml";
  std::ofstream(file) << text;
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

// So that what is true of the one is true of the other.
TEST(PlantProfile, TheMachineWithLidarsIsTheSameButForThem) {
  const auto body = [](const std::string& text) { return text.substr(text.find("[kinematics]"), text.find("\n[[lidar]]") - text.find("[kinematics]")); };
  const std::string rear = text_of(replaced(BERM_PLANT_PROFILE, "zx200_plant", "zx200_rear_plant"));
  EXPECT_EQ(body(rear), body(shipped()));
  EXPECT_EQ(refusal(rear), "accepted");
  EXPECT_NE(rear.find("\n[[lidar]]"), std::string::npos);
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
  EXPECT_EQ(refusal(good + "\n[[lidar]]\nposition = [0.0, 0.0, 3.0]\nroll_deg = 0.0\npitch_deg = 200.0\nyaw_deg = 0.0\n"), "lidar[0].pitch_deg: 200 is outside -180 .. 180");
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
