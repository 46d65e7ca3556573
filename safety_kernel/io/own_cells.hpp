// The machine's own cells in the map.
//
// The self filter drops every return nearer the swing axis than the own body's radius, so these cells are never observed, nor reliably are
// those that the circle only touches (the rim); and the boom is always over some of them. Therefore:
//   for the boom, cells within the radius and a cell's diagonal are the machine's own: nothing to check (core/clearance.h);
//   for stick and bucket, a cell wholly inside the circle is a column without end: passed at the side, never over;
//   a cell of the rim is as high as the own body may be, and higher where something higher was seen; up to that height it may be passed over.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "core/clearance_rules.h"
#include "core/height_map.h"

namespace berm::kernel {

// Own body and rim lie wholly nearer the swing axis than this.
constexpr std::int32_t kCellDiagonalMm = SK_CELL_MM * 1415 / 1000 + 1;
constexpr std::int32_t own_and_rim_radius_mm(const berm_parameters& parameters) { return parameters.own_body_radius_mm + kCellDiagonalMm; }

class OwnCells {
 public:
  explicit OwnCells(const berm_parameters& parameters);
  // Keeps these cells at their heights at least, and fresh. Once a cycle.
  void stamp(sk_height_map& map, std::int64_t now_us, std::int32_t generation_us) const;
  // The overpass rule does not take the own body for a person: these cells may be passed over at the heights they are kept at.
  void permit(sk_clearance_rules& rules) const;

 private:
  struct Cell {
    std::int32_t iy, ix, height_mm;
  };
  static constexpr int kSide = 2 * (6000 / SK_CELL_MM + 2);  // the parameter check lets pass a radius of 6 m
  Cell cell_[kSide * kSide];
  int count_ = 0;
};

}  // namespace berm::kernel
