// The Workspace Monitor in the kernel's cycle (SG-6): the scanners' returns into its maps, the trucks' lanes, and whether the machine must stand.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "core/workspace_monitor.h"
#include "geometry/joint_history.hpp"
#include "io/scan_intake.hpp"
#include "io/space_watch.hpp"

namespace berm::kernel {

class WorkspaceWatch {
 public:
  explicit WorkspaceWatch(const berm_parameters& parameters);

  // What is seen from now on is what later heights are compared with: the base stands, and nobody is in the region. For workspace_learn_us after the
  // next step it is learned: what changes then is ground, and so is what is seen in free space.
  void begin();
  // Every return of the panning scanners that is in the height map too, and between two that follow one another on a scanline what the line from the
  // one to the other passes over (leger-1998, section 3.1; it counts in EMPTY cells only).
  // Their rays tell of free space; the swing at the block's time places the scanner.
  void take(const ScanBlocks& blocks, const JointHistory& joints, std::int64_t now_us);
  // Once a cycle. With no fresh word of the spotter the lanes stay as they were. A truck that has parked is learned with its lane; until it leaves the
  // lane is watched.
  void trucks(bool spotter_fresh, bool parked, std::int64_t now_us);
  // Once a cycle, after them: whether somebody came into the region, and has not left it for long enough. False where nobody watches it.
  bool step(std::int64_t now_us);

  bool watched() const { return parameters_.workspace_watched != 0; }
  // Of the newest step: a cell with somebody in it, its centre and what is seen there; false when there is none (any more).
  bool place(std::int32_t& x_mm, std::int32_t& y_mm, std::int32_t& height_mm) const;
  const sk_monitor& monitor() const { return monitor_; }
  const SpaceWatch& space() const { return space_; }
  const sk_monitor_rules& rules() const { return rules_; }

 private:
  static constexpr std::int64_t kStepsMost = 250;  // across the whole map
  static constexpr std::int64_t kNotLearning = -1;

  struct Last {  // return of a scanner
    std::uint32_t scanline = 0;
    std::int32_t index = -2;
    sk_point point{};
  };
  sk_point head(int scanner, std::int64_t time_us, const JointHistory& joints) const;
  bool learning(const sk_point& point) const;
  void end_learning(std::int64_t now_us);
  bool intruder(std::int64_t now_us);
  void insert(const sk_point& point, bool interpolated, std::int64_t now_us);
  void interpolate(const sk_point& from, const sk_point& to, std::int64_t now_us);

  const berm_parameters& parameters_;
  sk_monitor_rules rules_{};
  sk_monitor monitor_;
  SpaceWatch space_;
  sk_monitor_cell where_{-1, -1};
  bool in_space_ = false;                       // where_ is of free space
  std::int64_t in_space_us_ = -1;               // when somebody was last in it; -1 never
  bool begun_ = false;
  std::int64_t learned_us_ = kNotLearning;      // when the whole region's ground will have been learned
  std::int64_t lane_learned_us_ = kNotLearning; // the same of the lanes
  Last last_[BERM_SCANNERS];
  bool lanes_open_ = true;
};

}  // namespace berm::kernel
