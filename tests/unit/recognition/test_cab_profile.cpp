#include "recognition/cab_profile.hpp"

#include <gtest/gtest.h>

namespace berm::app {
namespace {

using Eigen::Vector3d;

constexpr double kHalfInner = 1.2, kHalfOuter = 1.3, kEnd = 2.5;
const Vector3d sensor(3.0, -8.0, 2.0);

// 40 upright returns along the bed beyond its end, at one place across it; the evidence of all, and of what is shared with a longer bed.
std::array<double, 2> evidence_of(double y) {
  CabProfile profile(kHalfInner, kHalfOuter);
  for (int k = 0; k < 40; ++k) profile.take(sensor, Vector3d(kEnd + 0.4 + 0.02 * k, y, -0.4) - sensor, true);
  profile.finish();
  return {profile.beyond(kEnd, 1, 1.0, CabProfile::Returns::all), profile.beyond(kEnd, 1, 1.0)};
}

TEST(CabProfile, SharesWithALongerBedWhatItsSidesWouldExplain) {
  for (const double y : {-kHalfOuter, kHalfInner}) {  // the near side's outer face, the far one's inner face
    EXPECT_GT(evidence_of(y)[0], 8.0) << y;
    EXPECT_NEAR(evidence_of(y)[1], 0.5 * evidence_of(y)[0], 1e-6) << y;
  }
  for (const double y : {-1.05, 0.0, 0.9}) {
    EXPECT_GT(evidence_of(y)[1], 8.0) << y;
    EXPECT_EQ(evidence_of(y)[0], evidence_of(y)[1]) << y;
  }
}

TEST(CabProfile, RaysThatPassWhereItWouldStandAreAgainstIt) {
  CabProfile profile(kHalfInner, kHalfOuter);
  for (int k = 0; k < 40; ++k) profile.take(Vector3d(kEnd + 0.9, -8.0, -1.0), Vector3d(0.0, 14.0, 0.0), false);
  profile.finish();
  EXPECT_LT(profile.beyond(kEnd, 1, 1.0), -20.0);
}

}  // namespace
}  // namespace berm::app
