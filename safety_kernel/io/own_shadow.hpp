// What the machine's own implements hide from the scanners stays in the map.
//
// A beam that ends on the own machine says nothing of what lies behind it, or of what stands beside the implement and was taken for it. Ground that
// other beams find in the same cells, round the foot of what is hidden, must not lower them: the cells would forget what still stands there. Where
// another scanner has just seen the cell, and nothing of the machine was between, that scanner's word counts.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "core/height_map.h"
#include "core/scanline_raster.h"

namespace berm::kernel {

class OwnShadow {
 public:
  static constexpr int kLidar = BERM_SCANNER_MOUNTS;  // a viewer like the scanners; but its views are not noted, so its word counts nowhere
  static constexpr double kLowestMm = -8000.0;  // what lies deeper is out of all reach
  static constexpr double kGroundMm = 300.0;    // that a cell's ground may lie above its lowest return

  explicit OwnShadow(std::int32_t generation_us) : generation_us_(generation_us) {}

  // A return of the ground or a thing, that goes into the map.
  void note_view(int scanner, const sk_point& point, std::int64_t now_us);
  // An own return. From it on along its beam every cell of the map whose column the beam would have met carries its height on (sk_map_keep), unless
  // another scanner's word counts; up to where the beam goes under ground that this scanner has seen, for there it would have ended: returns at the
  // machine's feet are own ones too. head: the scanner's, base frame. Bounded: a cell is visited once.
  void keep(int scanner, const sk_point& head, const sk_point& own, std::int64_t now_us, sk_height_map& map);

 private:
  static constexpr int kViewers = BERM_SCANNER_MOUNTS + 1;
  static constexpr std::int64_t kNever = -(std::int64_t{1} << 60);
  struct View {
    std::int64_t seen_us = kNever, hidden_us = kNever;
    std::int32_t low_mm = 0;  // lowest return of its last sweep
  };
  bool clear(const View& view, std::int64_t now_us) const;
  bool buried(const View& view, double high_mm, std::int64_t now_us) const;

  std::int32_t generation_us_;
  View view_[kViewers][SK_MAP_CELLS][SK_MAP_CELLS];
};

}  // namespace berm::kernel
