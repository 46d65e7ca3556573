// Free space in the kernel's cycle: rays and returns into its voxels, and where something stands in what was free.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "config/parameter_block.h"
#include "core/clearance_rules.h"
#include "core/free_space.h"
#include "core/scanline_raster.h"
#include "io/dig_watch.hpp"

namespace berm::kernel {

class SpaceWatch {
 public:
  static constexpr double kStepMm = 100.0;  // along a ray: of every voxel of which it crosses more than a corner

  explicit SpaceWatch(const berm_parameters& parameters);

  bool kept() const { return parameters_.workspace_foreign > 0; }
  // Nothing is known of any voxel.
  void begin();
  // Nothing is known any more of the voxels over the cells that touch the lane.
  void forget(const berm_lane& lane);
  // A return that is not of the own machine, and the space between it and the sensor's head, base frame. learning: what is there now belongs there.
  void take(const sk_point& head, const sk_point& point, bool learning, std::int64_t now_us);
  // The return alone.
  void meet(const sk_point& point, bool learning, std::int64_t now_us);
  // A ray that met something beyond passed over the cell as low as its ground, no higher than z_mm, and its sensor knows of nobody about
  // (MonitorWatch::pass): twice, the monitor's wait apart, with nothing met in FOREIGN voxels of the cell between, nor of the eight round it lately, and
  // they are free from the higher of the two on. Rays above the level do not come back from the sky, and free nothing.
  void pass_low(const sk_monitor_cell& at, std::int32_t z_mm, std::int64_t now_us);
  // The region, less what the machine itself changes: as the Workspace Monitor's; but of a truck zone only the box round what stands in it is left
  // out, higher than may be passed over: the truck and its load. While nobody knows what stands there, the whole zone is.
  // With histograms dig zones belong to the region.
  void watch(bool lanes_open, bool truck_learned);
  // Once a cycle. Where the bucket is near soil comes to lie in what was free, up to its zone's ceiling. While heights are learned, so that nobody else watches
  // there, it has come to rest some time after the bucket has gone; once they are, soil may be there until the begin. held: somebody is in the region,
  // and no cell is taken for one with soil, lest it be his.
  void dig(const std::vector<DigWatch::Cell>& cells, bool heights_learned, bool held);
  // What is met there belongs there.
  bool may_be_soil(const sk_point& point) const;
  // A cell of the region with so many FOREIGN voxels that somebody is in it; false where there is none.
  bool find(sk_monitor_cell& where) const;
  // The highest FOREIGN voxel of a cell, its low side; the floor where there is none.
  std::int32_t foreign_height_mm(const sk_monitor_cell& cell) const;

  const sk_free_space& space() const { return space_; }
  bool watched(std::int32_t iy, std::int32_t ix) const { return region_.watched[iy][ix] != 0; }

 private:
  static constexpr double kShortMm = 200.0;  // of the return: its own surface, by noise and the beam's width
  static constexpr double kReachMm = 22000.0;
  static constexpr int kStepsMost = static_cast<int>(kReachMm / kStepMm);

  void see(const sk_voxel& voxel, std::int64_t now_us);
  bool met_about(const sk_monitor_cell& at, std::int64_t now_us) const;
  void leave_out(const berm_truck_zone& zone, bool truck_learned);
  bool stands_high(std::int32_t iy, std::int32_t ix) const;

  const berm_parameters& parameters_;
  berm_parameters without_zones_;  // of trucks and, where it is told where the bucket was, of digs
  sk_clearance_rules limits_;   // pass_mm alone: with no truck
  sk_monitor_rules region_;     // watched alone
  sk_free_space space_;
  std::int64_t met_us_[SK_MAP_CELLS][SK_MAP_CELLS];  // when something was last met in a FOREIGN voxel of the cell; -1 never
  std::int64_t low_us_[SK_MAP_CELLS][SK_MAP_CELLS];  // when a ray first passed it low since then; -1 not yet
  std::int32_t low_mm_[SK_MAP_CELLS][SK_MAP_CELLS];  // how high that ray was; where low_us_ has one
  static constexpr std::int32_t kNoSoilMm = std::numeric_limits<std::int32_t>::min();
  std::int32_t soil_mm_[SK_MAP_CELLS][SK_MAP_CELLS];  // how high the bucket may have heaped it up
  bool blank_ = false;          // nothing has been taken since the begin
};

}  // namespace berm::kernel
