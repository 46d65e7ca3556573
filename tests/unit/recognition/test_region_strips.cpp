#include "recognition/region_strips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

using Eigen::Vector2d;

TruckRangeSet ranges() { return read_truck_ranges(BERM_TRUCK_RANGES); }

// An upright face in plan from first to last, seen against its normal; a segment every decimetre, up to high.
UprightRegion face(const Vector2d& first, const Vector2d& last, const Vector2d& normal, double high) {
  UprightRegion r;
  r.normal = normal, r.first = first, r.last = last, r.high = high, r.low = high - 1.0;
  const int segments = static_cast<int>(10.0 * (last - first).norm());
  for (int k = 0; k <= segments; ++k) r.segments.push_back({static_cast<std::size_t>(k), first + (last - first) * k / segments, r.low, high, 5});
  r.count = 5 * static_cast<int>(r.segments.size());
  return r;
}

// The near side's outer face, with tops at 1.6 m, and the far one's inner face, of which a part may be in sight.
std::vector<BedStrip> of_sides(double far_high) {
  return strips_of(face({-2.0, 6.0}, {2.0, 6.0}, {0.0, -1.0}, 1.6), face({-2.0, 8.5}, {2.0, 8.5}, {0.0, -1.0}, far_high), ranges());
}

TEST(RegionStrips, TwoSidesGiveHeightAndRoll) {
  const std::vector<BedStrip> strips = of_sides(1.7);
  ASSERT_EQ(strips.size(), 1u);
  EXPECT_NEAR(strips[0].middle.z(), 1.65, 0.05);
  EXPECT_NEAR(std::abs(strips[0].roll), std::atan(0.1 / 2.5), 1e-6);
}

TEST(RegionStrips, OfASideThatIsSeenInPartTheOtherTellsTheHeight) {
  const std::vector<BedStrip> strips = of_sides(0.9), whole = of_sides(1.6);
  ASSERT_EQ(strips.size(), 1u);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_NEAR(strips[0].middle.z(), whole[0].middle.z(), 1e-9);
  EXPECT_EQ(strips[0].roll, 0.0);
  EXPECT_EQ(strips[0].width, whole[0].width);
  EXPECT_GT(strips[0].slack, whole[0].slack) << "it knows less of the height";
}

TEST(RegionStrips, BehindWhatIsAsWideAsACabBeginStripsOfSeveralHeights) {
  const Vector2d normal(0.0, -1.0);
  const std::vector<BedStrip> strips = strips_behind(face({-1.1, 6.0}, {1.1, 6.0}, normal, 1.6), ranges());
  ASSERT_GE(strips.size(), 3u);
  double low = 1e9, high = -1e9;
  for (const BedStrip& s : strips) {
    EXPECT_TRUE(s.from_cab);
    EXPECT_LT((s.middle.head<2>() - Vector2d(0.0, 6.0)).norm(), 1e-6);
    EXPECT_NEAR(std::remainder(s.yaw - std::atan2(normal.y(), normal.x()), 6.28318530717958648), 0.0, 1e-9) << "the bed lies against its direction";
    low = std::min(low, s.middle.z()), high = std::max(high, s.middle.z());
  }
  EXPECT_LT(low, 1.45);
  EXPECT_GT(high, 1.75);
  EXPECT_TRUE(strips_behind(face({-2.5, 6.0}, {2.5, 6.0}, normal, 1.6), ranges()).empty()) << "a side";
  EXPECT_TRUE(strips_behind(face({-0.4, 6.0}, {0.4, 6.0}, normal, 1.6), ranges()).empty()) << "a person, a post";
}

// From behind an open end the front wall's inside is in sight, and rays graze the sides: a strip of the widest bed lets none of them through.
TEST(RegionStrips, OfAnEndsInnerFaceStripsAreAsWideAsTheWidestBed) {
  const Vector2d behind(0.0, -3.0);
  const auto within = [&](double extent) { return strips_within(face({-0.5 * extent, 6.0}, {0.5 * extent, 6.0}, {0.0, -1.0}, 1.6), ranges(), behind); };
  const std::vector<BedStrip> whole = within(2.4), part = within(1.5);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].width, ranges().hull(&TruckRanges::inside_width)[1]);
  EXPECT_NEAR(whole[0].middle.x(), 0.0, 1e-6);
  EXPECT_NEAR(whole[0].middle.y(), 6.0, 1e-6);
  EXPECT_NEAR(whole[0].middle.z(), 1.63, 1e-6);
  EXPECT_NEAR(std::abs(std::cos(whole[0].yaw)), 0.0, 1e-6) << "along the face's normal";
  ASSERT_EQ(part.size(), 3u) << "the middle of it, its left or its right part";
  EXPECT_NEAR(part[1].middle.x(), -part[2].middle.x(), 1e-6);
  EXPECT_NEAR(std::abs(part[1].middle.x()), 0.5 * (part[1].width - 1.5) - 0.1, 0.06);
  EXPECT_TRUE(within(0.9).empty());
  EXPECT_TRUE(within(2.7).empty());
}

TEST(RegionStrips, AnEndsInnerFaceIsSeenFromBehindNotAslant) {
  const auto from = [](double degrees) {
    const double angle = degrees * 3.14159265358979 / 180.0;
    return strips_within(face({-1.2, 6.0}, {1.2, 6.0}, {0.0, -1.0}, 1.6), ranges(), {9.0 * std::sin(angle), 6.0 - 9.0 * std::cos(angle)}).size();
  };
  EXPECT_EQ(from(24.0), 1u);
  EXPECT_EQ(from(-24.0), 1u);
  EXPECT_EQ(from(28.0), 0u);
}

// The left part of the end lies higher: so does the bed's left.
TEST(RegionStrips, AnEndsInnerFaceGivesTheRoll) {
  UprightRegion end = face({-1.2, 6.0}, {1.2, 6.0}, {0.0, -1.0}, 1.6);
  for (UprightSegment& s : end.segments) s.high += 0.03 * s.at.x();
  const std::vector<BedStrip> strips = strips_within(end, ranges(), {0.0, -3.0});
  ASSERT_EQ(strips.size(), 1u);
  BedPose pose;
  pose.yaw = strips[0].yaw, pose.roll = strips[0].roll;
  const Eigen::Vector3d v = pose.rotation().col(1);
  EXPECT_NEAR(v.z() / v.x(), 0.03, 1e-3);
}

}  // namespace
}  // namespace berm::app
