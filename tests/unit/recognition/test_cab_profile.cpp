#include "recognition/cab_profile.hpp"

#include <gtest/gtest.h>

namespace berm::app {
namespace {

using Eigen::Vector3f;

constexpr double kHalfInner = 1.2, kHalfOuter = 1.3, kEnd = 2.5;
const Vector3f sensor(3.0F, -8.0F, 2.0F);

// 40 upright returns along the bed beyond its end, at one place across it; the evidence of all, and of what is shared with a longer bed.
std::array<double, 2> evidence_of(double y) {
  CabProfile profile(kHalfInner, kHalfOuter);
  std::vector<Ray> rays;
  for (int k = 0; k < 40; ++k) rays.push_back({sensor, Vector3f(static_cast<float>(kEnd) + 0.4F + 0.02F * static_cast<float>(k), static_cast<float>(y), -0.4F), true});
  profile.take({}, PackedRays(rays));
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
  const Ray passing{Vector3f(static_cast<float>(kEnd) + 0.9F, -8.0F, -1.0F), Vector3f(static_cast<float>(kEnd) + 0.9F, 6.0F, -1.0F), false};
  profile.take({}, PackedRays(std::vector<Ray>(40, passing)));
  profile.finish();
  EXPECT_LT(profile.beyond(kEnd, 1, 1.0), -20.0);
}

// From before a truck most of what comes back of its cab is its front, 1.9 m before the bed.
TEST(CabProfile, ACabIsSeenToItsFront) {
  CabProfile profile(kHalfInner, kHalfOuter);
  const Vector3f before(12.0F, 1.0F, 2.0F);
  std::vector<Ray> rays;
  for (int k = 0; k < 40; ++k) rays.push_back({before, Vector3f(static_cast<float>(kEnd) + 1.9F, -1.0F + 0.05F * static_cast<float>(k), -0.6F), true});
  profile.take({}, PackedRays(rays));
  profile.finish();
  EXPECT_NEAR(profile.beyond(kEnd, 1, 1.0), 0.0, 1e-6);
  EXPECT_GT(profile.to_front(kEnd, 1, 1.0), 8.0);
  EXPECT_NEAR(profile.to_front(-kEnd, -1, 1.0), 0.0, 1e-6);
}

TEST(CabProfile, MoreThanEnoughOfACabAddsNothing) {
  EXPECT_EQ(with_cab(200.0, kCabEnough), with_cab(200.0, 3.0 * kCabEnough));
  EXPECT_EQ(with_cab(200.0, 0.5 * kCabEnough), 200.0 + 0.5 * kCabEnough);
  EXPECT_EQ(with_cab(10.0, kCabEnough), 20.0) << "nor more than the bed";
}

}  // namespace
}  // namespace berm::app
