// A run's journal as scanlines with their encoders, against scans made by SCAN.md's own words.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "gathering/gather_journal.hpp"
#include "made_journal.hpp"
#include "points/point_cloud.hpp"
#include "scratch.hpp"

namespace berm::app {
namespace {

using namespace made_journal;

// Each return lies on the ground or on a wall, by the chain and the encoders, while the swing and the pan go on within a scanline.
TEST(JournalScans, AreWhereTheEncodersHaveThem) {
  const berm::test::Scratch scratch;
  JournalScans journal(written(scratch, "run.mcap", records(400)));
  EXPECT_TRUE(JournalScans::is_journal(journal.path()));
  const KinematicChain chain[2] = {journal.chain(0), journal.chain(1)};
  EncodedScan scan;
  int scans = 0, points = 0, seen[2] = {0, 0};
  double worst_m = 0.0, below = 0.0;
  while (journal.next(scan)) {
    ++scans;
    ++seen[scan.scanner];
    EXPECT_NEAR(scan.encoder[0], kSwingRate * scan.time_s, 1e-4);
    EXPECT_NEAR(scan.encoder[1], kPanRate * scan.time_s - 0.3, 1e-4);
    EXPECT_EQ(scan.begun_anew_s, -1.0);
    double last = -4.0;
    for (const PolarReturn& r : scan.returns) {
      EXPECT_GT(r.angle_rad, last);
      last = r.angle_rad;
      EXPECT_LE(std::fabs(r.angle_rad), kTurn / 2.0);
      const Eigen::Vector3d p = chain[scan.scanner].pose(scan.encoder) * Eigen::Vector3d(r.range_m * std::cos(r.angle_rad), r.range_m * std::sin(r.angle_rad), 0.0);
      EXPECT_GE(std::hypot(p.x(), p.y()), 2.4);  // nothing of the machine itself
      const double off = std::min({std::fabs(p.z()), std::fabs(9.0 - std::fabs(p.x())), std::fabs(9.0 - std::fabs(p.y()))});
      worst_m = std::max(worst_m, off);
      below = std::min(below, r.angle_rad);
      ++points;
    }
  }
  // Of a full turn of 33 ms a return is 17 ms from the middle one at most, and the plane turns by 1.3 rad/s: 22 mrad, 0.3 m at 13 m on a wall seen askew.
  EXPECT_LT(worst_m, 0.3);
  EXPECT_GT(scans, 190);
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_GT(points, 30'000);
  EXPECT_LT(below, -1.0);
}

TEST(JournalScans, GatherAndAreClearedWithTheKernelsMap) {
  const berm::test::Scratch scratch;
  for (const int anew : {-1, 200}) {
    JournalScans journal(written(scratch, "run.mcap", records(400, anew)));
    PointCloudGatherer gatherer{GatheringOptions{}};
    EXPECT_EQ(gather_journal(journal, {}, Eigen::Isometry3d::Identity(), gatherer), anew < 0 ? 0U : 1U);
    const GatheringCounts c = gatherer.counts();
    EXPECT_EQ(c.ignored, 0U);
    EXPECT_GT(c.points_in, 30'000U);
    double first_s = 1e9;
    for (const ScanPoint& p : gatherer.points()) first_s = std::min(first_s, p.time_s);
    if (anew < 0) EXPECT_LT(first_s, 1.2);
    else EXPECT_GE(first_s, 2.9);  // cycle 300
  }
}

TEST(JournalScans, WhatIsNoJournalIsNamed) {
  const berm::test::Scratch scratch;
  const auto message = [](const std::string& path) -> std::string {
    try {
      JournalScans journal(path);
      EncodedScan scan;
      while (journal.next(scan)) {
      }
    } catch (const PointFileError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_FALSE(JournalScans::is_journal(scratch.path("absent.mcap")));
  EXPECT_NE(message(scratch.path("absent.mcap")).find("absent.mcap"), std::string::npos);
  berm_journal_start start = start_of_run();
  start.parameters.crc32 ^= 1;
  EXPECT_NE(message(written(scratch, "crc.mcap", records(4), start)).find("kernel.params: crc32: wrong"), std::string::npos);
  auto forged = records(8);
  berm_journal_scan scan;
  std::memcpy(&scan, forged[5].data() + sizeof(berm_journal_cycle), sizeof scan);
  scan.count = 60'000;
  std::memcpy(forged[5].data() + sizeof(berm_journal_cycle), &scan, sizeof scan);
  EXPECT_NE(message(written(scratch, "count.mcap", forged)).find("cycle record 5: scan_packets: a scan is damaged"), std::string::npos);
}

}  // namespace
}  // namespace berm::app
