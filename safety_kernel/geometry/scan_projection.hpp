// From the samples of a scan packet to points, and the filter of spurious returns.
#ifndef BERM_KERNEL_GEOMETRY_SCAN_PROJECTION_HPP
#define BERM_KERNEL_GEOMETRY_SCAN_PROJECTION_HPP

#include <Eigen/Core>

#include "config/parameter_block.h"
#include "core/scanline_raster.h"
#include "scan/scan_packet.h"

namespace berm::kernel {

// Last echo and number of echoes of each of the packet's samples; range 0 where there is none.
void last_echoes(const berm_scan_packet& packet, uint32_t (&range_mm)[BERM_SCAN_PACKET_SAMPLES], uint8_t (&echoes)[BERM_SCAN_PACKET_SAMPLES]) noexcept;

// Samples on each side that say whether a return is spurious.
constexpr int filter_reach = 4;

// Sets to 0 every return that nothing supports: no neighbour (the nearest return before and after it, no farther than two samples) that agrees
// within the threshold, nor two neighbours that it lies between. Where one of these is nearer, or farther, than both its own neighbours by more than the
// threshold, it must lie between the other and the one beyond as well. A return on the own machine (own[i] not 0) agrees with nothing, and
// nothing lies between it and another: noise over the edge of the own bucket would stay in the map as long as the bucket hides the ground.
// Returns how many were dropped.
// What it can hide: an object met by one sample alone, or by two that differ among themselves by more than the threshold; beside the own
// implements one sample more than what they hide themselves (requirement SK-GE-23).
int filter_spurious(uint32_t* range_mm, const uint8_t* own, int count, uint32_t threshold_mm) noexcept;

int64_t sample_time_us(const berm_scan_packet& packet, int sample) noexcept;
double sample_pan_rad(const berm_scan_packet& packet, int sample) noexcept; // linear from the first sample to the last

class ScanProjection {
public:
  explicit ScanProjection(const berm_parameters& parameters) noexcept;

  // Point in the upper body's frame, m. False, and nothing changed, where the scanner or sample does not exist or the range lies
  // outside range_min..range_max of the parameters.
  bool in_upper_body(const berm_scan_packet& packet, int sample, uint32_t range_mm, Eigen::Vector3d& point) const noexcept;

  // The head's place in the upper body's frame, m. scanner: below BERM_SCANNER_MOUNTS.
  const Eigen::Vector3d& head(int scanner) const noexcept { return head_[scanner]; }

  // Point in the base frame on the millimetre grid: x and y to the nearest, z up; z is clamped to +-SK_HEIGHT_MAX_MM (a top of the map
  // is no lower than any implement can reach). False, and nothing changed, where x or y leaves +-SK_COORD_MAX_MM or is not a number.
  static bool in_base(const Eigen::Vector3d& upper_body, double swing_rad, sk_point& point) noexcept;

private:
  Eigen::Vector3d head_[BERM_SCANNER_MOUNTS]; // m
  uint32_t range_min_mm_, range_max_mm_;
};

} // namespace berm::kernel
#endif
