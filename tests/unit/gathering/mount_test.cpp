#include "gathering/mount_option.hpp"

#include <gtest/gtest.h>

#include "points/point_cloud.hpp"

namespace berm::app {
namespace {

using Eigen::Vector3d;

TEST(MountOption, PlaceAndYaw) {
  const Eigen::Isometry3d mount = mount_of("1.5,-2,+3e0,90");
  EXPECT_LT((mount * Vector3d::Zero() - Vector3d(1.5, -2.0, 3.0)).norm(), 1e-12);
  EXPECT_LT((mount * Vector3d::UnitX() - Vector3d(1.5, -1.0, 3.0)).norm(), 1e-12);
  EXPECT_LT((mount.matrix() - mount_of("1.5,-2,3,90,0,0").matrix()).norm(), 1e-15);
}

// By hand, a turn at a time.
TEST(MountOption, PitchAndRoll) {
  const auto turned = [](const char* text, const Vector3d& v) { return Vector3d(mount_of(text).linear() * v); };
  EXPECT_LT((turned("0,0,0,0,0,90", Vector3d::UnitY()) - Vector3d::UnitZ()).norm(), 1e-12);   // a scan plane upright along x
  EXPECT_LT((turned("0,0,0,90,0,90", Vector3d::UnitX()) - Vector3d::UnitY()).norm(), 1e-12);  // and upright along y
  EXPECT_LT((turned("0,0,0,90,0,90", Vector3d::UnitY()) - Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((turned("0,0,0,0,90,0", Vector3d::UnitX()) + Vector3d::UnitZ()).norm(), 1e-12);  // looking down
  EXPECT_LT((turned("0,0,0,90,90,90", Vector3d::UnitY()) - Vector3d::UnitY()).norm(), 1e-12);  // roll: z; pitch: x; yaw: y
  const Eigen::Matrix3d all = (Eigen::AngleAxisd(0.3, Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.2, Vector3d::UnitY()) *
                               Eigen::AngleAxisd(0.1, Vector3d::UnitX())).toRotationMatrix();
  EXPECT_LT((mount_of("0,0,0,17.188733853924695,-11.459155902616466,5.729577951308233").linear() - all).norm(), 1e-12);
}

TEST(MountOption, RefusesWithFieldAndLimit) {
  const auto why = [](const std::string& text) -> std::string {
    try {
      mount_of(text);
    } catch (const PointFileError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_NE(why("1,2").find("has 2 numbers, not 4 or 6"), std::string::npos) << why("1,2");
  EXPECT_NE(why("1,2,3,4,5").find("has 5 numbers, not 4 or 6"), std::string::npos);
  EXPECT_NE(why("1,2,3,4,5,6,7").find("more than six"), std::string::npos);
  EXPECT_NE(why("1,2,3,nan").find("yaw is beyond its limit"), std::string::npos);
  EXPECT_NE(why("1,2,3,4,400,0").find("pitch is beyond its limit"), std::string::npos);
  EXPECT_EQ(why("1,2,3,4,0,-361"),
            "--mount: 1,2,3,4,0,-361: roll is beyond its limit (x,y,z,yaw[,pitch,roll]: metres within 100000, degrees within 360)");
  EXPECT_NE(why("1,200000,3,4").find("y is beyond"), std::string::npos);
  for (const char* none : {"", ",", "1,2,3,", "1,2,x,4", "1, 2,3,4", "1,2,3,4 ", "0x1,2,3,4", "+-1,2,3,4"})
    EXPECT_NE(why(none).find("is no number"), std::string::npos) << none;
  EXPECT_LT(why(std::string(100000, '9')).size(), 300U);
}

}  // namespace
}  // namespace berm::app
