#include "geometry/separation.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "geometry/lanes.hpp"

namespace berm::kernel {
namespace {

// Column of a cell, or of one without a top.
struct Column {
  int32_t x, y; // low corner
  int32_t top; // 0 where it has none
  bool has_top;
};

class PlaneSearch {
public:
  PlaneSearch(sk_slice& slice, const PlaneCandidates& candidates) noexcept : slice_(slice), candidates_(candidates) {}

  // Index of a plane of the slice that has the column's square up to its top below it; 0 where there is none. Upright planes only where the column
  // has no top.
  int find(const Column& column) noexcept {
    if (last_ > 0 && near_.separates(column)) return last_; // neighbours mostly want the same plane
    for (int i = 1; i < slice_.planes; ++i)
      if (i != last_ && separates(i, column)) return take(i);
    return from_candidates(column);
  }

  // The cells of a row after ix, up to the last, that are not lower than z_low and want the plane found for ix: written to chosen. Returns the last of them.
  int32_t extend(const int32_t* top, int32_t ix, int32_t last, const Column& from, int32_t z_low, uint8_t* chosen) const noexcept {
    const Near near = near_;
    const uint8_t plane = static_cast<uint8_t>(last_);
    int64_t beside = near.nx * from.x + near.ny * from.y;
    for (; ix < last; ++ix) {
      beside += near.nx * SK_CELL_MM;
      const int64_t next = top[ix + 1];
      if (next < z_low || next > SK_COORD_MAX_MM || beside + near.nz * next > near.most) break;
      chosen[ix + 1] = plane;
    }
    return ix;
  }

private:
  // A plane as it is held against a column's low corner: for the corner farthest along its normal.
  struct Near {
    int64_t nx = 0, ny = 0, nz = 0, most = 0;

    Near() noexcept = default;
    explicit Near(const sk_plane& plane) noexcept
        : nx(plane.nx), ny(plane.ny), nz(plane.nz), most(plane.d - (std::max(nx, int64_t{0}) + std::max(ny, int64_t{0})) * SK_CELL_MM) {}

    bool separates(const Column& column) const noexcept { return nx * column.x + ny * column.y + nz * column.top <= most && (column.has_top || nz == 0); }
  };

  bool separates(int index, const Column& column) noexcept {
    const sk_plane& plane = slice_.plane[index];
    if (plane.nz < 0 || (plane.nz != 0 && !column.has_top)) return false;
    if (index >= proven_ && !holds(index)) return false;
    return Near(plane).separates(column);
  }

  int take(int index) noexcept {
    near_ = Near(slice_.plane[index]);
    return last_ = index;
  }

  // A plane that the slice came with may be wrong.
  bool holds(int index) noexcept {
    const sk_plane& plane = slice_.plane[index];
    const bool right = plane.d <= plane_offset(slice_, plane.nx, plane.ny, plane.nz);
    if (right && index == proven_) ++proven_;
    return right;
  }

  int from_candidates(const Column& column) noexcept {
    constexpr float unsure_mm = 4.0F; // rounding of vertices and normals
    if (!weighed_) weigh();
    const int use = column.has_top ? candidates_.count : std::min(candidates_.count, candidates_.upright);
    if (use == 0) return 0;
    alignas(16) float margin[plane_candidates];
    const Four x = four(static_cast<float>(column.x)), y = four(static_cast<float>(column.y)), z = four(column.has_top ? static_cast<float>(column.top) : 0.0F);
    for (int i = 0; i < use; i += 4) store4(margin + i, load4(bias_ + i) - load4(nx_ + i) * x - load4(ny_ + i) * y - load4(nz_ + i) * z);
    for (;;) {
      Four most = load4(margin);
      for (int i = 4; i < use; i += 4) most = most4(most, load4(margin + i)); // those beyond use are as low as can be
      const float highest = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
      if (highest < -unsure_mm * static_cast<float>(normal_scale)) return 0;
      int best = 0;
      while (margin[best] != highest) ++best;
      margin[best] = -1e30F;
      if (tried_[best] || slice_.planes >= SK_SLICE_PLANES) continue; // then it is among the slice's, and does not separate
      tried_[best] = true;
      const int index = slice_.planes;
      const int32_t nx = candidates_.nx[best], ny = candidates_.ny[best], nz = candidates_.nz[best];
      slice_.plane[index] = {nx, ny, nz, plane_offset(slice_, nx, ny, nz)};
      ++slice_.planes;
      if (proven_ == index) ++proven_;
      if (separates(index, column)) return take(index);
    }
  }

