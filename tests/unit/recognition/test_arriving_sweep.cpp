// Scanlines one by one: the same fans, segments and regions as of the whole sweep, and what the newest scanline has passed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "drawn_bed.hpp"
#include "recognition/arriving_sweep.hpp"

namespace berm::app {
namespace {

void expect_same(const FanSweep& a, const FanSweep& b) {
  ASSERT_EQ(a.begin, b.begin);
  ASSERT_EQ(a.heads, b.heads);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.swing_rate, b.swing_rate);
  for (std::size_t k = 0; k < a.returns.size(); ++k) {
    ASSERT_EQ(a.returns[k].place, b.returns[k].place);
    ASSERT_EQ(a.returns[k].upright, b.returns[k].upright);
  }
  EXPECT_EQ(a.directions.x, b.directions.x);
  EXPECT_EQ(a.directions.y, b.directions.y);
  EXPECT_EQ(a.directions.slope, b.directions.slope);
}

// Nothing truly looks like that, but its fans lie half as close. What lies behind the sensor is left out.
std::vector<ScanPoint> at_half_the_angle(const std::vector<ScanPoint>& points) {
  std::vector<ScanPoint> out;
  for (ScanPoint p : points) {
    const double x = static_cast<double>(p.x) - drawn_viewpoint[0], y = static_cast<double>(p.y) - drawn_viewpoint[1];
    if (y < std::abs(x)) continue;
    const double level = std::hypot(x, y), half = std::atan2(y, x) / 2;
    p.x = static_cast<float>(drawn_viewpoint[0] + level * std::cos(half));
    p.y = static_cast<float>(drawn_viewpoint[1] + level * std::sin(half));
    out.push_back(p);
  }
  return out;
}

// Not at the end alone: a machine that stands, scanlines half a degree apart that are thinned, a machine that swings.
TEST(ArrivingSweep, IsWhatTheScanlinesSoFarAreAsAWhole) {
  for (const auto& [swing, dense] : {std::pair{0.0, false}, {0.0, true}, {0.2, false}}) {
    DrawnBed bed;
    bed.swing_rate = swing;
    std::vector<ScanPoint> points = sweep_of(bed);
    if (dense) points = at_half_the_angle(points);
    ArrivingSweep arriving(drawn_viewpoint);
    std::size_t told = 0, compared = 0;
    visit_scanlines(points, [&](std::span<const ScanPoint> scanline) {
      arriving.take(scanline);
      told += scanline.size();
      if (scanline.front().scanline % 10 != 9) return;
      const auto view = arriving.view();
      const FanSweep whole = make_fans(std::span(points).first(told), drawn_viewpoint);
      ASSERT_EQ(view.reason, whole.reason);
      if (!whole.reason.empty()) return;
      FanSweep thin = thinned(whole);
      const auto regions = upright_regions(thin, upright_segments(thin));
      expect_same(view.whole, whole);
      expect_same(view.thin, thin);
      ASSERT_EQ(view.regions.size(), regions.size());
      for (std::size_t i = 0; i < regions.size(); ++i) {
        EXPECT_EQ(view.regions[i].first, regions[i].first);
        EXPECT_EQ(view.regions[i].normal, regions[i].normal);
        EXPECT_EQ(view.regions[i].count, regions[i].count);
      }
      ++compared;
    });
    EXPECT_GE(compared, 3u) << swing << dense;
  }
}

// It stands, swings, and stands: no swing of one rate. Told of each scanline where the machine was, the heads are where they were.
TEST(ArrivingSweep, TakesAnySwingThatItIsTold) {
  DrawnBed bed;
  bed.swing_rate = -0.35, bed.swings_from = 0.8, bed.swings_until = 2.0;
  ArrivingSweep told(drawn_viewpoint), untold(drawn_viewpoint);
  std::vector<double> turns;
  visit_scanlines(sweep_of(bed), [&](std::span<const ScanPoint> scanline) {
    const double turned = bed.turned(0.5 * (scanline.front().time_s + scanline.back().time_s));
    told.take(scanline, turned);
    untold.take(scanline);
    turns.push_back(turned);
  });
  EXPECT_NE(untold.view().reason, "");
  const auto view = told.view();
  ASSERT_EQ(view.reason, "");
  ASSERT_EQ(view.whole.heads.size(), turns.size());
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const double c = std::cos(turns[i]), s = std::sin(turns[i]);
    EXPECT_NEAR(view.whole.heads[i].x(), c * drawn_viewpoint[0] - s * drawn_viewpoint[1], 1e-6);
    EXPECT_NEAR(view.whole.heads[i].y(), s * drawn_viewpoint[0] + c * drawn_viewpoint[1], 1e-6);
  }
  for (const FanSweep* sweep : {&view.whole, &view.thin})
    for (std::size_t fan = 0; fan < sweep->heads.size(); ++fan)
      for (std::size_t k = sweep->begin[fan]; k < sweep->begin[fan + 1]; ++k) {
        const Eigen::Vector3d d = sweep->returns[k].at() - sweep->heads[fan];
        if (std::hypot(d.x(), d.y()) > 0.1) {
          ASSERT_NEAR(sweep->directions.x[k], d.x() / std::hypot(d.x(), d.y()), 1e-4);
        }
      }
}

TEST(ArrivingSweep, TellsWhatTheNewestFanHasPassedInEitherSense) {
  for (const bool back : {false, true}) {
    std::vector<ScanPoint> points = sweep_of({});
    if (back) {  // measured from the last scanline to the first
      std::stable_sort(points.begin(), points.end(), [](const ScanPoint& a, const ScanPoint& b) { return a.scanline > b.scanline; });
      for (ScanPoint& p : points) p.scanline = 89 - p.scanline, p.time_s = 3.0 - p.time_s;
    }
    ArrivingSweep sweep(drawn_viewpoint);
    const auto at = [](double degrees) {
      const double bearing = degrees * std::numbers::pi / 180.0;
      return Eigen::Vector2d(drawn_viewpoint[0] + 6.0 * std::cos(bearing), drawn_viewpoint[1] + 6.0 * std::sin(bearing));
    };
    EXPECT_FALSE(sweep.passed(at(90.0))) << "nothing was seen";
    int told = 0;
    visit_scanlines(points, [&](std::span<const ScanPoint> scanline) {
      sweep.take(scanline);
      if (++told < 3) return;
      const double bearing = back ? 134.0 - (told - 1) : 45.0 + (told - 1);  // of the newest fan
      const double ahead = back ? -1.0 : 1.0;
      if (bearing < 60.0 || bearing > 120.0) return;
      EXPECT_TRUE(sweep.passed(at(bearing - 0.5 * ahead))) << bearing;
      EXPECT_FALSE(sweep.passed(at(bearing + 0.5 * ahead))) << bearing;
    });
  }
}

TEST(ArrivingSweep, TakesEmptyScanlinesAndThoseThatAreNoFans) {
  ArrivingSweep sweep(drawn_viewpoint);
  sweep.take({});
  const ScanPoint lone{1.0F, 5.0F, 0.0F, 0, 0.0};
  sweep.take({&lone, 1});
  EXPECT_EQ(sweep.fans(), 0u);
  EXPECT_FALSE(sweep.wall_pauses(0.0));
  EXPECT_NE(sweep.view().reason, "");
}

}  // namespace
}  // namespace berm::app
