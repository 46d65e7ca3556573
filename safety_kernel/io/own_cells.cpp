#include "io/own_cells.hpp"

#include <algorithm>
#include <cstdlib>

#include "geometry/self_filter.hpp"

namespace berm::kernel {

namespace {

constexpr auto kBodyTopMm = static_cast<std::int32_t>(SelfFilter::body_height_m * 1e3);

struct Span {
  std::int64_t near, far;  // of a cell's side from the axis
};

Span span_of(std::int32_t index) {
  const std::int64_t low = SK_MAP_ORIGIN_MM + static_cast<std::int64_t>(index) * SK_CELL_MM;
  const std::int64_t high = low + SK_CELL_MM;
  const bool across = low < 0 && high > 0;
  return {across ? 0 : std::min(std::llabs(low), std::llabs(high)), std::max(std::llabs(low), std::llabs(high))};
}

}  // namespace

OwnCells::OwnCells(const berm_parameters& parameters) {
  const std::int64_t radius_squared = static_cast<std::int64_t>(parameters.own_body_radius_mm) * parameters.own_body_radius_mm;
  for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy) {
    for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) {
      const Span x = span_of(ix), y = span_of(iy);
      if (x.near * x.near + y.near * y.near >= radius_squared) continue;
      const bool inside = x.far * x.far + y.far * y.far <= radius_squared;
      cell_[count_++] = {iy, ix, inside ? SK_HEIGHT_MAX_MM : kBodyTopMm};
    }
  }
}

void OwnCells::stamp(sk_height_map& map, std::int64_t now_us, std::int32_t generation_us) const {
  for (int i = 0; i < count_; ++i) sk_map_insert(&map, cell_[i].iy, cell_[i].ix, cell_[i].height_mm, now_us, generation_us);
}

void OwnCells::permit(sk_clearance_rules& rules) const {
  for (int i = 0; i < count_; ++i) {
    std::int16_t& limit_mm = rules.pass_mm[cell_[i].iy][cell_[i].ix];
    limit_mm = static_cast<std::int16_t>(std::max<std::int32_t>(limit_mm, cell_[i].height_mm));
  }
}

}  // namespace berm::kernel
