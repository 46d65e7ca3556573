// Recordings of real scanners drive the gathering.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "gathering/gather_recording.hpp"
#include "gathering/scan_frame.hpp"
#include "points/recording.hpp"

namespace berm::app {
namespace {

std::string real_data(const std::string& file) {
  const char* folder = std::getenv("BERM_REAL_DATA");
  return std::string(folder != nullptr && *folder != '\0' ? folder : BERM_REAL_DATA) + "/" + file;
}

void account(const PointCloudGatherer& gatherer, std::size_t points) {
  const GatheringCounts c = gatherer.counts();
  printf("%llu scans, %llu points in, %zu kept, %llu merged, %llu deleted, %u epochs\n", static_cast<unsigned long long>(c.scans),
         static_cast<unsigned long long>(c.points_in), gatherer.store().size(), static_cast<unsigned long long>(c.merged),
         static_cast<unsigned long long>(c.deleted), gatherer.epoch());
  EXPECT_EQ(c.points_in, points);
  EXPECT_EQ(gatherer.store().size() + c.merged + c.deleted + c.ignored, points);
}

// It stands still: every scan is an epoch, and what is measured again and again becomes one point.
TEST(RealRecordings, LaserSessionGathers) {
  const std::string path = real_data("lms111/20210302_lms111.pcapng.json");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: no " << path << " (BERM_REAL_DATA)";
  const PointCloud recording = read_recording(path);
  PointCloudGatherer gatherer(GatheringOptions{.epoch = kEpochRuleOfRecordings});
  gatherer.add_scanner({});
  EXPECT_EQ(gather_recording(recording, 0, Eigen::Isometry3d::Identity(), gatherer), 0U);
  account(gatherer, recording.points.size());
  EXPECT_EQ(gatherer.counts().scans, 175U);
  EXPECT_EQ(gatherer.epoch(), 175U);
  EXPECT_GT(gatherer.counts().merged, recording.points.size() * 9 / 10);
  EXPECT_LT(gatherer.store().size(), 2000U);
  for (const ScanPoint& p : gatherer.points()) {
    EXPECT_LT(std::hypot(p.x, p.y), 2.0F);
    EXPECT_NEAR(p.z, 0.0F, 1e-5F);
  }
}

// Four turns of a sensor that stands still, each an epoch.
TEST(RealRecordings, VelodyneCaptureGathers) {
  const std::string path = real_data("vlp16_dual_return/vlp16_dual_return.pcap");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: no " << path << " (BERM_REAL_DATA)";
  const PointCloud recording = read_recording(path);
  PointCloudGatherer gatherer(GatheringOptions{.epoch = kEpochRuleOfRecordings});
  gatherer.add_scanner({0.03, 0.0015, 0.0035});
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.translation().z() = 1.8;
  gather_recording(recording, 0, mount, gatherer);
  account(gatherer, recording.points.size());
  EXPECT_GE(gatherer.epoch(), 4U);
  EXPECT_LE(gatherer.epoch(), 7U);
  EXPECT_GT(gatherer.counts().merged, recording.points.size() / 2);
  EXPECT_LT(gatherer.counts().deleted, recording.points.size() / 20);
}

TEST(RealRecordings, TerrainWithoutScanlinesIsKept) {
  const std::string path = real_data("site_terrain/terrain_xyz.pcd");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: no " << path << " (BERM_REAL_DATA)";
  const PointCloud recording = read_recording(path);
  PointCloudGatherer gatherer(GatheringOptions{.epoch = kEpochRuleOfRecordings});
  gatherer.add_scanner({});
  EXPECT_EQ(gather_recording(recording, 0, Eigen::Isometry3d::Identity(), gatherer), 1U) << "flat as seen from its origin, and yet no scan plane";
  EXPECT_EQ(gatherer.counts().scans, 1U);
  account(gatherer, recording.points.size());
  EXPECT_EQ(gatherer.counts().deleted, 0U);
  EXPECT_EQ(gatherer.counts().ignored, 0U);
}

TEST(ScanFrame, PlaneAndAnglesAreFound) {
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
  truth.linear() = Eigen::Quaterniond(0.8, 0.1, -0.3, 0.4).normalized().toRotationMatrix();
  truth.translation() << 1.0, 2.0, 3.0;
  std::vector<ScanPoint> points;
  for (double angle = 2.0; angle > -2.0; angle -= 0.01) {
    const Eigen::Vector3d p = truth * Eigen::Vector3d(4.0 * std::cos(angle), 4.0 * std::sin(angle), 0.0);
    points.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0, 0.0});
  }
  const auto scan = fit_scan(points, truth.translation(), &truth);
  ASSERT_TRUE(scan);
  EXPECT_LT((scan->frame.matrix() - truth.matrix()).norm(), 1e-5);
  ASSERT_EQ(scan->returns.size(), points.size());
  EXPECT_NEAR(scan->returns.back().angle_rad, 2.0, 1e-5);
  EXPECT_NEAR(scan->returns.front().range_m, 4.0, 1e-5);
  EXPECT_FALSE(fit_scan(std::span(points).first(1), truth.translation(), nullptr));
  for (std::size_t i = 0; i < points.size(); ++i) points[i].z += i % 2 == 0 ? 1.5F : -1.5F;
  EXPECT_FALSE(fit_scan(points, truth.translation(), nullptr));  // no plane
}

}  // namespace
}  // namespace berm::app
