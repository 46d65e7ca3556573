// The Workspace Monitor in the kernel's cycle (SG-6): the scanners' returns into its maps, the trucks' lanes, and whether the machine must stand.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "core/workspace_monitor.h"
#include "io/scan_intake.hpp"

namespace berm::kernel {

class WorkspaceWatch {
 public:
  explicit WorkspaceWatch(const berm_parameters& parameters);

  // What is seen from now on is what later heights are compared with: the base stands, and nobody is in the region.
  void begin();
  // Every return of the panning scanners that is in the height map too, and between two that follow one another on a scanline what the line from the
  // one to the other passes over (leger-1998, section 3.1; it counts in EMPTY cells only).
  void take(const ScanBlocks& blocks, std::int64_t now_us);
  // Once a cycle. With no fresh word of the spotter the lanes stay as they were. A truck that has parked is learned with its lane; until it leaves the
  // lane is watched.
  void trucks(bool spotter_fresh, bool parked);
  // Once a cycle, after them: whether somebody came into the region, and has not left it for long enough. False where nobody watches it.
  bool step(std::int64_t now_us);

  bool watched() const { return parameters_.workspace_watched != 0; }
  // Of the newest step: a cell with somebody in it, its centre and what is seen there; false when there is none (any more).
  bool place(std::int32_t& x_mm, std::int32_t& y_mm, std::int32_t& height_mm) const;
  const sk_monitor& monitor() const { return monitor_; }
  const sk_monitor_rules& rules() const { return rules_; }

 private:
  static constexpr std::int64_t kStepsMost = 250;  // across the whole map

  struct Last {  // return of a scanner
    std::uint32_t scanline = 0;
    std::int32_t index = -2;
    sk_point point{};
  };
  void insert(const sk_point& point, bool interpolated, std::int64_t now_us);
  void interpolate(const sk_point& from, const sk_point& to, std::int64_t now_us);

  const berm_parameters& parameters_;
  sk_monitor_rules rules_{};
  sk_monitor monitor_;
  sk_monitor_cell where_{-1, -1};
  Last last_[BERM_SCANNERS];
  bool lanes_open_ = true;
};

}  // namespace berm::kernel
