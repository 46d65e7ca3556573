// ISO 13855's distance in the kernel's cycle (SK-SD): which directions about the machine the sensors saw that feed the Workspace Monitor, and what
// stopping time that leaves. Motion is cut to it by MotionCheck.
//
// The looks are the lidars' where the machine has any: they come far oftener, and their monitors tell sooner. Else they are the panning scanners'.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "core/separation.h"
#include "io/lidar_intake.hpp"
#include "io/lidar_watch.hpp"
#include "io/scan_intake.hpp"

namespace berm::kernel {

class SectorWatch {
 public:
  // From a beam's return to the start of the cycle that takes it, at most, less the cycle itself.
  static constexpr std::int64_t kScannerSightUs = ScanHealth::kAgeMaxUs + ScanIntake::kWaitUs;
  static constexpr std::int64_t kLidarSightUs = LidarIntake::kLateMaxUs + LidarWatch::kWaitUs;

  explicit SectorWatch(const berm_parameters& parameters);

  bool evaluated() const { return parameters_.workspace_watched != 0 && parameters_.workspace_separation != BERM_SEPARATION_NONE; }
  bool enforced() const { return evaluated() && parameters_.workspace_separation == BERM_SEPARATION_ENFORCED; }

  // Nothing was ever seen: the monitor begins anew.
  void begin();
  // A return of a sensor that feeds the monitor, not of the own machine; base frame. Only those from half the region's radius to a quarter beyond it
  // count: nearer ones say nothing of where people come from, and a beam that ends farther may have passed over a head.
  void see(std::int32_t x_mm, std::int32_t y_mm, std::int64_t now_us);
  // Every return of the panning scanners that the monitor is fed, where there is no lidar.
  void take(const ScanBlocks& blocks, std::int64_t now_us);
  // Every return of a lidar that its monitor is fed as measured.
  void take(const LidarReturns& returns, std::int64_t now_us);
  // What stopping time is left when the implements may reach so far from the swing axis before they stand.
  sk_separation left(std::int32_t reach_mm, std::int64_t now_us) const;

  const sk_sectors& sectors() const { return sectors_; }
  const sk_separation_rules& rules() const { return rules_; }
  std::int64_t sight_us() const { return by_lidars_ ? kLidarSightUs : kScannerSightUs; }
  // 0..359, of any place but the origin.
  std::int32_t sector_of(std::int32_t x_mm, std::int32_t y_mm) const;

 private:
  static constexpr int kQuarter = SK_SECTORS / 4;

  const berm_parameters& parameters_;
  const bool by_lidars_;
  sk_separation_rules rules_{};
  sk_sectors sectors_;
  std::int64_t near_mm2_, far_mm2_;
  std::int64_t cosine_[kQuarter], sine_[kQuarter];  // of a sector's low edge in the first quarter, in millionths
};

}  // namespace berm::kernel
