// What the sensors can see (SK-SI): the returns of panning scanners and of lidars on the upper body into the core's judgement of blocked
// windows and dust.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "config/parameter_block.h"
#include "core/sensor_sight.h"
#include "io/lidar_mount.hpp"
#include "io/sight_line.hpp"
#include "io/vlp16.hpp"
#include "scan/scan_packet.h"

namespace berm::kernel {

class SightWatch {
 public:
  static constexpr int kScanners = BERM_SCANNER_MOUNTS;
  static constexpr int kEyes = kScanners + BERM_LIDARS;  // eyes: the scanners, then the lidars
  static constexpr int kScannerStrips = 12;              // of the mirror's circle, 30 degrees each; a lidar's: 15 degrees of azimuth
  static constexpr int kDustStep = 2;                    // of a lidar's firings every second tells of dust
  static constexpr int kRaysATurn = 60;                  // expected of a lidar's strip, at least, where it has so many: 40 are then most of a strip

  explicit SightWatch(const berm_parameters& parameters);

  // No strip was judged yet: what is still covered is found again with its next rays. Dust that dwells goes on dwelling.
  void begin();
  // An accepted packet; swing_rad: of the upper body at that time.
  void take(const berm_scan_packet& packet, double swing_rad, std::int64_t now_us);
  // An accepted packet of a lidar that there is.
  void take(int lidar, const std::uint8_t* bytes, double swing_rad, std::int64_t now_us);
  // Once a cycle, after them.
  void step(std::int64_t now_us);

  // Something lies on a window.
  bool blocked() const { return blocked_eyes_ != 0; }
  std::uint32_t blocked_eyes() const { return blocked_eyes_; }  // bit k: eye k; of the newest step
  std::int32_t dust() const { return dust_; }                   // SK_DUST_*; of the newest step
  std::int32_t dust_permille() const { return sk_dust_worst(eye_, kEyes); }
  const sk_eye& eye(int number) const { return eye_[number]; }

 private:
  static constexpr int kDegrees = 360;

  struct Swung {
    double cosine, sine;
  };
  Eigen::Vector3d beam(int lidar, int degree, int channel) const;
  void choose_steps(int lidar);
  void fired(int lidar, const Vlp16Firing& firing, const Swung& swung);

  const berm_parameters& parameters_;
  const SightLine line_;
  sk_dust_rules rules_{};
  Eigen::Vector3d head_[kScanners];
  LidarMount mount_[BERM_LIDARS];
  std::uint8_t kind_[BERM_LIDARS][kDegrees][kVlp16Channels];  // SightLine::Kind of the middle of a degree of azimuth
  std::uint32_t step_[BERM_LIDARS][SK_SIGHT_STRIPS];          // of the firings in a strip, one in so many is looked at
  std::uint32_t firings_[BERM_LIDARS] = {};                   // since start, wrapping
  sk_eye eye_[kEyes];
  sk_dust dust_state_{};
  std::uint32_t blocked_eyes_ = 0;
  std::int32_t dust_ = SK_DUST_NONE;
};

}  // namespace berm::kernel
