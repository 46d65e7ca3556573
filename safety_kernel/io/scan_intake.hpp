// Packets of the panning scanners into the height map: points, filter of spurious returns, filter of the own machine and what it hides, occlusion
// interpolation between neighbouring returns of a scanline.
//
// A packet waits until the next of its scanline is there (or it is its scanline's last, or nothing follows in time): then every sample has
// its neighbours, and the joint angles on both sides of every sample are known.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "contract/berm_contract.h"
#include "core/height_map.h"
#include "geometry/joint_history.hpp"
#include "geometry/scan_projection.hpp"
#include "geometry/self_filter.hpp"
#include "io/own_shadow.hpp"
#include "io/scan_health.hpp"
#include "scan/scan_packet.h"

namespace berm::kernel {

// Blocks finished in one cycle, for the state segment.
struct ScanBlocks {
  static constexpr int kCapacity = 64;
  int count = 0;
  berm_scan_block block[kCapacity];
};

class ScanIntake {
 public:
  static constexpr std::int64_t kWaitUs = 40000;  // for the next packet of the scanline

  explicit ScanIntake(const berm_parameters& parameters);

  // One decoded packet. False when it was refused (see ScanHealth).
  bool take(const berm_scan_packet& packet, const JointHistory& joints, std::int64_t now_us, sk_height_map& map, ScanBlocks& blocks);
  // Once a cycle, after all packets: finishes packets that waited too long.
  void flush(const JointHistory& joints, std::int64_t now_us, sk_height_map& map, ScanBlocks& blocks);

  // What the machine hides; for the lidar's returns too.
  OwnShadow& shadow() { return shadow_; }
  const ScanHealth& health() const { return health_; }
  std::int32_t pan_urad(int scanner) const { return line_[scanner].pan_urad; }
  std::uint32_t points() const { return points_; }  // into the map since start, wrapping

 private:
  static constexpr int kNeighbours = filter_reach;

  struct Line {
    bool waiting = false;                 // packet is to be worked off
    std::int64_t arrived_us = 0;
    berm_scan_packet packet{};
    std::uint32_t before[kNeighbours] = {};  // raw ranges of the samples before the packet, 0 where the chain is broken
    std::uint8_t before_own[kNeighbours] = {};
    std::uint8_t last_own[kNeighbours] = {};  // of the packet's own last samples, once it is worked off
    bool chained = false;                 // last is the point of the sample just before the packet
    sk_point last{};
    std::int32_t pan_urad = 0;
  };

  static bool continues(const berm_scan_packet& earlier, const berm_scan_packet& later);
  // next: the packet after it on the same scanline, or null.
  void work_off(Line& line, const berm_scan_packet* next, const JointHistory& joints, std::int64_t now_us, sk_height_map& map, ScanBlocks& blocks);
  struct Located {
    sk_point point, head;  // head: the scanner's, at that time
    std::uint8_t found;  // 0: no return, or none that can be placed
    std::uint8_t own;    // 1: on the own machine
  };
  Located locate(const berm_scan_packet& packet, int sample, std::uint32_t range_mm, const JointHistory& joints) const;
  void filter(const Line& line, const berm_scan_packet* next, const std::uint32_t* raw, const Located* located, const JointHistory& joints,
              std::uint32_t* kept) const;
  void insert(Line& line, const sk_point& point, std::int64_t now_us, sk_height_map& map) const;
  void start_block(const Line& line, berm_scan_block& block) const;

  const berm_parameters& parameters_;
  ScanProjection projection_;
  SelfFilter self_;
  OwnShadow shadow_;
  ScanHealth health_;
  Line line_[ScanHealth::kScanners];
  std::uint32_t points_ = 0;
};

}  // namespace berm::kernel
