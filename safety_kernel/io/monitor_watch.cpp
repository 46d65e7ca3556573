#include "io/monitor_watch.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/monitor_forget.h"
#include "core/monitor_settle.h"
#include "io/along.hpp"

namespace berm::kernel {

namespace {

// Of what is learned: pan, swing and range carry a return so far past the edge of a thing (93 mm seen), a whole scanline with it. Wider, and a child
// beside a truck would stand in cells that know the truck alone.
constexpr std::int32_t kBesideMm = SK_CELL_MM / 2;

// A slope's upper edge in a cell lies so much, 1.05 m, over what was met half a cell beside it at the most (0.9 m seen).
constexpr std::int32_t kSlopeBins = 7;

}  // namespace

MonitorWatch::MonitorWatch(const berm_parameters& parameters, std::int32_t wait_us, std::int32_t period_us)
    : histogram_(parameters.workspace_histogram != 0 ? 1 : 0),
      learned_anew_(SK_MAP_CELLS * SK_MAP_CELLS, Anew::kNever),
      met_beside_(SK_MAP_CELLS * SK_MAP_CELLS, SK_NOBODY_KNOWS) {
  rules_.height_threshold_mm = parameters.workspace_rise_mm;
  rules_.neighbour_threshold_mm = parameters.workspace_neighbour_mm;
  rules_.slope_threshold_mm = parameters.workspace_slope_mm;
  rules_.wait_us = wait_us;
  rules_.period_us = period_us;
  rules_.dwell_us = parameters.workspace_dwell_us;
  rules_.continuous = parameters.workspace_follows != 0;
  watch_region(parameters, true);
  for (int i = 0; i < parameters.lanes; ++i)
    note_learned_anew(parameters.lane[i].x_low_mm, parameters.lane[i].y_low_mm, parameters.lane[i].x_high_mm, parameters.lane[i].y_high_mm, Anew::kForATruck);
  for (int i = 0; i < parameters.dig_zones; ++i)
    note_learned_anew(parameters.dig_zone[i].x_low_mm, parameters.dig_zone[i].y_low_mm, parameters.dig_zone[i].x_high_mm, parameters.dig_zone[i].y_high_mm, Anew::kAfterTheBucket);
  begin();
}

void MonitorWatch::note_learned_anew(std::int32_t x_low_mm, std::int32_t y_low_mm, std::int32_t x_high_mm, std::int32_t y_high_mm, Anew why) {
  for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix)
      if (sk_is_touched(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) learned_anew_[cell_number(iy, ix)] = why;
}

// With histograms of the dig zones too: dig() has what the machine itself changes in them.
void MonitorWatch::watch_region(const berm_parameters& parameters, bool lanes_open) {
  berm_parameters region = parameters;
  if (!histogram_.empty()) region.dig_zones = 0;
  sk_watch_region(&rules_, &region, lanes_open);
}

void MonitorWatch::begin() {
  sk_monitor_begin(&monitor_);
  for (sk_monitor_histogram& h : histogram_) sk_histogram_begin(&h);
  where_ = {-1, -1};
  newest_us_ = -1;
}

std::int32_t MonitorWatch::known_elsewhere(std::int32_t iy, std::int32_t ix, const Others& others) const {
  std::int32_t known = SK_NOBODY_KNOWS;
  if (!sk_is_in_map(iy, ix)) return known;
  const std::uint32_t observed = histogram_.front().observed[iy][ix];
  const Anew anew = learned_anew(iy, ix);
  const bool are_scanners = others.scanners == nullptr, ask_long = anew == Anew::kNever || (anew == Anew::kForATruck && !are_scanners);
  if (observed >= (ask_long ? SK_HISTOGRAM_WELL : SK_HISTOGRAM_ENOUGH)) return known;
  for (int i = 0; i < others.count; ++i)
    if (anew == Anew::kNever || are_scanners || others.monitor[i] == others.scanners) known = std::max(known, sk_histogram_known(others.monitor[i]->histogram(), iy, ix));
  if (known != SK_NOBODY_KNOWS || anew != Anew::kAfterTheBucket) return known;
  // What has been counted since is left out: somebody met from the feet upwards would raise it with each return.
  const std::int32_t beside = met_beside_[cell_number(iy, ix)], met = beside == SK_NOBODY_KNOWS ? sk_histogram_met(histogram_.data(), iy, ix) : beside;
  return met == SK_NOBODY_KNOWS ? met : std::min(met + kSlopeBins, SK_HISTOGRAM_BINS - 1);
}

bool MonitorWatch::scanners_know_better(std::int32_t iy, std::int32_t ix, const Others& others) const {
  return others.scanners != nullptr && sk_is_in_map(iy, ix) && learned_anew(iy, ix) == Anew::kForATruck;
}

void MonitorWatch::insert(const sk_point& point, std::int64_t now_us, const Others& others) {
  newest_us_ = now_us;
  const std::int32_t iy = sk_map_index(point.y_mm), ix = sk_map_index(point.x_mm);
  if (histogram_.empty()) {
    sk_monitor_insert(&monitor_, iy, ix, point.z_mm, false, now_us);
    return;
  }
  const std::int32_t known = known_elsewhere(iy, ix, others);
  sk_histogram_insert(histogram_.data(), known, scanners_know_better(iy, ix, others), &rules_, iy, ix, point.z_mm, now_us);
  learn_beside(point);
}

void MonitorWatch::learn_beside(const sk_point& point) {
  sk_monitor_histogram& h = histogram_.front();
  const std::int32_t own_y = sk_map_index(point.y_mm), own_x = sk_map_index(point.x_mm);
  const std::int32_t first_x = sk_map_index(point.x_mm - kBesideMm), last_x = sk_map_index(point.x_mm + kBesideMm), last_y = sk_map_index(point.y_mm + kBesideMm);
  for (std::int32_t iy = sk_map_index(point.y_mm - kBesideMm); iy <= last_y; ++iy)
    for (std::int32_t ix = first_x; ix <= last_x; ++ix) {
      if (iy != own_y || ix != own_x) sk_histogram_beside(&h, iy, ix, point.z_mm);
    }
}

void MonitorWatch::interpolate(const sk_point& from, const sk_point& to, Over over, std::int64_t now_us) {
  const std::int64_t dx = std::int64_t{to.x_mm} - from.x_mm, dy = std::int64_t{to.y_mm} - from.y_mm, dz = std::int64_t{to.z_mm} - from.z_mm;
  const std::int64_t steps = std::min<std::int64_t>(std::max(std::abs(dx), std::abs(dy)) / (SK_CELL_MM / 2), kStepsMost);
  Along x(from.x_mm, dx, steps), y(from.y_mm, dy, steps), z(from.z_mm, dz, steps);
  for (std::int64_t k = 1; k < steps; ++k) {
    const std::int32_t x_mm = x.next(), y_mm = y.next(), z_mm = z.next(), iy = sk_map_index(y_mm), ix = sk_map_index(x_mm);
    if (!histogram_.empty()) {
      sk_histogram_line(histogram_.data(), iy, ix, z_mm);
      continue;
    }
    if (over == Over::kUnmeasured && sk_is_in_map(iy, ix) && monitor_.accumulated_flag[iy][ix] == SK_FLAG_SET) continue;
    sk_monitor_insert(&monitor_, iy, ix, z_mm, true, now_us);
  }
}

bool MonitorWatch::somebody(const sk_monitor_cell& at) const {
  const std::uint16_t state = histogram_.front().state[at.iy][at.ix];
  return state != SK_CELL_CLEAR && state != SK_CELL_LEARNING;
}

// Somebody whom a sensor meets in a point or two a turn is nobody to it (SK-WM-62), and is about.
bool MonitorWatch::nobody_about(const sk_monitor_cell& at, std::int64_t now_us) const {
  const std::int64_t lately_us = std::int64_t{rules_.wait_us} + 2 * std::int64_t{rules_.period_us};
  const sk_monitor_histogram& h = histogram_.front();
  for (std::int32_t iy = at.iy - 1; iy <= at.iy + 1; ++iy)
    for (std::int32_t ix = at.ix - 1; ix <= at.ix + 1; ++ix) {
      if (!sk_is_in_map(iy, ix)) continue;
      const std::int64_t departed_us = h.departed_us[iy][ix][0];
      if (somebody({iy, ix}) || (departed_us >= 0 && now_us - departed_us <= lately_us)) return false;
    }
  return true;
}

bool MonitorWatch::ground_known(const sk_monitor_cell& at, std::int32_t known) const {
  const sk_monitor_histogram& h = histogram_.front();
  return known >= 0 || h.observed[at.iy][at.ix] >= SK_HISTOGRAM_ENOUGH || h.lines[at.iy][at.ix] >= SK_LINES_ENOUGH;
}

bool MonitorWatch::pass(const sk_monitor_cell& at, std::int32_t z_mm, std::int64_t now_us, const Others& others) {
  sk_monitor_histogram& h = histogram_.front();
  const std::int32_t known = known_elsewhere(at.iy, at.ix, others);
  sk_histogram_pass(&h, known, &rules_, at.iy, at.ix, z_mm, now_us);
  // Where nothing is known, and while it is learned, nothing departs, however high.
  if (learned_anew(at.iy, at.ix) != Anew::kNever || h.state[at.iy][at.ix] == SK_CELL_LEARNING || !ground_known(at, known)) return false;
  return nobody_about(at, now_us) && !sk_histogram_departs(&h, known, &rules_, at.iy, at.ix, z_mm);
}

void MonitorWatch::pass_of_another(const sk_monitor_cell& at, std::int32_t z_mm, std::int64_t now_us, const MonitorWatch& other) {
  sk_histogram_pass(&histogram_.front(), sk_histogram_known(other.histogram(), at.iy, at.ix), &rules_, at.iy, at.ix, z_mm, now_us);
}

void MonitorWatch::change_lanes(const berm_parameters& parameters, bool open) {
  for (int i = 0; i < parameters.lanes; ++i) {
    const berm_lane& lane = parameters.lane[i];
    sk_forget_rectangle(&monitor_, lane.x_low_mm, lane.y_low_mm, lane.x_high_mm, lane.y_high_mm);
    for (sk_monitor_histogram& h : histogram_) sk_histogram_forget(&h, lane.x_low_mm, lane.y_low_mm, lane.x_high_mm, lane.y_high_mm);
  }
  watch_region(parameters, open);
}

void MonitorWatch::note_met(std::int32_t iy, std::int32_t ix) {
  if (learned_anew(iy, ix) != Anew::kAfterTheBucket || histogram_.front().state[iy][ix] != SK_CELL_LEARNING) return;
  met_beside_[cell_number(iy, ix)] = sk_histogram_met(histogram_.data(), iy, ix);
}

void MonitorWatch::settle(const berm_lane& at) {
  if (!histogram_.empty())
    for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix)
        if (sk_is_touched(iy, ix, at.x_low_mm, at.y_low_mm, at.x_high_mm, at.y_high_mm)) note_met(iy, ix);
  sk_settle_rectangle(&monitor_, rules_.continuous, at.x_low_mm, at.y_low_mm, at.x_high_mm, at.y_high_mm);
  for (sk_monitor_histogram& h : histogram_) sk_histogram_settle(&h, at.x_low_mm, at.y_low_mm, at.x_high_mm, at.y_high_mm);
}

