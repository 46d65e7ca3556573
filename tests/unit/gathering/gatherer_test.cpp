#include "gathering/gatherer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <map>

namespace berm::app {
namespace {

constexpr double kUpright = 1.5707963267948966;

// A scanner 1 m above the axis of its pan, its plane upright.
KinematicChain upright() { return KinematicChain({{0, 1.0, 0, kUpright, DhLink::Joint::kRevolute, 0}}); }

std::vector<PolarReturn> arc(double range, double from = -0.3, double to = 0.3, double step = 0.01) {
  std::vector<PolarReturn> out;
  for (int i = 0; i < static_cast<int>(std::lround((to - from) / step)); ++i) out.push_back({from + i * step, range});
  return out;
}

void scan(PointCloudGatherer& gatherer, std::size_t scanner, double pan, const std::vector<PolarReturn>& returns) {
  const double encoder[] = {pan};
  gatherer.add_scan(scanner, encoder, returns, 0.0);
}

// zolynski-2012, 2.7: neighbours of one sweep are nearer than their error volumes and must not drag one another along.
TEST(Gatherer, NoMergingWithinAnEpoch) {
  PointCloudGatherer gatherer(GatheringOptions{});
  gatherer.add_scanner({0.02, 0.01, 0.01}, upright());
  for (int i = 0; i < 20; ++i) scan(gatherer, 0, 0.005 * i, arc(3.0));
  EXPECT_EQ(gatherer.counts().merged, 0U);
  EXPECT_EQ(gatherer.counts().deleted, 0U);
  EXPECT_EQ(gatherer.store().size(), 20U * 60U);
  EXPECT_EQ(gatherer.epoch(), 1U);
  for (int i = 18; i >= 0; --i) scan(gatherer, 0, 0.005 * i, arc(3.0));
  EXPECT_EQ(gatherer.epoch(), 2U);
  EXPECT_EQ(gatherer.counts().merged, 19U * 60U);
  EXPECT_EQ(gatherer.store().size(), 20U * 60U);
}

TEST(Gatherer, MergedPointHasTheHigherEpochAndASmallerVolume) {
  PointCloudGatherer gatherer(GatheringOptions{});
  const std::size_t a = gatherer.add_scanner({0.02, 0.004, 0.004}, upright()), b = gatherer.add_scanner({0.02, 0.004, 0.004}, upright());
  scan(gatherer, a, 0.0, {{0.0, 3.00}});
  const float before = gatherer.store()[0].covariance.xx;
  scan(gatherer, b, 0.0, {{0.0, 3.02}});  // another scanner, at once (Figure 4)
  ASSERT_EQ(gatherer.store().size(), 1U);
  EXPECT_EQ(gatherer.counts().merged, 1U);
  EXPECT_NEAR(gatherer.store()[0].x, 3.01, 1e-3);
  EXPECT_NEAR(gatherer.store()[0].covariance.xx, before / 2, 1e-5);
  EXPECT_EQ(gatherer.store().epoch(0), 2U);
  scan(gatherer, b, 0.0, {{0.0, 3.30}});  // standstill: an epoch of its own, and too far to merge
  EXPECT_EQ(gatherer.epoch(), 3U);
}

// A shift has two million scans: what is kept of them follows the points, and those that stay keep the time of the scan that met them last.
TEST(Gatherer, OfManyScansOnlyTheTimesThatPointsNeedAreKept) {
  PointCloudGatherer gatherer(GatheringOptions{});
  gatherer.add_scanner({0.02, 0.004, 0.004}, upright());
  const auto scan_at = [&gatherer](double pan, double time_s) {
    const double encoder[] = {pan};
    const PolarReturn hit[] = {{0.0, 3.0}};
    gatherer.add_scan(0, encoder, hit, time_s);
  };
  for (int i = 0; i < 50; ++i) scan_at(1.0 + 0.01 * i, i);  // seen once, covered ever after
  std::size_t most = 0;
  for (int i = 50; i < 60000; ++i) {
    scan_at(0.0, i);
    most = std::max(most, gatherer.bytes());
  }
  EXPECT_EQ(gatherer.counts().scans, 60000U);
  EXPECT_LT(most - gatherer.store().bytes(), 200'000U) << "the times of all of them take 480 kB and more";
  std::map<double, int> times;
  for (const ScanPoint& p : gatherer.points()) ++times[p.time_s];
  ASSERT_EQ(gatherer.store().size(), 51U);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(times[i], 1) << i;
  EXPECT_EQ(times[59999], 1);
}

// An ellipsoid is long across the beam and short along it: a sphere of either size gives another answer.
TEST(Gatherer, MergesByEllipsoidsNotSpheres) {
  for (const auto& [along, range, merges] :
       {std::tuple{0.012, 3.0, true}, std::tuple{0.0, 3.09, false}, std::tuple{0.0, 3.03, true}, std::tuple{0.06, 3.0, false}}) {
    PointCloudGatherer gatherer(GatheringOptions{});
    const std::size_t a = gatherer.add_scanner({0.01, 0.01, 0.01}, upright()), b = gatherer.add_scanner({0.01, 0.01, 0.01}, upright());
    scan(gatherer, a, 0.0, {{0.0, 3.0}});
    scan(gatherer, b, 0.0, {{along * 2.5, range}});
    EXPECT_EQ(gatherer.counts().merged, merges ? 1U : 0U) << along << " " << range;
  }
}

TEST(Gatherer, WhatWasSeenThroughIsDeletedWhatIsBehindStays) {
  PointCloudGatherer gatherer(GatheringOptions{});
  gatherer.add_scanner({}, upright());
  for (int i = 0; i < 40; ++i) scan(gatherer, 0, 0.01 * i, arc(2.0));
  const std::size_t near = gatherer.store().size();
  for (int i = 39; i >= 0; --i) scan(gatherer, 0, 0.01 * i, arc(5.0));
  EXPECT_EQ(gatherer.counts().deleted, near);
  for (const ScanPoint& p : gatherer.points()) EXPECT_NEAR(std::hypot(p.x, p.y, p.z - 1.0F), 5.0, 1e-3);
  const std::uint64_t deleted = gatherer.counts().deleted;
  for (int i = 0; i < 40; ++i) scan(gatherer, 0, 0.01 * i, arc(2.0));
  EXPECT_EQ(gatherer.counts().deleted, deleted);  // covered for a while
}

// A scanner that stands still looks along its plane: what walked through is gone with the next scan.
TEST(Gatherer, StandstillDeletesInItsPlane) {
  PointCloudGatherer gatherer(GatheringOptions{});
  gatherer.add_scanner({}, upright());
  scan(gatherer, 0, 0.2, arc(5.0));
  scan(gatherer, 0, 0.2, arc(2.0, -0.1, 0.1));
  EXPECT_EQ(gatherer.counts().deleted, 0U);
  scan(gatherer, 0, 0.2, arc(5.0));
  EXPECT_EQ(gatherer.counts().deleted, 0U);  // from the nearer of both scans only
  scan(gatherer, 0, 0.2, arc(5.0));
  EXPECT_EQ(gatherer.counts().deleted, 20U);
  EXPECT_EQ(gatherer.store().size(), 60U);
}

TEST(Gatherer, OverflowRemovesTheLowestEpochsFirst) {
  GatheringOptions options;
  options.capacity = 640;
  PointCloudGatherer gatherer(options);
  std::vector<std::size_t> scanners;
  for (int i = 0; i < 12; ++i) scanners.push_back(gatherer.add_scanner({}, upright()));
  for (int i = 0; i < 12; ++i) scan(gatherer, scanners[static_cast<std::size_t>(i)], 0.5 * i, arc(3.0));  // 60 points and an epoch each
  EXPECT_LE(gatherer.store().size(), 640U);
  EXPECT_EQ(gatherer.counts().overflowed + gatherer.store().size(), 720U);
  EXPECT_GE(gatherer.counts().overflowed, 80U);
  EXPECT_LE(gatherer.counts().overflowed, 80U + 640U / 64U);
  std::map<std::uint32_t, int> per_epoch;
  for (std::uint32_t i = 0; i < gatherer.store().places(); ++i)
    if (gatherer.store().used(i)) ++per_epoch[gatherer.store().epoch(i)];
  EXPECT_EQ(per_epoch.count(1), 0U);  // all of the first, part of the second, nothing of the others
  EXPECT_GT(per_epoch[2], 0);
  EXPECT_LT(per_epoch[2], 60);
  for (std::uint32_t epoch = 3; epoch <= 12; ++epoch) EXPECT_EQ(per_epoch[epoch], 60) << epoch;
}

TEST(Gatherer, RefusesWhatIsNoMeasurement) {
  PointCloudGatherer gatherer(GatheringOptions{});
  gatherer.add_scanner({}, upright());
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  scan(gatherer, 0, 0.0, {{0.0, nan}, {nan, 2.0}, {0.1, -1.0}, {0.2, 0.0}, {0.3, inf}, {0.4, 1e9}, {0.5, 2.0}, {0.5, 2.0}, {0.45, 2.0}, {0.6, 2.0}});
  EXPECT_EQ(gatherer.counts().ignored, 8U);
  EXPECT_EQ(gatherer.store().size(), 2U);
  scan(gatherer, 0, 0.01, {});
  EXPECT_THROW(scan(gatherer, 1, 0.0, {}), std::out_of_range);
  EXPECT_THROW(gatherer.add_scan(0, std::span<const double>{}, {}, 0.0), std::out_of_range);
  EXPECT_THROW(PointCloudGatherer(GatheringOptions{.capacity = 0}), std::invalid_argument);
  gatherer.clear();
  EXPECT_EQ(gatherer.store().size(), 0U);
  EXPECT_TRUE(gatherer.points().empty());
}

// Whatever is scanned: every point that came in is kept, merged, deleted, overflowed or ignored, and each kept one is found where it lies.
TEST(Gatherer, EveryPointIsAccountedFor) {
  EXPECT_TRUE(rc::check("accounts", [] {
    GatheringOptions options;
    options.capacity = *rc::gen::inRange<std::size_t>(1, 400);
    PointCloudGatherer gatherer(options);
    gatherer.add_scanner({}, upright());
    gatherer.add_scanner({0.05, 0.02, 0.02}, upright());
    double pan = 0.0;
    for (int i = *rc::gen::inRange(1, 60); i > 0; --i) {
      pan += 0.001 * *rc::gen::inRange(-30, 31);
      scan(gatherer, *rc::gen::inRange<std::size_t>(0, 2), pan, arc(0.1 * *rc::gen::inRange(0, 60), -0.2, 0.2));
    }
    const GatheringCounts c = gatherer.counts();
    const CloudStore& store = gatherer.store();
    RC_ASSERT(store.size() + c.merged + c.deleted + c.overflowed + c.ignored == c.points_in);
    RC_ASSERT(store.size() <= options.capacity);
    RC_ASSERT(gatherer.points().size() == store.size());
    std::size_t occupied = 0;
    for (const CloudStore::Block& block : store.blocks()) {
      RC_ASSERT(block.occupied != 0U);
      RC_ASSERT(store.block(block.key[0], block.key[1], block.key[2]) == &block);
      for (const std::uint32_t first : block.first)
        for (std::uint32_t i = first; i != CloudStore::kNone; i = store[i].next) ++occupied;
    }
    RC_ASSERT(occupied == store.size());
    for (std::uint32_t i = 0; i < store.places(); ++i) {
      if (!store.used(i)) continue;
      const GatheredPoint& p = store[i];
      const Vector3 at{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
      // From as far off as its own deviation reaches, whatever else its block holds; widest: of all that is there.
      double widest = 0.0;
      for (std::uint32_t k = 0; k < store.places(); ++k)
        if (store.used(k)) widest = std::max(widest, largest_half_width(store[k].covariance, 1.0));
      const auto sd = [](float variance) { return std::sqrt(static_cast<double>(variance)); };
      const Vector3 rim{at[0] + 1.99 * sd(p.covariance.xx), at[1] - 1.99 * sd(p.covariance.yy), at[2] + 1.99 * sd(p.covariance.zz)};
      bool found = false, found_from_rim = false;
      store.for_each_near(at, {0, 0, 0}, 2.0, widest, [&](std::uint32_t index) { found = found || index == i; });
      store.for_each_near(rim, {0, 0, 0}, 2.0, widest, [&](std::uint32_t index) { found_from_rim = found_from_rim || index == i; });
      RC_ASSERT(found);
      RC_ASSERT(found_from_rim);
    }
  }));
}

}  // namespace
}  // namespace berm::app
