// Several scanners by turns within their sweeps: what zolynski-2012, 2.7 forbids, one return of a sweep merging with the next of the same, stays
// forbidden when another scanner has met the point in between.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <map>
#include <set>

#include "gathering/gatherer.hpp"

namespace berm::app {
namespace {

constexpr int kRows = 60, kReturns = 60;

KinematicChain upright_pan() { return KinematicChain({{0, 1.0, 0, 1.5707963267948966, DhLink::Joint::kRevolute, 0}}); }

std::vector<PolarReturn> row_of_wall() {
  std::vector<PolarReturn> out;
  for (int i = 0; i < kReturns; ++i) out.push_back({-0.3 + 0.01 * i, 3.0});
  return out;
}

void scan_row(PointCloudGatherer& gatherer, std::size_t scanner, double pan, const std::vector<PolarReturn>& returns = row_of_wall()) {
  const double encoder[] = {pan};
  gatherer.add_scan(scanner, encoder, returns, 0.0);
}

// every: for each scanner, after which of the first one's rows it scans as well.
std::size_t kept_of_one_sweep(const ScannerDeviations& deviations, const std::vector<int>& every) {
  PointCloudGatherer gatherer(GatheringOptions{});
  for (std::size_t s = 0; s < every.size(); ++s) gatherer.add_scanner(deviations, upright_pan());
  std::size_t others = 0;
  for (int row = 0; row < kRows; ++row)
    for (std::size_t s = 0; s < every.size(); ++s) {
      if (row % every[s] != 0) continue;
      scan_row(gatherer, s, 0.005 * row);
      others += s == 0 ? 0 : kReturns;
    }
  const GatheringCounts counts = gatherer.counts();
  EXPECT_EQ(gatherer.epoch(), every.size()) << "one sweep each";
  EXPECT_EQ(counts.deleted, 0U);
  EXPECT_GE(counts.merged, others / 2) << "across scanners they merge at once (Figure 4)";
  return gatherer.store().size();
}

// All scan the same places without noise: as many points as the first alone leaves, each with the returns of all that scanned it.
TEST(InterleavedScanners, ASweepKeepsItsPoints) {
  for (const double across : {0.01, 0.0044}) {
    const ScannerDeviations deviations{0.012, 0.0022, across};
    const std::size_t alone = kept_of_one_sweep(deviations, {1});
    ASSERT_EQ(alone, static_cast<std::size_t>(kRows * kReturns));
    for (const int every : {1, 2, 5, 10}) EXPECT_EQ(kept_of_one_sweep(deviations, {1, every}), alone) << "1:" << every << ", across " << across;
    EXPECT_EQ(kept_of_one_sweep(deviations, {1, 1, 1}), alone) << "three, across " << across;
    EXPECT_EQ(kept_of_one_sweep(deviations, {1, 2, 5}), alone) << "three, across " << across;
    EXPECT_EQ(kept_of_one_sweep(deviations, std::vector<int>(20, 1)), alone) << "twenty, across " << across;
  }
}

// Nothing is dragged along: where the points lie is where they were measured.
TEST(InterleavedScanners, PointsStayWhereTheyWereMeasured) {
  PointCloudGatherer gatherer(GatheringOptions{});
  for (int s = 0; s < 2; ++s) gatherer.add_scanner({0.012, 0.0022, 0.01}, upright_pan());
  for (int row = 0; row < kRows; ++row)
    for (std::size_t s = 0; s < 2; ++s) scan_row(gatherer, s, 0.005 * row);
  std::map<int, int> per_row;
  for (const ScanPoint& p : gatherer.points()) {
    const double row = std::atan2(static_cast<double>(p.y), static_cast<double>(p.x)) / 0.005;
    EXPECT_NEAR(row, std::round(row), 0.01);
    ++per_row[static_cast<int>(std::lround(row))];
  }
  ASSERT_EQ(per_row.size(), static_cast<std::size_t>(kRows));
  for (const auto& [row, count] : per_row) EXPECT_EQ(count, kReturns) << row;
}

// The next sweep merges with all of the one before, and a merged point has the epoch that began last, whoever met it last.
TEST(InterleavedScanners, TheNextEpochMerges) {
  PointCloudGatherer gatherer(GatheringOptions{});
  for (int s = 0; s < 2; ++s) gatherer.add_scanner({}, upright_pan());
  const auto all_have_epoch = [&gatherer](std::uint32_t epoch) {
    for (std::uint32_t i = 0; i < gatherer.store().places(); ++i) EXPECT_EQ(gatherer.store().epoch(i), epoch);
    EXPECT_EQ(gatherer.store().size(), 10U * kReturns);
  };
  for (int row = 0; row < 10; ++row)
    for (const std::size_t s : {1U, 0U}) scan_row(gatherer, s, 0.02 * row);
  all_have_epoch(2);
  for (int row = 8; row >= 0; --row) scan_row(gatherer, 1, 0.02 * row);
  EXPECT_EQ(gatherer.epoch(), 3U);
  EXPECT_EQ(gatherer.counts().merged, 19U * kReturns);
  for (int row = 10; row < 12; ++row) scan_row(gatherer, 0, 0.02 * row);  // still its first epoch, of places not seen before
  for (int row = 11; row >= 0; --row) scan_row(gatherer, 0, 0.02 * row);
  EXPECT_EQ(gatherer.epoch(), 4U);
  EXPECT_EQ(gatherer.store().size(), 12U * kReturns);
  EXPECT_EQ(gatherer.counts().merged, 31U * kReturns);
}

// A scanner whose epoch is the older one may come last: the point keeps the higher number, and overflow takes the lower ones first.
TEST(InterleavedScanners, AMergedPointKeepsTheHigherEpoch) {
  GatheringOptions options;
  options.capacity = 3;
  PointCloudGatherer gatherer(options);
  for (int s = 0; s < 3; ++s) gatherer.add_scanner({}, upright_pan());
  scan_row(gatherer, 0, 0.00, {{0.0, 3.0}});
  scan_row(gatherer, 1, 0.10, {{0.0, 3.0}});
  scan_row(gatherer, 0, 0.10, {{0.0, 3.0}});  // merges with the point of epoch 2
  scan_row(gatherer, 0, 0.20, {{0.0, 3.0}});
  ASSERT_EQ(gatherer.store().size(), 3U);
  EXPECT_EQ(gatherer.store().epoch(1), 2U);
  scan_row(gatherer, 2, 0.30, {{0.0, 3.0}});
  scan_row(gatherer, 2, 0.40, {{0.0, 3.0}});
  std::multiset<std::uint32_t> epochs;
  for (std::uint32_t i = 0; i < gatherer.store().places(); ++i) epochs.insert(gatherer.store().epoch(i));
  EXPECT_EQ(epochs, (std::multiset<std::uint32_t>{2, 3, 3}));
}

// Any number of scanners, panning to and fro and standing still, some of which come later: a return merges exactly when a point overlaps that holds
// none of its scanner's running epoch. What each point holds is kept beside, in full.
TEST(InterleavedScanners, NoPointTakesTwoReturnsOfOneEpoch) {
  EXPECT_TRUE(rc::check("one return an epoch", [] {
    GatheringOptions options;
    options.shrink_m = 1.0;  // nothing is deleted
    PointCloudGatherer gatherer(options);
    std::vector<double> pans;
    std::vector<std::uint32_t> epochs;
    std::vector<std::set<std::pair<std::size_t, std::uint32_t>>> held;
    const int most = *rc::gen::inRange(1, 20);
    for (int i = *rc::gen::inRange(1, 200); i > 0; --i) {
      if (pans.empty() || (static_cast<int>(pans.size()) < most && *rc::gen::inRange(0, 4) == 0)) {
        gatherer.add_scanner({0.02, 0.01, 0.01}, upright_pan());
        pans.push_back(0.0);
        epochs.push_back(0);
      }
      const auto s = *rc::gen::inRange<std::size_t>(0, pans.size());
      pans[s] += 0.004 * *rc::gen::inRange(-3, 4);
      const CloudStore before = gatherer.store();
      const std::uint32_t epoch = gatherer.epoch();
      const std::uint64_t merged = gatherer.counts().merged;
      scan_row(gatherer, s, pans[s], {{0.01 * *rc::gen::inRange(0, 3), 3.0}});
      if (gatherer.epoch() != epoch) epochs[s] = gatherer.epoch();
      const std::pair<std::size_t, std::uint32_t> mark{s, epochs[s]};
      const CloudStore& store = gatherer.store();
      const auto scan = static_cast<std::uint32_t>(gatherer.counts().scans - 1);
      std::uint32_t at = 0;
      while (at < store.places() && store[at].scan != scan) ++at;
      RC_ASSERT(at < store.places());
      if (gatherer.counts().merged != merged) {
        RC_ASSERT(held[at].insert(mark).second);
        continue;
      }
      RC_ASSERT(at == held.size());
      for (std::uint32_t k = 0; k < before.places(); ++k) {
        const Vector3 between{static_cast<double>(store[at].x - before[k].x), static_cast<double>(store[at].y - before[k].y),
                              static_cast<double>(store[at].z - before[k].z)};
        RC_ASSERT(held[k].count(mark) == 1 || !ellipsoids_overlap(before[k].covariance, store[at].covariance, between, options.quantile));
      }
      held.push_back({mark});
    }
    RC_ASSERT(gatherer.counts().deleted == 0U);
  }));
}

}  // namespace
}  // namespace berm::app
