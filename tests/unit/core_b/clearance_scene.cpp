#include "clearance_scene.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "map_cells.hpp"
#include "pass_over.hpp"

namespace berm::core_test {
namespace {

__extension__ using Wide = __int128;

constexpr std::int64_t kFarAway = std::int64_t{1} << 60;  // stands for the depth, and the height, of a column without end

// 0 nothing, 1 in a zone but too low, 2 exempt.
int dig_rule(const sk_height_map& map, const sk_slice& slice, const sk_clearance_rules& rules, int iy, int ix) {
  if (!rules.dig_allowed || slice.link == 0) return 0;
  int found = 0;
  for (int z = 0; z < rules.dig_zones; ++z) {
    const berm_dig_zone& zone = rules.dig_zone[z];
    if (zone.x_low_mm > low_of_cell_mm(ix) || zone.x_high_mm < low_of_cell_mm(ix + 1)) continue;
    if (zone.y_low_mm > low_of_cell_mm(iy) || zone.y_high_mm < low_of_cell_mm(iy + 1)) continue;
    const bool above = std::all_of(slice.xyz_mm[2], slice.xyz_mm[2] + slice.vertices, [&](std::int32_t z_mm) { return z_mm >= zone.floor_mm; });
    const bool known = current(map, rules, iy, ix) || (rules.dig_stale && map.seen_us[iy][ix] != -1);
    const bool soil = known && map.height_mm[iy][ix] <= zone.ceiling_mm && map.previous_mm[iy][ix] <= zone.ceiling_mm;
    if (!above) found = std::max(found, 1);
    else if (soil) found = 2;
  }
  return found;
}

// Whether a plane separates the slice from a column that ends at this height, or never.
bool apart(const sk_slice& slice, int plane, std::int64_t top, int iy, int ix) {
  if (plane < 0 || plane >= slice.planes) return false;
  const sk_plane& p = slice.plane[plane];
  const auto side = [&](std::int64_t x, std::int64_t y, std::int64_t z) { return Wide{p.nx} * x + Wide{p.ny} * y + Wide{p.nz} * z; };
  for (int i = 0; i < slice.vertices; ++i)
    if (side(slice.xyz_mm[0][i], slice.xyz_mm[1][i], slice.xyz_mm[2][i]) <= p.d) return false;
  for (const std::int64_t x : {low_of_cell_mm(ix), low_of_cell_mm(ix + 1)})
    for (const std::int64_t y : {low_of_cell_mm(iy), low_of_cell_mm(iy + 1)})
      for (const std::int64_t z : {-kFarAway, top})
        if (side(x, y, z) > p.d) return false;
  return true;
}

std::int64_t top_of(const sk_height_map& map, int iy, int ix) { return std::max(map.height_mm[iy][ix], map.previous_mm[iy][ix]); }

// Apart from a column that is too high to be passed over, were it not for that.
bool over(const sk_height_map& map, const sk_slice& slice, const sk_clearance_rules& rules, int plane, int iy, int ix) {
  return top_of(map, iy, ix) > rules.pass_mm[iy][ix] && apart(slice, plane, top_of(map, iy, ix) + rules.margin_mm, iy, ix);
}

std::int32_t judge_cell(const sk_height_map& map, const sk_slice& slice, int plane, const sk_clearance_rules& rules, int iy, int ix) {
  if (own_body(rules, iy, ix)) return slice.link <= 1 ? SK_CLEAR : SK_BLOCKED_UNKNOWN;
  if (separates(map, slice, rules, plane, iy, ix)) return SK_CLEAR;
  const int dig = dig_rule(map, slice, rules, iy, ix);
  if (dig != 0) return dig == 2 ? SK_CLEAR : SK_BLOCKED_FLOOR;
  if (map.seen_us[iy][ix] < 0) return SK_BLOCKED_UNKNOWN;
  if (!current(map, rules, iy, ix)) return SK_BLOCKED_STALE;
  return over(map, slice, rules, plane, iy, ix) ? SK_BLOCKED_OVERPASS : SK_BLOCKED_COLLISION;
}

bool within(std::int64_t v, std::int64_t low, std::int64_t high) { return low <= v && v <= high; }

bool well_formed(const sk_slice& slice, const sk_clearance_rules& rules) {
  if (!within(slice.link, 0, 3) || !within(slice.vertices, 1, 24) || !within(slice.planes, 1, 24)) return false;
  for (int i = 0; i < slice.vertices; ++i)
    for (const auto& axis : slice.xyz_mm)
      if (!within(axis[i], -32000, 32000)) return false;
  for (int k = 0; k < slice.planes; ++k) {
    const sk_plane& p = slice.plane[k];
    for (const std::int32_t n : {p.nx, p.ny, p.nz})
      if (!within(n, -1048576, 1048576)) return false;
    if (!within(p.d, -9007199254740992, 9007199254740992)) return false;
  }
  return rules.now_us >= 0 && rules.fresh_us >= 0 && within(rules.margin_mm, 0, 32000) && within(rules.own_body_radius_mm, 0, 32000) &&
         within(rules.dig_zones, 0, BERM_DIG_ZONES);
}

// Cells along an axis whose closed interval meets the extent of the vertices.
std::vector<int> cells_under(const sk_slice& slice, int axis) {
  const auto [low, high] = std::minmax_element(slice.xyz_mm[axis], slice.xyz_mm[axis] + slice.vertices);
  std::vector<int> cells;
  for (int i = -60; i <= 163; ++i)
    if (low_of_cell_mm(i) <= *high && *low <= low_of_cell_mm(i + 1)) cells.push_back(i);
  return cells;
}

}  // namespace

bool current(const sk_height_map& map, const sk_clearance_rules& rules, int iy, int ix) {
  const std::int64_t seen = map.seen_us[iy][ix];
  return seen != -1 && seen >= 0 && rules.now_us - seen >= 0 && rules.now_us - seen <= rules.fresh_us;
}

bool own_body(const sk_clearance_rules& rules, int iy, int ix) {
  for (const std::int64_t x : {low_of_cell_mm(ix), low_of_cell_mm(ix + 1)})
    for (const std::int64_t y : {low_of_cell_mm(iy), low_of_cell_mm(iy + 1)})
      if (x * x + y * y > std::int64_t{rules.own_body_radius_mm} * rules.own_body_radius_mm) return false;
  return true;
}

bool may_be_dug(const sk_height_map& map, const sk_slice& slice, const sk_clearance_rules& rules, int iy, int ix) {
  return dig_rule(map, slice, rules, iy, ix) == 2;
}

sk_slice block_slice(std::int32_t link, const Block& b) {
  sk_slice s{};
  s.link = link;
  for (const std::int32_t x : {b.x_low, b.x_high})
    for (const std::int32_t y : {b.y_low, b.y_high})
      for (const std::int32_t z : {b.z_low, b.z_high}) {
        const int v = s.vertices++;
        s.xyz_mm[0][v] = x;
        s.xyz_mm[1][v] = y;
        s.xyz_mm[2][v] = z;
      }
  s.plane[s.planes++] = {0, 0, 1, b.z_low - 1};
  s.plane[s.planes++] = {1, 0, 0, b.x_low - 1};
  s.plane[s.planes++] = {-1, 0, 0, -b.x_high - 1};
  s.plane[s.planes++] = {0, 1, 0, b.y_low - 1};
  s.plane[s.planes++] = {0, -1, 0, -b.y_high - 1};
  s.plane[s.planes++] = {1, 0, 1, b.x_low + b.z_low - 1};
  return s;
}

sk_clearance_rules scene_rules() {
  sk_clearance_rules r{};
  r.now_us = kSceneNow;
  r.fresh_us = kSceneFresh;
  r.margin_mm = 300;
  test::pass_over(r);
  return r;
}

void level(sk_height_map& map, std::int32_t height_mm) {
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) put(map, iy, ix, {height_mm, height_mm, kSceneNow, kSceneNow});
}

