// Packets of the lidars on the upper body (VLP-16, the parameter block's `lidar`) into the height map, and whether each is alive.
//
// Alive is a lidar that sends, and that turns: one whose head stands, or that sends a part of its turn alone, is blind to all the rest, and what comes
// back from the part says nothing of it. So its life is that of the sector of its turn that was fired into longest ago.
// They are for the ground near the machine, round the tail: farther returns are left to the panning scanners, and of the firings every eighth is taken.
// A return that too few of those round it support is spurious (dust, an outlier): where the implements hide the ground from the scanners it would stay.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "config/parameter_block.h"
#include "core/height_map.h"
#include "geometry/joint_history.hpp"
#include "geometry/self_filter.hpp"
#include "io/lidar_mount.hpp"
#include "io/own_shadow.hpp"
#include "io/sensor_clock.hpp"
#include "io/vlp16.hpp"

namespace berm::kernel {

class LidarIntake {
 public:
  static constexpr std::uint32_t kTakenMdeg = 1600;   // of the turn one firing is taken, and stands for all of it
  static constexpr double kFarthestM = 8.0;           // from the swing axis
  static constexpr std::uint32_t kAheadMaxUs = 1000000;
  static constexpr std::uint32_t kBesideMdeg = 1000;  // firings farther apart are no neighbours
  static constexpr int kSupporters = 2;               // of the returns round it
  static constexpr std::int64_t kLateMaxUs = 100000;  // more than the one that came with the least delay
  static constexpr int kSectors = 36;                 // of the sensor's own turn
  static constexpr std::int64_t kTurnUs = 100000;     // a turn at 600 a minute: a sector is due again so long after it was fired into

  explicit LidarIntake(const berm_parameters& parameters);

  // One packet of a lidar, its joint angles being those of now. False when it was refused: no packet of a VLP-16, of no lidar there is, not later
  // than the one before it, by the sensor's own clock, by at most a second, or too late.
  bool take(int lidar, const std::uint8_t* bytes, std::size_t size, const JointHistory& joints, std::int64_t now_us, sk_height_map& map,
            OwnShadow& shadow);

  // Each lidar has fired into every sector of its turn, since start.
  bool all_heard() const;
  // No usable packet of some lidar for longer than the limit, or no firing into some sector of its turn for longer than limit and turn, once all were
  // heard.
  bool silent(std::int64_t now_us, std::int32_t limit_us) const;
  std::uint32_t points() const { return points_; }  // into the map since start, wrapping
  // Of the packet that was taken last, of this lidar: its returns, and the middle of the time in which they were made, on the kernel's clock.
  const Vlp16Packet& packet() const { return packet_; }
  std::int64_t middle_us(int lidar) const { return mount_[lidar].clock.time_us() - packet_.firings * kVlp16FiringNs / 2000; }

 private:
  struct Mount : LidarMount {
    std::int64_t heard_us = -1;
    std::int64_t sector_us[kSectors];  // when it was last fired into, -1: never
    SensorClock clock;
    Mount() { std::fill(sector_us, sector_us + kSectors, std::int64_t{-1}); }
    void note_sectors(const std::uint8_t* bytes, std::int64_t now_us);
    std::int64_t turned_us() const { return *std::min_element(sector_us, sector_us + kSectors); }
  };
  struct Swung {
    ImplementPose pose;
    double cosine, sine;  // of the swing
  };
  struct Firings;
  // A return of the firing of that number and that laser, as far away as hit and not on the own machine. 1 or 0, to be counted.
  int supports(const Mount& mount, const Vlp16Return& hit, const Firings& firings, int firing, int channel, const Swung& swung) const;
  bool spurious(const Mount& mount, const Vlp16Return& hit, const Firings& firings, const Swung& swung) const;
  bool accept(Mount& mount, const std::uint8_t* bytes, std::int64_t now_us) const;
  void insert(const Mount& mount, const Vlp16Return& hit, const Firings& firings, const Swung& swung, std::int64_t now_us, sk_height_map& map, OwnShadow& shadow);

  const berm_parameters& parameters_;
  SelfFilter self_;
  int lidars_ = 0;
  Mount mount_[BERM_LIDARS];
  Vlp16Packet packet_{};
  std::uint32_t points_ = 0;
};

}  // namespace berm::kernel
