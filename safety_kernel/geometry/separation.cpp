#include "geometry/separation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <algorithm>
#include <cstring>

namespace berm::kernel {
namespace {

using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Exact::Point_3;

struct Bounds {
  int32_t low[3], high[3];
};

Bounds bounds_of(const sk_slice& slice) noexcept {
  Bounds b{{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
  for (int i = 0; i < slice.vertices; ++i)
    for (int k = 0; k < 3; ++k) {
      b.low[k] = std::min(b.low[k], slice.vertex_mm[i][k]);
      b.high[k] = std::max(b.high[k], slice.vertex_mm[i][k]);
    }
  return b;
}

// A plane through the slice's vertex nearest to it, spanned by three integer points in the orientation of the normal.
struct Support {
  Point p, q, r;
  bool valid = false;
};

Support support_of(const sk_slice& slice, const sk_plane& plane) noexcept {
  for (int i = 0; i < slice.vertices; ++i) {
    const int32_t* v = slice.vertex_mm[i];
    const int64_t product = static_cast<int64_t>(plane.nx) * v[0] + static_cast<int64_t>(plane.ny) * v[1] + static_cast<int64_t>(plane.nz) * v[2];
    if (product != plane.d + 1) continue;
    const Point p(v[0], v[1], v[2]);
    // (q - p) x (r - p) is a positive multiple of the normal
    if (plane.nz > 0) return {p, Point(v[0] + plane.nz, v[1], v[2] - plane.nx), Point(v[0], v[1] + plane.nz, v[2] - plane.ny), true};
    if (plane.nz == 0) return {p, Point(v[0] - plane.ny, v[1] + plane.nx, v[2]), Point(v[0], v[1], v[2] + 1), true};
    return {};
  }
  return {};
}

class PlaneSearch {
public:
  PlaneSearch(const sk_slice& slice) noexcept : slice_(slice) {}

  // Index of a plane that has the column's square (low corner x, y) up to top below it; 0 where there is none. Upright planes only
  // where the column has no top.
  int find(int32_t x, int32_t y, int32_t top, bool has_top) noexcept {
    if (last_ > 0 && separates(last_, x, y, top, has_top)) return last_; // neighbours mostly want the same plane
    for (int i = 1; i < slice_.planes; ++i)
      if (i != last_ && separates(i, x, y, top, has_top)) return last_ = i;
    return 0;
  }

private:
  bool separates(int index, int32_t x, int32_t y, int32_t top, bool has_top) noexcept {
    const sk_plane& plane = slice_.plane[index];
    if (plane.nz != 0 && !has_top) return false;
    if (!known_[index]) {
      support_[index] = support_of(slice_, plane);
      known_[index] = true;
    }
    const Support& s = support_[index];
    if (!s.valid) return false;
    const Point corner(x + (plane.nx > 0 ? SK_CELL_MM : 0), y + (plane.ny > 0 ? SK_CELL_MM : 0), has_top ? top : 0); // the one farthest along the normal
    return CGAL::orientation(s.p, s.q, s.r, corner) == CGAL::NEGATIVE;
  }

  const sk_slice& slice_;
  Support support_[SK_SLICE_PLANES];
  bool known_[SK_SLICE_PLANES] = {};
  int last_ = 0;
};

// Cells that the rules except for this slice.
class Exceptions {
public:
  Exceptions(const sk_slice& slice, const Bounds& bounds, const sk_clearance_rules& rules) noexcept
      : boom_(slice.link == 1), radius_squared_(static_cast<int64_t>(rules.own_body_radius_mm) * rules.own_body_radius_mm) {
    const int32_t zones = rules.dig_allowed ? std::clamp(rules.dig_zones, 0, BERM_DIG_ZONES) : 0;
    for (int32_t i = 0; i < zones; ++i)
      if (bounds.low[2] >= rules.dig_zone[i].floor_mm) zone_[zones_++] = rules.dig_zone[i];
  }

  bool own_body(int32_t x, int32_t y) const noexcept {
    const int64_t far_x = std::max(std::abs(x), std::abs(x + SK_CELL_MM)), far_y = std::max(std::abs(y), std::abs(y + SK_CELL_MM));
    return far_x * far_x + far_y * far_y <= radius_squared_;
  }

  bool boom() const noexcept { return boom_; }

  bool dig_zone(int32_t x, int32_t y, int32_t top) const noexcept {
    for (int i = 0; i < zones_; ++i)
      if (top <= zone_[i].ceiling_mm && x >= zone_[i].x_low_mm && x + SK_CELL_MM <= zone_[i].x_high_mm && y >= zone_[i].y_low_mm && y + SK_CELL_MM <= zone_[i].y_high_mm) return true;
    return false;
  }

private:
  bool boom_;
  int64_t radius_squared_;
  int zones_ = 0;
  berm_dig_zone zone_[BERM_DIG_ZONES];
};

bool planes_in_range(const sk_slice& slice) noexcept {
  if (slice.planes < 1 || slice.planes > SK_SLICE_PLANES) return false;
  for (int i = 0; i < slice.planes; ++i)
    for (const int32_t component : {slice.plane[i].nx, slice.plane[i].ny, slice.plane[i].nz})
      if (component < -SK_NORMAL_MAX || component > SK_NORMAL_MAX) return false;
  return true;
}

} // namespace

bool choose_planes(const sk_height_map& map, const sk_slice& slice, const sk_clearance_rules& rules, sk_choice& choice) noexcept {
  if (!planes_in_range(slice)) return false;
  sk_rectangle cells;
  if (!sk_slice_rectangle(&slice, &cells)) return false;
  const Bounds bounds = bounds_of(slice);
  const std::size_t row_cells = static_cast<std::size_t>(cells.ix_high - cells.ix_low + 1);
  for (int32_t iy = cells.iy_low; iy <= cells.iy_high; ++iy) std::memset(&choice.plane_of[iy][cells.ix_low], 0, row_cells);

  const Exceptions exceptions(slice, bounds, rules);
  PlaneSearch search(slice);
  const int64_t oldest_us = std::max<int64_t>(0, rules.now_us - rules.fresh_us);
  const int64_t under = slice.plane[0].nx == 0 && slice.plane[0].ny == 0 && slice.plane[0].nz == 1 ? slice.plane[0].d : INT64_MIN;

  const int32_t body = rules.own_body_radius_mm;
  const bool over_body = bounds.low[0] < body && bounds.high[0] > -body && bounds.low[1] < body && bounds.high[1] > -body;
  for (int32_t iy = cells.iy_low; iy <= cells.iy_high; ++iy) {
    const int32_t y = SK_MAP_ORIGIN_MM + iy * SK_CELL_MM;
    for (int32_t ix = cells.ix_low; ix <= cells.ix_high; ++ix) {
      const int64_t top = static_cast<int64_t>(std::max(map.height_mm[iy][ix], map.previous_mm[iy][ix])) + rules.margin_mm;
      const int64_t seen_us = map.seen_us[iy][ix];
      const bool observed = seen_us >= oldest_us && seen_us <= rules.now_us;
      const int32_t x = SK_MAP_ORIGIN_MM + ix * SK_CELL_MM;
      const bool own = over_body && exceptions.own_body(x, y);
      if (observed && !own && top <= under) continue; // nearly always
      if (own && exceptions.boom()) continue;
      if ((observed || (rules.dig_stale && seen_us >= 0)) && exceptions.dig_zone(x, y, static_cast<int32_t>(top - rules.margin_mm))) continue;
      const bool has_top = observed && !own && top <= SK_COORD_MAX_MM;
      const int plane = search.find(x, y, has_top ? static_cast<int32_t>(std::max<int64_t>(top, -SK_COORD_MAX_MM)) : 0, has_top);
      if (plane == 0) return false;
      choice.plane_of[iy][ix] = static_cast<uint8_t>(plane);
    }
  }
  return true;
}

} // namespace berm::kernel