void MonitorWatch::dig(const std::vector<DigWatch::Cell>& cells, bool learned, bool holds) {
  for (sk_monitor_histogram& h : histogram_)
    for (const DigWatch::Cell& cell : cells) {
      const auto [iy, ix] = cell.at;
      if (cell.stirred && !holds && h.state[iy][ix] != SK_CELL_LEARNING) sk_histogram_forget_cell(&h, iy, ix);
      if (cell.stirred || !cell.was_stirred || !learned) continue;
      note_met(iy, ix);
      sk_histogram_settle_cell(&h, iy, ix);
    }
}

bool MonitorWatch::step(std::int64_t now_us) {
  if (histogram_.empty()) return sk_monitor_step(&monitor_, &rules_, now_us, &where_);
  return sk_histogram_step(histogram_.data(), &rules_, now_us, &where_);
}

bool MonitorWatch::place(std::int32_t& x_mm, std::int32_t& y_mm, std::int32_t& height_mm) const {
  if (where_.iy < 0) return false;
  x_mm = SK_MAP_ORIGIN_MM + SK_CELL_MM * where_.ix + SK_CELL_MM / 2;
  y_mm = SK_MAP_ORIGIN_MM + SK_CELL_MM * where_.iy + SK_CELL_MM / 2;
  height_mm = histogram_.empty() ? monitor_.obstacle_height_mm[where_.iy][where_.ix] : histogram_[0].departed_mm[where_.iy][where_.ix];
  return true;
}

}  // namespace berm::kernel
