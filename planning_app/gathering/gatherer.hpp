// Point-cloud gathering (zolynski-2012): scans of any number of panning scanners into one consistent cloud of a changing place. See GATHERING.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gathering/cloud_store.hpp"
#include "gathering/deletion_volume.hpp"
#include "gathering/epoch_counter.hpp"
#include "gathering/kinematic_chain.hpp"
#include "gathering/scan_contributors.hpp"
#include "gathering/scan_times.hpp"
#include "points/point_cloud.hpp"

namespace berm::app {

struct GatheringOptions {
  std::size_t capacity = 2'000'000;  // points
  double quantile = 2.0;             // of the error volumes, in standard deviations
  double least_m = 0.005;            // no deviation of a merged point gets smaller
  double voxel_m = 0.15;
  double range_limit_m = 100.0;  // farther returns are not used
  double shrink_m = 0.05;        // of the deletion volume, beside the deviations
  double max_gap_rad = 0.045;
  double max_turn_rad = 0.045;
  EpochRule epoch{};
};

struct GatheringCounts {
  std::uint64_t scans = 0, points_in = 0;
  std::uint64_t merged = 0, deleted = 0, overflowed = 0;
  std::uint64_t ignored = 0;  // beyond the range limit, not finite, or out of order
};

class PointCloudGatherer {
public:
  explicit PointCloudGatherer(const GatheringOptions& options);

  // Returns the scanner's number. chain may stay empty when poses are given with the scans.
  std::size_t add_scanner(const ScannerDeviations& deviations, KinematicChain chain = {});

  // One turn of the mirror; joint_values by encoder number. Returns that are not finite, not positive, beyond the range limit, beyond half a turn
  // or not in rising angle are counted as ignored. Throws std::out_of_range for an unknown scanner or a missing encoder.
  void add_scan(std::size_t scanner, std::span<const double> joint_values, std::span<const PolarReturn> returns, double time_s);
  void add_scan(std::size_t scanner, const Eigen::Isometry3d& frame, std::span<const PolarReturn> returns, double time_s);

  // Points of a scan whose plane is not known, and the place of the optical centre, both in a frame that mount takes to the cloud's: merged or kept
  // in the scanner's epoch; nothing is deleted for them, nor between this scan and the next.
  void add_points(std::size_t scanner, const Eigen::Isometry3d& mount, const Eigen::Vector3d& origin, std::span<const ScanPoint> points,
                  double time_s);

  // The vehicle was moved: everything is forgotten (zolynski-2012, 2.3).
  void clear();

  const CloudStore& store() const { return store_; }
  GatheringCounts counts() const;
  std::uint32_t epoch() const { return epoch_; }  // the highest so far
  std::size_t bytes() const;

  // In rising scan: scanline is the number over all scanners of the latest scan that measured the point.
  std::vector<ScanPoint> points() const;

private:
  struct Scanner {
    std::size_t number;
    ScannerDeviations deviations;
    KinematicChain chain;
    EpochCounter epochs;
    std::uint32_t epoch = 0;
    bool has_scan = false;
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    std::vector<PolarReturn> returns;  // of the scan before
  };
  void begin_epoch(Scanner& scanner);
  void take_valid(std::span<const PolarReturn> returns);
  void delete_passed();
  void delete_in_block(const CloudStore::Block& block);
  void insert(const Scanner& scanner, const Eigen::Isometry3d& frame, const PolarReturn& p);

  GatheringOptions options_;
  CloudStore store_;
  ScanContributors contributors_;
  std::vector<Scanner> scanners_;
  ScanTimes times_;
  std::vector<PolarReturn> valid_;
  std::vector<std::uint32_t> passed_;
  DeletionVolume volume_;
  std::uint32_t epoch_ = 0;
  double widest_m_ = 0.0;  // standard deviation along an axis, the largest of a point so far
  GatheringCounts counts_;
};

}  // namespace berm::app
