// The machine's own cells, and the rim around them.
//
// The self filter drops every return nearer the swing axis than the own body's radius. Cells wholly inside that circle are the machine's own
// (core/clearance.h). Cells that the circle only touches, the rim, can stay unobserved for ever, and the boom is always over some of them:
//   for the boom they count as the machine's own as well;
//   for stick and bucket they are as high as the own body may be, and higher where something higher was seen.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "core/height_map.h"

namespace berm::kernel {

// Own body and rim lie wholly nearer the swing axis than this: radius and a cell's diagonal.
constexpr std::int32_t kCellDiagonalMm = SK_CELL_MM * 1415 / 1000 + 1;
constexpr std::int32_t own_and_rim_radius_mm(const berm_parameters& parameters) { return parameters.own_body_radius_mm + kCellDiagonalMm; }

class OwnRim {
 public:
  explicit OwnRim(const berm_parameters& parameters);
  // Keeps the rim's cells at the own body's height at least. Once a cycle.
  void stamp(sk_height_map& map, std::int64_t now_us, std::int32_t generation_us) const;
  int count() const { return count_; }

 private:
  struct Cell {
    std::int32_t iy, ix;
  };
  // A circle of radius r crosses at most 8 (r / cell + 1) cells; the parameter check lets pass 6 m.
  static constexpr int kCapacity = 8 * (6000 / SK_CELL_MM + 2);
  Cell cell_[kCapacity];
  int count_ = 0;
};

}  // namespace berm::kernel