  // What is left of a candidate's offset when the extent of a cell along its normal is taken off.
  void weigh() noexcept {
    constexpr float cell = static_cast<float>(SK_CELL_MM);
    const Four nothing = four(0.0F);
    for (int i = 0; i < plane_candidates; i += 4) {
      const FourInt place = FourInt{0, 1, 2, 3} + i, in_use = place < candidates_.count;
      const Four nx = __builtin_convertvector(load4(candidates_.nx + i) & in_use, Four), ny = __builtin_convertvector(load4(candidates_.ny + i) & in_use, Four);
      store4(nx_ + i, nx);
      store4(ny_ + i, ny);
      store4(nz_ + i, __builtin_convertvector(load4(candidates_.nz + i) & in_use, Four));
      store4(bias_ + i, in_use ? load4(candidates_.offset + i) - four(cell) * (most4(nx, nothing) + most4(ny, nothing)) : four(-1e30F));
    }
    for (bool& t : tried_) t = false;
    weighed_ = true;
  }

  sk_slice& slice_;
  const PlaneCandidates& candidates_;
  int last_ = 0;
  Near near_; // of the last
  int proven_ = 1; // planes below this index hold; the level one is not asked for here
  bool weighed_ = false;
  alignas(16) float nx_[plane_candidates], ny_[plane_candidates], nz_[plane_candidates], bias_[plane_candidates];
  bool tried_[plane_candidates];
};

// Cells that the rules except for this slice.
class Exceptions {
public:
  Exceptions(const sk_slice& slice, int32_t z_low_mm, const sk_clearance_rules& rules) noexcept
      : over_body_(slice.link <= 1), radius_squared_(static_cast<int64_t>(rules.own_body_radius_mm) * rules.own_body_radius_mm) {
    const int32_t zones = rules.dig_allowed && slice.link != 0 ? std::clamp(rules.dig_zones, 0, BERM_DIG_ZONES) : 0;
    for (int32_t i = 0; i < zones; ++i)
      if (z_low_mm >= rules.dig_zone[i].floor_mm) zone_[zones_++] = rules.dig_zone[i];
  }

  bool own_body(int32_t x, int32_t y) const noexcept {
    const int64_t far_x = std::max(std::abs(x), std::abs(x + SK_CELL_MM)), far_y = std::max(std::abs(y), std::abs(y + SK_CELL_MM));
    return far_x * far_x + far_y * far_y <= radius_squared_;
  }

  bool over_body() const noexcept { return over_body_; }
  bool any_zone() const noexcept { return zones_ > 0; }