void choose(sk_choice& choice, int plane) { std::memset(choice.plane_of, plane, sizeof choice.plane_of); }

bool separates(const sk_height_map& map, const sk_slice& slice, const sk_clearance_rules& rules, int plane, int iy, int ix) {
  const bool topped = current(map, rules, iy, ix) && top_of(map, iy, ix) <= rules.pass_mm[iy][ix];
  return apart(slice, plane, topped ? top_of(map, iy, ix) + rules.margin_mm : kFarAway, iy, ix);
}

sk_clearance_result judge(const sk_height_map& map, const sk_slice& slice, const sk_choice& choice, const sk_clearance_rules& rules) {
  if (!well_formed(slice, rules)) return {SK_BLOCKED_INVALID, -1, -1, 0};
  const std::vector<int> xs = cells_under(slice, 0), ys = cells_under(slice, 1);
  for (const std::vector<int>* cells : {&xs, &ys})
    if (!within(cells->front(), 0, 103) || !within(cells->back(), 0, 103)) return {SK_BLOCKED_UNKNOWN, -1, -1, 0};
  std::int32_t judged = 0;
  for (const int iy : ys)
    for (const int ix : xs) {
      ++judged;
      const std::int32_t verdict = judge_cell(map, slice, choice.plane_of[iy][ix], rules, iy, ix);
      if (verdict != SK_CLEAR) return {verdict, iy, ix, judged};
    }
  return {SK_CLEAR, -1, -1, judged};
}

bool same(const sk_clearance_result& a, const sk_clearance_result& b) {
  return a.verdict == b.verdict && a.iy == b.iy && a.ix == b.ix && a.cells == b.cells;
}

}  // namespace berm::core_test
