// The Workspace Monitor in the kernel's cycle (SG-6): the sensors' returns into its maps, the trucks' lanes, and whether the machine must stand.
//
// The panning scanners have one monitor, each lidar on the upper body has its own: they see from other places and again after another time, and what
// one of them sees of a cell explains or excuses nothing that another sees, but for histograms in which there is too little of it (SK-WM-68, 71).
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "geometry/joint_history.hpp"
#include "io/lidar_watch.hpp"
#include "io/monitor_watch.hpp"
#include "io/scan_intake.hpp"
#include "io/space_watch.hpp"

namespace berm::kernel {

class WorkspaceWatch {
 public:
  static constexpr int kScanners = 0;  // number of the panning scanners' monitor; that of lidar i is i + 1

  explicit WorkspaceWatch(const berm_parameters& parameters);

  // What is seen from now on is what later heights are compared with: the base stands, and nobody is in the region. For workspace_learn_us after the
  // next step it is learned: what changes then is ground, and so is what is seen in free space in the first seconds.
  void begin();
  // Every return of the panning scanners that is in the height map too, and between two that follow one another on a scanline what the line from the
  // one to the other passes over (leger-1998, section 3.1; it counts in EMPTY cells only).
  // Their rays tell of free space; the swing at the block's time places the scanner.
  void take(const ScanBlocks& blocks, const JointHistory& joints, std::int64_t now_us);
  // A packet of a lidar. joints: at the time of the packet. Its returns meet free space too; of its rays those tell of it in whose bearing lines are
  // drawn.
  void take(int lidar, const Vlp16Packet& packet, const JointAngles& joints, std::int64_t now_us);
  // Once a cycle. With no fresh word of the spotter the lanes stay as they were. A truck that has parked is learned with its lane; until it leaves the
  // lane is watched.
  void trucks(bool spotter_fresh, bool parked, std::int64_t now_us);
  // Once a cycle, before what is seen in it is taken: where the bucket is, and whether the machine stands.
  void dig(const JointAngles& joints, bool stands, std::int64_t now_us);
  // Once a cycle, after them: whether somebody came into the region, and has not left it for long enough. False where nobody watches it.
  bool step(std::int64_t now_us);

  bool watched() const { return parameters_.workspace_watched != 0; }
  // The whole region's ground is being learned, or that of the lanes since a truck has parked: nobody there is watched, but by free space.
  bool learns() const { return watched() && (!begun_ || learned_us_ != kNotLearning); }
  bool learns_lanes() const { return !lanes_open_ && lane_learned_us_ != kNotLearning; }
  // Of the newest step, of a monitor that says stop: a cell with somebody in it, its centre and what is seen there; false when there is none (any
  // more).
  bool place(std::int32_t& x_mm, std::int32_t& y_mm, std::int32_t& height_mm) const;
  // Of the newest packet of a lidar.
  const LidarReturns& lidar_returns(int lidar) const { return lidar_[lidar].returns(); }
  int monitors() const { return 1 + lidars_; }
  // Of a monitor: the cycle in which it was last given a return; -1: none since begin().
  std::int64_t newest_us(int number) const { return of(number).newest_us(); }
  const SpaceWatch& space() const { return space_; }
  const sk_monitor& monitor(int number = kScanners) const { return of(number).monitor(); }
  const sk_monitor_histogram* histogram(int number = kScanners) const { return of(number).histogram(); }  // null: one height a cell is compared with
  const sk_monitor_rules& rules(int number = kScanners) const { return of(number).rules(); }

 private:
  static constexpr std::int64_t kNotLearning = -1;
  // Free space needs no machine that has swung: what is seen for the first time lies in no space that rays have passed all round.
  static constexpr std::int64_t kSpaceLearnUs = 3'000'000;

  static constexpr std::int64_t kTruckBoxUs = 1'000'000;

  struct Last {  // return of a scanner
    std::uint32_t scanline = 0;
    std::int32_t index = -2;
    sk_point point{};
  };
  MonitorWatch::Others others_of(int number);
  MonitorWatch& of(int number) { return number == kScanners ? scanners_ : lidar_[number - 1].monitor(); }
  const MonitorWatch& of(int number) const { return number == kScanners ? scanners_ : lidar_[number - 1].monitor(); }
  sk_point head(int scanner, std::int64_t time_us, const JointHistory& joints) const;
  bool space_learns(const sk_point& point) const;  // so that what stands there is no intruder
  std::int64_t space_learned_from(std::int64_t now_us) const;
  bool in_lane(std::int32_t iy, std::int32_t ix) const;
  void settle(const berm_lane& rectangle);
  void settle_beside_lanes();
  void end_learning(std::int64_t now_us);
  bool foreign(std::int64_t now_us);

  const berm_parameters& parameters_;
  const int lidars_;
  MonitorWatch scanners_;
  LidarWatch lidar_[BERM_LIDARS];
  DigWatch digs_;
  SpaceWatch space_;
  sk_monitor_cell in_space_{-1, -1};             // a cell with somebody in free space
  std::int64_t in_space_us_ = -1;                // when somebody was last there; -1 never
  bool begun_ = false;
  std::int64_t learned_us_ = kNotLearning;       // when the whole region's ground will have been learned
  std::int64_t space_learned_us_ = kNotLearning; // when free space will have been
  std::int64_t lane_learned_us_ = kNotLearning, lane_space_learned_us_ = kNotLearning;  // the same two of the lanes
  bool truck_box_due_ = false;                   // what stands in the trucks' zones is to be looked at anew
  std::int64_t truck_box_us_ = 0;                // while it is learned: when next
  Last last_[BERM_SCANNERS];
  bool lanes_open_ = true;
  bool holds_ = false;                           // the newest step said stop
};

}  // namespace berm::kernel
