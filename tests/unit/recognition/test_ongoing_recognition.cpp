// While the sweep goes on: when it asks, when an answer stands, and that it is the answer to the scanlines so far.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawn_bed.hpp"
#include "recognition/ongoing_recognition.hpp"

namespace berm::app {
namespace {

struct Watched {
  std::uint32_t stood = 0;  // scanline with which the answer stood; 0: none before the end
  int asks = 0;
  RecognisedTruck truck;
};

Watched watch(const std::vector<ScanPoint>& points) {
  const TruckRangeSet ranges = read_truck_ranges(BERM_TRUCK_RANGES);
  OngoingRecognition recognition(drawn_viewpoint, ranges);
  Watched out;
  visit_scanlines(points, [&](std::span<const ScanPoint> scanline) {
    if (out.stood > 0 || !recognition.take(scanline)) return;
    ++out.asks;
    recognition.ask();
    if (recognition.stands()) out.stood = scanline.front().scanline;
  });
  out.truck = recognition.ask();
  return out;
}

// Turned back to front: the last scanline comes first.
std::vector<ScanPoint> backwards(std::vector<ScanPoint> points) {
  std::stable_sort(points.begin(), points.end(), [](const ScanPoint& a, const ScanPoint& b) { return a.scanline > b.scanline; });
  for (ScanPoint& p : points) p.scanline = 89 - p.scanline, p.time_s = 3.0 - p.time_s;
  return points;
}

TEST(OngoingRecognition, AnAnswerStandsBeforeTheSweepsEndWhicheverEndComesFirst) {
  const DrawnBed bed;
  for (const bool back : {false, true}) {
    const std::vector<ScanPoint> points = back ? backwards(sweep_of(bed)) : sweep_of(bed);
    const Watched seen = watch(points);
    ASSERT_TRUE(seen.truck.found) << seen.truck.reason;
    EXPECT_GT(seen.stood, 0u) << back;
    EXPECT_LT(seen.stood, 89u) << back;
    EXPECT_NEAR(seen.truck.length, bed.length, 0.08) << back;
    EXPECT_NEAR(std::remainder(seen.truck.yaw - bed.yaw, 2 * std::numbers::pi), 0.0, 0.01) << "towards the cab";
    EXPECT_LT(seen.asks, 45) << "not every scanline is worth a search";
  }
}

// Half a bed may look like one: the answer must not stand before the end that comes last was seen.
TEST(OngoingRecognition, NothingStandsWhileTheLastEndIsAhead) {
  DrawnBed bed;
  bed.yaw = 0.0;
  bed.y = 8.0;
  for (const bool back : {false, true}) {
    const std::vector<ScanPoint> points = back ? backwards(sweep_of(bed)) : sweep_of(bed);
    const double end = bed.x + (back ? 0.5 : -0.5) * bed.length;  // of the bed, that is seen last
    const double nearest = std::atan2(bed.y - bed.width / 2 - drawn_viewpoint[1], end - drawn_viewpoint[0]) * 180.0 / std::numbers::pi;
    const double scanline = back ? 134.0 - nearest : nearest - 45.0;
    const Watched seen = watch(points);
    ASSERT_TRUE(seen.truck.found) << seen.truck.reason;
    ASSERT_GT(seen.stood, 0u) << back;
    EXPECT_GT(seen.stood + 12.0, scanline) << back << ": its inside shows the end some scanlines before the near wall's";
    EXPECT_NEAR(seen.truck.length, bed.length, 0.1);
  }
}

// The scanline that is the last to meet what stands across the bed, at x along it from its middle.
double last_scanline_over(const DrawnBed& bed, double x) {
  double last = 0.0;
  for (const double y : {-0.5 * bed.width - bed.thickness, 0.5 * bed.width + bed.thickness}) {
    const double c = std::cos(bed.yaw), s = std::sin(bed.yaw);
    last = std::max(last, std::atan2(bed.y + s * x + c * y - drawn_viewpoint[1], bed.x + c * x - s * y - drawn_viewpoint[0]) * 180.0 / std::numbers::pi - 45.0);
  }
  return std::floor(last);
}

// The rear end, which has no cab beyond, comes last: with the scanlines just after it both ends are known, and of an open one not before.
TEST(OngoingRecognition, TheAnswerStandsWithTheSecondScanlineBehindTheBed) {
  DrawnBed bed;
  for (const bool rear_wall : {true, false})
    for (int k = 0; k < 8; ++k) {
      bed.yaw = 0.04 * k;
      bed.rear_wall = rear_wall;
      const double last = last_scanline_over(bed, -0.5 * bed.length - (rear_wall ? bed.thickness : 0.0));
      const Watched seen = watch(sweep_of(bed));
      ASSERT_TRUE(seen.truck.found) << seen.truck.reason;
      EXPECT_GT(seen.stood, 0u);
      EXPECT_LE(seen.stood, last + 2.0) << "yaw " << bed.yaw;
      if (!rear_wall) {
        EXPECT_GE(seen.stood, last) << "yaw " << bed.yaw;
      }
    }
}

// The other way round its cab comes last: half seen it is no cab yet that tells where the bed ends.
TEST(OngoingRecognition, NothingStandsBeforeHalfOfTheCabIsSeen) {
  DrawnBed bed;
  for (int k = 0; k < 8; ++k) {
    bed.yaw = 0.04 * k;
    const double half = 89.0 - last_scanline_over(bed, 0.5 * bed.length + bed.thickness + 0.3 + 0.9);
    const Watched seen = watch(backwards(sweep_of(bed)));
    ASSERT_TRUE(seen.truck.found) << seen.truck.reason;
    EXPECT_GE(seen.stood, half) << "yaw " << bed.yaw;
    EXPECT_LT(seen.stood, 89u) << "yaw " << bed.yaw;
  }
}

// So little of it comes back that what is none may look like it until more is seen.
TEST(OngoingRecognition, WithLittleEvidenceNothingStandsBeforeTheSweepsEnd) {
  DrawnBed bed;
  bed.y = 12.0;
  EXPECT_GT(watch(sweep_of(bed)).stood, 0u);
  bed.y = 14.0;
  const Watched far = watch(sweep_of(bed));
  EXPECT_TRUE(far.truck.found) << far.truck.reason;
  EXPECT_EQ(far.stood, 0u);
}

// A whole sweep refuses a bed without a cab, for rays pass where it would stand; before the scanner has come there it may look like a truck's, and does not stand.
TEST(OngoingRecognition, BeforeTheCabsPlaceIsPassedNoneIsTakenForGranted) {
  DrawnBed bed;
  bed.cab = false;
  for (const double yaw : {0.0, 0.15, 0.3})
    for (const bool back : {false, true}) {
      bed.yaw = yaw;
      const std::vector<ScanPoint> points = back ? backwards(sweep_of(bed)) : sweep_of(bed);
      const Watched seen = watch(points);
      EXPECT_FALSE(seen.truck.found);
      EXPECT_EQ(seen.stood, 0u) << back << " " << yaw;
    }
}

TEST(OngoingRecognition, ARefusalNeverStands) {
  DrawnBed lid;
  lid.lid = true;
  const Watched seen = watch(sweep_of(lid));
  EXPECT_EQ(seen.stood, 0u);
  EXPECT_FALSE(seen.truck.found);
  EXPECT_GT(seen.asks, 0);
  DrawnBed container;
  container.cab = false;
  container.length = 9.0;
  EXPECT_EQ(watch(sweep_of(container)).stood, 0u);
}

TEST(OngoingRecognition, AskedAgainWithoutAScanlineItAnswersTheSame) {
  const TruckRangeSet ranges = read_truck_ranges(BERM_TRUCK_RANGES);
  OngoingRecognition recognition(drawn_viewpoint, ranges);
  EXPECT_FALSE(recognition.ask().found);
  EXPECT_FALSE(recognition.stands());
  visit_scanlines(sweep_of({}), [&](std::span<const ScanPoint> scanline) { recognition.take(scanline); });
  const RecognisedTruck once = recognition.ask(), twice = recognition.ask();
  ASSERT_TRUE(once.found);
  EXPECT_EQ(once.pose.middle, twice.pose.middle);
  EXPECT_EQ(once.milliseconds, twice.milliseconds) << "nothing was searched for again";
}

}  // namespace
}  // namespace berm::app
