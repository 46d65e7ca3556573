#include "monitor_histogram.h"

/*@ assigns \nothing;
  @ ensures sk_is_bin(\result, z_mm);
  @*/
static int32_t sk_bin_of(int32_t z_mm)
{
  if (z_mm < SK_HISTOGRAM_FLOOR_MM) { return 0; }
  if (z_mm >= SK_HISTOGRAM_TOP_MM) { return SK_HISTOGRAM_BINS - 1; }
  return (z_mm - SK_HISTOGRAM_FLOOR_MM) / SK_HISTOGRAM_BIN_MM;
}

/*@ assigns \nothing;
  @ ensures sk_lowest_bin(\result, z_mm, rise_mm);
  @*/
static int32_t sk_lowest_bin_of(int32_t z_mm, int32_t rise_mm)
{
  int64_t over_floor_mm = (int64_t)z_mm - rise_mm - SK_HISTOGRAM_FLOOR_MM;
  int32_t own = sk_bin_of(z_mm);
  int64_t lowest = 0;
  if (over_floor_mm > 0) { lowest = (over_floor_mm + SK_HISTOGRAM_BIN_MM - 1) / SK_HISTOGRAM_BIN_MM; }
  return lowest < own ? (int32_t)lowest : own;
}

/* How many points, up to two, were seen in bins from `low` on. */
/*@ requires \valid_read(h) && sk_in_map(iy, ix) && sk_in_bins(low);
  @ assigns \nothing;
  @ ensures range: 0 <= \result <= 2;
  @ ensures two: \result == 2 <==> sk_seen_twice_in(h, iy, ix, low, SK_HISTOGRAM_BINS);
  @ ensures none: \result == 0 <==> !sk_seen_in(h, iy, ix, low, SK_HISTOGRAM_BINS);
  @*/
static int32_t sk_seen_from(const sk_monitor_histogram *h, int32_t iy, int32_t ix, int32_t low)
{
  int32_t seen = 0;
  int32_t b;
  /*@ loop invariant low <= b <= SK_HISTOGRAM_BINS && 0 <= seen <= 1;
    @ loop invariant not_twice: !sk_seen_twice_in(h, iy, ix, low, b);
    @ loop invariant one: seen == 1 <==> sk_seen_in(h, iy, ix, low, b);
    @ loop assigns b, seen;
    @ loop variant SK_HISTOGRAM_BINS - b;
    @*/
  for (b = low; b < SK_HISTOGRAM_BINS; b++) {
    if (h->seen[iy][ix][b] == 0U) { continue; }
    if (h->seen[iy][ix][b] > 1U || seen > 0) { return 2; }
    seen = 1;
  }
  return seen;
}

/*@ requires \valid_read(h) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_believed(h, iy, ix);
  @*/
static bool sk_is_believed(const sk_monitor_histogram *h, int32_t iy, int32_t ix)
{
  return h->state[iy][ix] != SK_CELL_LEARNING && h->observed[iy][ix] >= SK_HISTOGRAM_ENOUGH;
}

int32_t sk_histogram_met(const sk_monitor_histogram *h, int32_t iy, int32_t ix)
{
  int32_t seen = 0;
  int32_t b;
  if (!sk_is_in_map(iy, ix)) { return SK_NOBODY_KNOWS; }
  /*@ loop invariant -1 <= b < SK_HISTOGRAM_BINS && 0 <= seen <= 1;
    @ loop invariant not_twice: !sk_seen_twice_in(h, iy, ix, b + 1, SK_HISTOGRAM_BINS);
    @ loop invariant one: seen == 1 <==> sk_seen_in(h, iy, ix, b + 1, SK_HISTOGRAM_BINS);
    @ loop assigns b, seen;
    @ loop variant b;
    @*/
  for (b = SK_HISTOGRAM_BINS - 1; b >= 0; b--) {
    if (h->seen[iy][ix][b] == 0U) { continue; }
    if (h->seen[iy][ix][b] > 1U || seen > 0) { return b; }
    seen = 1;
  }
  return SK_NOBODY_KNOWS;
}