  bool dig_zone(int32_t x, int32_t y, int32_t top) const noexcept {
    for (int i = 0; i < zones_; ++i)
      if (top <= zone_[i].ceiling_mm && x >= zone_[i].x_low_mm && x + SK_CELL_MM <= zone_[i].x_high_mm && y >= zone_[i].y_low_mm && y + SK_CELL_MM <= zone_[i].y_high_mm) return true;
    return false;
  }

private:
  bool over_body_; // tail and boom
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

// The column of a current cell as high as it stands, whether it may be passed over or not.
Column standing(const sk_height_map& map, const sk_clearance_rules& rules, int32_t x, int32_t y, int32_t iy, int32_t ix) noexcept {
  const int64_t top = sk_column_top_mm(&map, &rules, iy, ix);
  return {x, y, static_cast<int32_t>(std::clamp<int64_t>(top, -SK_COORD_MAX_MM, SK_COORD_MAX_MM)), true};
}

// The first from ix on that is not lower than z, or one beyond the last; nearly all are lower.
int32_t next_high(const int32_t* row, int32_t ix, int32_t last, int32_t z) noexcept {
  if (ix <= last && row[ix] >= z) return ix; // high ones stand together
  const FourInt bound = {z, z, z, z};
  for (; ix + 3 <= last; ix += 4)
    if (any4(load4(row + ix) >= bound)) break;
  while (ix <= last && row[ix] < z) ++ix;
  return ix;
}

// Few at a time: a call costs more than that. Where words are written the last overlaps those before.
void clear_bytes(uint8_t* to, std::size_t count) noexcept {
  constexpr uint64_t none = 0;
  constexpr std::size_t word = sizeof none, half = word / 2;
  if (count >= 4 * word) {
    std::memset(to, 0, count);
  } else if (count >= word) {
    for (std::size_t i = 0; i + word < count; i += word) std::memcpy(to + i, &none, word);
    std::memcpy(to + count - word, &none, word);
  } else if (count >= half) {
    std::memcpy(to, &none, half);
    std::memcpy(to + count - half, &none, half);
  } else if (count > 0) {
    to[0] = to[count / 2] = to[count - 1] = 0;
  }
}

} // namespace

bool choose_planes(const sk_height_map& map, const sk_columns& columns, const sk_clearance_rules& rules, const PlaneCandidates& candidates, sk_slice& slice,
                   sk_choice& choice) noexcept {
  if (!planes_in_range(slice)) return false;
  sk_footprint footprint;
  if (!sk_slice_footprint(&slice, &footprint)) return false;
  const sk_rectangle& cells = footprint.cells;
  const std::size_t row_cells = static_cast<std::size_t>(cells.ix_high - cells.ix_low + 1);
  for (int32_t iy = cells.iy_low; iy <= cells.iy_high; ++iy) clear_bytes(&choice.plane_of[iy][cells.ix_low], row_cells);

  const Exceptions exceptions(slice, footprint.z_low_mm, rules);
  PlaneSearch search(slice, candidates);
  const bool bodied = rules.own_body_radius_mm > 0;
  const int32_t z_low = footprint.z_low_mm;
  for (int32_t iy = cells.iy_low; iy <= cells.iy_high; ++iy) {
    const int32_t y = SK_MAP_ORIGIN_MM + iy * SK_CELL_MM;
    const int32_t* row = columns.top_mm[iy];
    for (int32_t ix = cells.ix_low; ix <= cells.ix_high; ++ix) {
      if (!bodied) ix = next_high(row, ix, cells.ix_high, z_low);
      if (ix > cells.ix_high) break;
      const int32_t top = row[ix];
      const int32_t x = SK_MAP_ORIGIN_MM + ix * SK_CELL_MM;
      bool own = false;
      if (bodied) {
        own = exceptions.own_body(x, y);
        if (own ? exceptions.over_body() : top < z_low) continue;
      }
      const bool current = top != SK_NO_TOP || sk_is_current(&map, &rules, iy, ix);  // one that is too high to be passed over has no top either
      if (exceptions.any_zone() && (current || (rules.dig_stale && map.seen_us[iy][ix] >= 0)) && exceptions.dig_zone(x, y, sk_map_top(&map, iy, ix))) continue;
      const bool has_top = !own && top <= SK_COORD_MAX_MM;
      const Column column = {x, y, has_top ? std::max(top, -SK_COORD_MAX_MM) : 0, has_top};
      const int plane = search.find(column);
      if (plane == 0) {
        // Blocked; a plane over it, where it is merely too high to be passed over, lets the core say so.
        const bool too_high = !own && !has_top && current;
        if (too_high) choice.plane_of[iy][ix] = static_cast<uint8_t>(search.find(standing(map, rules, x, y, iy, ix)));
        return false;
      }
      choice.plane_of[iy][ix] = static_cast<uint8_t>(plane);
      if (!bodied && !exceptions.any_zone()) ix = search.extend(row, ix, cells.ix_high, column, z_low, choice.plane_of[iy]);
    }
  }
  return true;
}

bool choose_planes(const sk_height_map& map, const sk_columns& columns, const sk_clearance_rules& rules, SliceSet& set, int i, sk_choice& choice) noexcept {
  PlaneCandidates candidates;
  plane_candidates_of(set, i, candidates);
  return choose_planes(map, columns, rules, candidates, set.slice[i], choice);
}

sk_clearance_result clear_slice(const sk_height_map& map, const sk_columns& columns, const sk_clearance_rules& rules, SliceSet& set, int i, sk_choice& choice) noexcept {
  sk_clearance_result result{SK_CLEAR, -1, -1, 0};
  if (sk_clear_level(&map, &columns, &set.slice[i], &rules)) return result;
  choose_planes(map, columns, rules, set, i, choice);
  sk_clear_slice(&map, &set.slice[i], &choice, &rules, &result);
  return result;
}

} // namespace berm::kernel
