// One Workspace Monitor with what it is told: of all panning scanners, or of one lidar, so that what is compared was seen by the same sensors.
#pragma once

#include <cstdint>
#include <vector>

#include "config/parameter_block.h"
#include "core/monitor_histogram.h"
#include "core/scanline_raster.h"
#include "core/workspace_monitor.h"
#include "io/dig_watch.hpp"

namespace berm::kernel {

class MonitorWatch {
 public:
  // What is compared with and the thresholds are the parameter block's; wait and period this monitor's own.
  MonitorWatch(const berm_parameters& parameters, std::int32_t wait_us, std::int32_t period_us);

  void begin();
  // The other sensors' monitors: with histograms, what they know stands for what this one has seen too little of (SK-WM-68, 71).
  struct Others {
    MonitorWatch* monitor[BERM_LIDARS] = {};
    int count = 0;
    const MonitorWatch* scanners = nullptr;  // the one among them; null of the scanners' own
  };
  // A return, base frame.
  void insert(const sk_point& point, std::int64_t now_us, const Others& others);
  void insert(const sk_point& point, std::int64_t now_us) { insert(point, now_us, Others()); }
  enum class Over { kEverything, kUnmeasured };  // kUnmeasured: not where the accumulated map has a measured height
  // The line from one return to the next, in steps of half a cell: what a corner of it cuts off stays EMPTY. It counts in EMPTY cells only.
  void interpolate(const sk_point& from, const sk_point& to, Over over, std::int64_t now_us);
  // With histograms, of a cell of the map: whether this monitor knows of somebody in it.
  bool somebody(const sk_monitor_cell& at) const;
  // One of this sensor's rays passed over the cell no higher than z_mm. Whether that says of the others' somebody, too, that he has left: what is no departure
  // for this monitor may be one for them, so not where it knows of somebody about, and not where it may have learned him.
  bool pass(const sk_monitor_cell& at, std::int32_t z_mm, std::int64_t now_us, const Others& others);
  void pass_of_another(const sk_monitor_cell& at, std::int32_t z_mm, std::int64_t now_us, const MonitorWatch& other);
  // The trucks' lanes are another ground from now on, and watched or not.
  void change_lanes(const berm_parameters& parameters, bool open);
  // The rectangle is learned: what has CHANGED in it by now belongs to the ground and explains what is seen beside it.
  void settle(const berm_lane& at);
  // With histograms, once a cycle: nothing is known of dig zones where soil may have been moved; where it no longer is, what was seen meanwhile is
  // the ground. learned: the whole region's ground is. holds: somebody is in the region, and no cell may be forgotten, lest it be his.
  void dig(const std::vector<DigWatch::Cell>& cells, bool learned, bool holds);
  // Once a cycle: whether the machine must stand for what this monitor holds.
  bool step(std::int64_t now_us);

  // Of the newest step: a cell with somebody in it, its centre and what is seen there; false when there is none (any more).
  bool place(std::int32_t& x_mm, std::int32_t& y_mm, std::int32_t& height_mm) const;
  std::int64_t newest_us() const { return newest_us_; }  // when a return was last inserted; -1: never since begin()
  const sk_monitor& monitor() const { return monitor_; }  // empty when histograms are compared with
  const sk_monitor_histogram* histogram() const { return histogram_.empty() ? nullptr : histogram_.data(); }
  const sk_monitor_rules& rules() const { return rules_; }

 private:
  static constexpr std::int64_t kStepsMost = 250;  // across the whole map

  bool nobody_about(const sk_monitor_cell& at, std::int64_t now_us) const;  // in the cell and the eight round it
  bool ground_known(const sk_monitor_cell& at, std::int32_t known) const;   // by points or lines of its own, or elsewhere
  // Whether a cell is learned anew while somebody may be about: where it touches a lane, or, which goes before that, a dig zone.
  enum class Anew : std::uint8_t { kNever, kForATruck, kAfterTheBucket };
  static std::size_t cell_number(std::int32_t iy, std::int32_t ix) { return static_cast<std::size_t>(iy * SK_MAP_CELLS + ix); }
  Anew learned_anew(std::int32_t iy, std::int32_t ix) const { return learned_anew_[cell_number(iy, ix)]; }
  void watch_region(const berm_parameters& parameters, bool lanes_open);
  void note_learned_anew(std::int32_t x_low_mm, std::int32_t y_low_mm, std::int32_t x_high_mm, std::int32_t y_high_mm, Anew why);
  // With histograms: sk_histogram_known of the others, where this one may have to ask. Where cells are learned anew while somebody may be about one sensor
  // may have learned him: there a lidar asks the scanners alone, for a truck's sake until it knows the cell well itself, and the scanners ask only of what
  // they have hardly seen, so that a lidar excuses nobody to them. A cell of a dig zone that none of them knows is taken to be as high as a slope may be in
  // it, by what was met of it and half a cell beside until it was settled.
  std::int32_t known_elsewhere(std::int32_t iy, std::int32_t ix, const Others& others) const;
  // Than a lidar's lines do: of a truck, past whose edges they lead to the ground beyond.
  bool scanners_know_better(std::int32_t iy, std::int32_t ix, const Others& others) const;
  // With histograms: the height of what is measured nearer to a cell than half a cell is one of its own too, while it is learning.
  void learn_beside(const sk_point& point);
  // Of a cell that is about to be settled, where it counts: in a dig zone.
  void note_met(std::int32_t iy, std::int32_t ix);

  sk_monitor_rules rules_{};
  sk_monitor monitor_;                           // the accumulated map's heights (leger-1998, section 3.2)
  std::vector<sk_monitor_histogram> histogram_;  // or a histogram per cell (4.2): one, or none; from the start, so that no cycle allocates
  std::vector<Anew> learned_anew_;               // of each cell, row by row
  std::vector<std::int32_t> met_beside_;         // so as well, of dig zones: sk_histogram_met when it was settled last; of a cell that was never, SK_NOBODY_KNOWS
  sk_monitor_cell where_{-1, -1};
  std::int64_t newest_us_ = -1;
};

}  // namespace berm::kernel