int32_t sk_histogram_known(const sk_monitor_histogram *h, int32_t iy, int32_t ix)
{
  if (!sk_is_in_map(iy, ix) || !sk_is_believed(h, iy, ix)) { return SK_NOBODY_KNOWS; }
  return sk_histogram_met(h, iy, ix);
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_known_lower(known, low);
  @*/
static bool sk_is_known_lower(int32_t known, int32_t low) { return known >= 0 && known < low; }

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_known_as_high(known, low);
  @*/
static bool sk_is_known_as_high(int32_t known, int32_t low) { return known >= 0 && known >= low; }

/*@ requires \valid_read(h) && \valid_read(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_departs(h, known, over_lines, r, iy, ix, z_mm);
  @*/
static bool sk_is_departing(const sk_monitor_histogram *h, int32_t known, bool over_lines, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t z_mm)
{
  int32_t low = sk_lowest_bin_of(z_mm, r->height_threshold_mm);
  /*@ assert only: \forall integer k; sk_lowest_bin(k, z_mm, r->height_threshold_mm) ==> k == low; */
  if (h->state[iy][ix] == SK_CELL_LEARNING) { return false; }
  if (h->observed[iy][ix] >= SK_HISTOGRAM_ENOUGH) {
    if (h->observed[iy][ix] < SK_HISTOGRAM_WELL && sk_is_known_as_high(known, low)) { return false; }
    return sk_seen_from(h, iy, ix, low) < 2;
  }
  if (sk_seen_from(h, iy, ix, low) > 0) { return false; }
  if (h->lines[iy][ix] >= SK_LINES_ENOUGH && (int64_t)z_mm - h->line_mm[iy][ix] > r->height_threshold_mm &&
      !(over_lines && sk_is_known_as_high(known, low))) {
    return true;
  }
  return sk_is_known_lower(known, low);
}

/*@ requires now_us >= 0;
  @ assigns \nothing;
  @ ensures \result == sk_recent_time(departed_us, window_us, now_us) && 0 <= \result <= 1;
  @*/
static int32_t sk_is_recent(int64_t departed_us, int64_t window_us, int64_t now_us)
{
  if (departed_us < 0) { return 0; }
  return now_us - departed_us <= window_us ? 1 : 0;
}

/*@ requires \valid_read(h) && now_us >= 0;
  @ assigns \nothing;
  @ ensures \result == sk_recent_at(h, window_us, now_us, iy, ix) && 0 <= \result <= 2;
  @*/
static int32_t sk_recent(const sk_monitor_histogram *h, int64_t window_us, int64_t now_us, int32_t iy, int32_t ix)
{
  if (!sk_is_in_map(iy, ix)) { return 0; }
  return sk_is_recent(h->departed_us[iy][ix][0], window_us, now_us) + sk_is_recent(h->departed_us[iy][ix][1], window_us, now_us);
}

/*@ requires \valid_read(h) && now_us >= 0 && 0 <= ix < SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures \result == sk_recent_in_row(h, window_us, now_us, iy, ix) && 0 <= \result <= 6;
  @*/
static int32_t sk_recent_row(const sk_monitor_histogram *h, int64_t window_us, int64_t now_us, int32_t iy, int32_t ix)
{
  return sk_recent(h, window_us, now_us, iy, ix - 1) + sk_recent(h, window_us, now_us, iy, ix) + sk_recent(h, window_us, now_us, iy, ix + 1);
}

/*@ requires \valid_read(h) && now_us >= 0 && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == sk_recent_beside(h, window_us, now_us, iy, ix) && 0 <= \result <= 16;
  @*/
static int32_t sk_recent_neighbours(const sk_monitor_histogram *h, int64_t window_us, int64_t now_us, int32_t iy, int32_t ix)
{
  return sk_recent_row(h, window_us, now_us, iy - 1, ix) + sk_recent_row(h, window_us, now_us, iy + 1, ix) +
         sk_recent(h, window_us, now_us, iy, ix - 1) + sk_recent(h, window_us, now_us, iy, ix + 1);
}

/*@ requires \valid(h) && sk_in_map(iy, ix);
  @ assigns h->seen[iy][ix][0 .. SK_HISTOGRAM_BINS - 1];
  @ ensures \forall integer b; sk_in_bins(b) ==> h->seen[iy][ix][b] == \old(h->seen[iy][ix][b]) / 2;
  @*/
static void sk_halve_bins(sk_monitor_histogram *h, int32_t iy, int32_t ix)
{
  int32_t b;
  /*@ loop invariant 0 <= b <= SK_HISTOGRAM_BINS;
    @ loop invariant done: \forall integer c; 0 <= c < b ==> h->seen[iy][ix][c] == \at(h->seen[iy][ix][c], Pre) / 2;
    @ loop invariant rest: \forall integer c; b <= c < SK_HISTOGRAM_BINS ==> h->seen[iy][ix][c] == \at(h->seen[iy][ix][c], Pre);
    @ loop assigns b, h->seen[iy][ix][0 .. SK_HISTOGRAM_BINS - 1];
    @ loop variant SK_HISTOGRAM_BINS - b;
    @*/
  for (b = 0; b < SK_HISTOGRAM_BINS; b++) { h->seen[iy][ix][b] = (uint8_t)(h->seen[iy][ix][b] / 2U); }
}

/*@ requires \valid(h) && sk_in_map(iy, ix) && sk_in_bins(b);
  @ assigns h->seen[iy][ix][0 .. SK_HISTOGRAM_BINS - 1];
  @ ensures sk_counted{Pre, Post}(h, iy, ix, b);
  @*/
static void sk_count_point(sk_monitor_histogram *h, int32_t iy, int32_t ix, int32_t b)
{
  if (h->seen[iy][ix][b] == SK_HISTOGRAM_FULL) { sk_halve_bins(h, iy, ix); }
  h->seen[iy][ix][b] = (uint8_t)(h->seen[iy][ix][b] + 1U);
}

/*@ requires \valid(h) && \valid_read(r) && \separated(h, r) && sk_in_map(iy, ix) && now_us >= 0;
  @ assigns h->state[iy][ix], h->ground_us[iy][ix];
  @ ensures leaves: sk_somebody_at{Pre}(h, iy, ix) && sk_ground_is_back{Pre}(h, r, now_us, iy, ix) ==> !sk_somebody_at(h, iy, ix);
  @ ensures stays: sk_somebody_at{Pre}(h, iy, ix) && !sk_ground_is_back{Pre}(h, r, now_us, iy, ix) ==> sk_somebody_at(h, iy, ix);
  @ ensures nobody: !sk_somebody_at{Pre}(h, iy, ix) ==> h->state[iy][ix] == \old(h->state[iy][ix]);
  @ ensures time: h->ground_us[iy][ix] == \old(h->ground_us[iy][ix]) || (sk_somebody_at{Pre}(h, iy, ix) && h->ground_us[iy][ix] == now_us);
  @*/
static void sk_see_ground_again(sk_monitor_histogram *h, const sk_monitor_rules *r, int32_t iy, int32_t ix, int64_t now_us)
{
  int64_t window_us = 2 * (int64_t)r->period_us;
  if (h->state[iy][ix] == SK_CELL_LEARNING || h->state[iy][ix] == SK_CELL_CLEAR) { return; }
  if (sk_recent(h, window_us, now_us, iy, ix) > 0 || sk_recent_neighbours(h, window_us, now_us, iy, ix) > 0) { return; }
  if (h->ground_us[iy][ix] > (uint64_t)now_us) {
    h->ground_us[iy][ix] = (uint64_t)now_us;
    return;
  }
  if (now_us - (int64_t)h->ground_us[iy][ix] >= r->wait_us) { h->state[iy][ix] = SK_CELL_CLEAR; }
}

/*@ requires \valid_read(h) && sk_in_map(iy, ix) && sk_in_bins(b);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_raises(h, iy, ix, b);
  @*/
static bool sk_is_raising(const sk_monitor_histogram *h, int32_t iy, int32_t ix, int32_t b)
{
  return sk_is_believed(h, iy, ix) && sk_seen_from(h, iy, ix, b) < 2;
}

/*@ requires \valid_read(h) && \valid_read(r) && sk_in_map(iy, ix) && now_us >= 0;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_may_raise(h, r, now_us, iy, ix);
  @*/
static bool sk_is_raise_due(const sk_monitor_histogram *h, const sk_monitor_rules *r, int32_t iy, int32_t ix, int64_t now_us)
{
  if (h->state[iy][ix] != SK_CELL_CLEAR) { return false; }
  if (h->ground_us[iy][ix] > (uint64_t)now_us) { return true; }
  return now_us - (int64_t)h->ground_us[iy][ix] > 2 * (int64_t)r->period_us;
}

/*@ requires \valid_read(h) && sk_in_map(iy, ix) && sk_in_bins(b);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_above_ground(h, known, iy, ix, b);
  @*/
static bool sk_is_above_ground(const sk_monitor_histogram *h, int32_t known, int32_t iy, int32_t ix, int32_t b)
{
  if (h->state[iy][ix] == SK_CELL_LEARNING || h->observed[iy][ix] >= SK_HISTOGRAM_ENOUGH) { return false; }
  if (h->lines[iy][ix] >= SK_LINES_ENOUGH && SK_HISTOGRAM_BIN_MM * b + SK_HISTOGRAM_FLOOR_MM > h->line_mm[iy][ix]) { return true; }
  return sk_is_known_lower(known, b);
}

/* A point in bin b that does not depart. */
/*@ requires \valid(h) && \valid_read(r) && \separated(h, r) && sk_in_map(iy, ix) && sk_in_bins(b) && now_us >= 0;
  @ assigns h->seen[iy][ix][0 .. SK_HISTOGRAM_BINS - 1], h->observed[iy][ix], h->ground_us[iy][ix];
  @ ensures counted: sk_counts{Pre}(h, known, r, now_us, iy, ix, b) ==> sk_counted{Pre, Post}(h, iy, ix, b) && sk_observed{Pre, Post}(h, iy, ix);
  @ ensures kept: !sk_counts{Pre}(h, known, r, now_us, iy, ix, b) ==>
  @   sk_bins_kept{Pre, Post}(h, iy, ix) && h->observed[iy][ix] == \old(h->observed[iy][ix]);
  @ ensures time: h->ground_us[iy][ix] == \old(h->ground_us[iy][ix]) || (h->ground_us[iy][ix] == now_us && h->state[iy][ix] == SK_CELL_CLEAR);
  @*/
static void sk_count_ground(sk_monitor_histogram *h, int32_t known, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t b, int64_t now_us)
{
  if (sk_is_above_ground(h, known, iy, ix, b)) { return; }
  if (sk_is_raising(h, iy, ix, b)) {
    if (!sk_is_raise_due(h, r, iy, ix, now_us)) { return; }
    h->ground_us[iy][ix] = (uint64_t)now_us;
  }
  sk_count_point(h, iy, ix, b);
  if (h->observed[iy][ix] < SK_HISTOGRAM_WELL) { h->observed[iy][ix] = h->observed[iy][ix] + 1U; }
}

/*@ requires \valid(h) && \valid_read(r) && \separated(h, r) && sk_in_map(iy, ix) && now_us >= 0;
  @ assigns h->seen[iy][ix][0 .. SK_HISTOGRAM_BINS - 1], h->observed[iy][ix], h->state[iy][ix], h->ground_us[iy][ix];
  @ ensures counted: \exists integer b; sk_is_bin(b, z_mm) && (sk_counts{Pre}(h, known, r, now_us, iy, ix, b) ==>
  @     sk_counted{Pre, Post}(h, iy, ix, b) && sk_observed{Pre, Post}(h, iy, ix)) &&
  @   (!sk_counts{Pre}(h, known, r, now_us, iy, ix, b) ==> sk_bins_kept{Pre, Post}(h, iy, ix) && h->observed[iy][ix] == \old(h->observed[iy][ix]));
  @ ensures stays: sk_somebody_at{Pre}(h, iy, ix) && !sk_ground_is_back{Pre}(h, r, now_us, iy, ix) ==> sk_somebody_at(h, iy, ix);
  @ ensures nobody: !sk_somebody_at{Pre}(h, iy, ix) ==> h->state[iy][ix] == \old(h->state[iy][ix]);
  @*/
static void sk_take_ground(sk_monitor_histogram *h, int32_t known, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us)
{
  sk_count_ground(h, known, r, iy, ix, sk_bin_of(z_mm), now_us);
  sk_see_ground_again(h, r, iy, ix, now_us);
}

/*@ requires \valid(h) && \valid_read(r) && \separated(h, r) && sk_in_map(iy, ix) && now_us >= 0;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_joined_by_others(h, r, now_us, iy, ix);
  @*/
static bool sk_is_joined(const sk_monitor_histogram *h, const sk_monitor_rules *r, int32_t iy, int32_t ix, int64_t now_us)
{
  int64_t window_us = 2 * (int64_t)r->period_us;
  return sk_recent(h, window_us, now_us, iy, ix) + sk_recent_neighbours(h, window_us, now_us, iy, ix) >= SK_HISTOGRAM_OTHERS;
}

/*@ assigns \nothing;
  @ ensures \result == sk_clamped(z_mm);
  @*/
static int16_t sk_clamp_height(int32_t z_mm)
{
  if (z_mm > SK_HEIGHT_MAX_MM) { return SK_HEIGHT_MAX_MM; }
  if (z_mm < -SK_HEIGHT_MAX_MM) { return -SK_HEIGHT_MAX_MM; }
  return (int16_t)z_mm;
}

/*@ requires \valid(h) && \valid_read(r) && \separated(h, r) && sk_in_map(iy, ix) && now_us >= 0;
  @ assigns h->state[iy][ix], h->departed_mm[iy][ix], h->departed_us[iy][ix][0], h->departed_us[iy][ix][1], h->ground_us[iy][ix];
  @ ensures appears: sk_joined_by_others{Pre}(h, r, now_us, iy, ix) ==> sk_somebody_at(h, iy, ix);
  @ ensures alone: !sk_joined_by_others{Pre}(h, r, now_us, iy, ix) ==> h->state[iy][ix] == \old(h->state[iy][ix]);
  @ ensures time: h->departed_us[iy][ix][0] == now_us && h->departed_us[iy][ix][1] == \old(h->departed_us[iy][ix][0]) &&
  @   h->ground_us[iy][ix] == SK_NO_GROUND;
  @*/
static void sk_take_departing(sk_monitor_histogram *h, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us)
{
  if (sk_is_joined(h, r, iy, ix, now_us)) { h->state[iy][ix] = SK_CELL_SOMEBODY; }
  h->departed_mm[iy][ix] = sk_clamp_height(z_mm);
  h->departed_us[iy][ix][1] = h->departed_us[iy][ix][0];
  h->departed_us[iy][ix][0] = now_us;
  h->ground_us[iy][ix] = SK_NO_GROUND;
}

bool sk_histogram_insert(sk_monitor_histogram *h, int32_t known, bool over_lines, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us)
{
  if (now_us < 0 || z_mm >= SK_HISTOGRAM_TOP_MM || !sk_is_in_map(iy, ix)) { return false; }
  if (!sk_is_departing(h, known, over_lines, r, iy, ix, z_mm)) {
    sk_take_ground(h, known, r, iy, ix, z_mm, now_us);
    return false;
  }
  sk_take_departing(h, r, iy, ix, z_mm, now_us);
  /*@ assert times: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_times_kept{Pre, Here}(h, j, i); */
  /*@ assert ground: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_ground_kept{Pre, Here}(h, j, i); */
  return true;
}

void sk_histogram_beside(sk_monitor_histogram *h, int32_t iy, int32_t ix, int32_t z_mm)
{
  if (z_mm < SK_HISTOGRAM_TOP_MM && sk_is_in_map(iy, ix) && h->state[iy][ix] == SK_CELL_LEARNING) { sk_count_point(h, iy, ix, sk_bin_of(z_mm)); }
}

bool sk_histogram_departs(const sk_monitor_histogram *h, int32_t known, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t z_mm)
{
  return sk_is_in_map(iy, ix) && sk_is_departing(h, known, false, r, iy, ix, z_mm);
}

void sk_histogram_pass(sk_monitor_histogram *h, int32_t known, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us)
{
  if (now_us < 0 || z_mm >= SK_HISTOGRAM_TOP_MM || !sk_is_in_map(iy, ix)) { return; }
  if (!sk_is_departing(h, known, false, r, iy, ix, z_mm)) { sk_see_ground_again(h, r, iy, ix, now_us); }
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_lines_agree(line_mm, z_mm);
  @*/
static bool sk_do_lines_agree(int32_t line_mm, int32_t z_mm)
{
  int64_t over_mm = (int64_t)z_mm - line_mm;
  return over_mm >= -SK_LINE_NEAR_MM && over_mm <= SK_LINE_NEAR_MM;
}

void sk_histogram_line(sk_monitor_histogram *h, int32_t iy, int32_t ix, int32_t z_mm)
{
  if (!sk_is_in_map(iy, ix)) { return; }
  if (h->lines[iy][ix] > 0 && !sk_do_lines_agree(h->line_mm[iy][ix], z_mm)) {
    h->lines[iy][ix] = (int8_t)(h->lines[iy][ix] - 1);
    return;
  }
  h->line_mm[iy][ix] = z_mm;
  if (h->lines[iy][ix] <= 0) { h->lines[iy][ix] = 1; }
  else if (h->lines[iy][ix] < SK_LINES_MOST) { h->lines[iy][ix] = (int8_t)(h->lines[iy][ix] + 1); }
}
