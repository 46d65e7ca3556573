#include "monitor_check.h"

/*@ requires \valid_read(m);
  @ assigns \nothing;
  @ ensures \result == sk_empty_at(m, j, i) && 0 <= \result <= 1;
  @*/
static int32_t sk_count_empty(const sk_monitor *m, int32_t j, int32_t i)
{
  return sk_is_in_map(j, i) && m->accumulated_flag[j][i] == SK_FLAG_EMPTY ? 1 : 0;
}

/*@ requires \valid_read(m) && 0 <= ix < SK_MAP_CELLS && -1 <= j <= SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures \result == sk_empty_in_row(m, j, ix) && 0 <= \result <= 3;
  @*/
static int32_t sk_count_empty_in_row(const sk_monitor *m, int32_t j, int32_t ix)
{
  return sk_count_empty(m, j, ix - 1) + sk_count_empty(m, j, ix) + sk_count_empty(m, j, ix + 1);
}

/*@ requires \valid_read(m) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == sk_empty_beside(m, iy, ix);
  @*/
static int32_t sk_count_empty_beside(const sk_monitor *m, int32_t iy, int32_t ix)
{
  return sk_count_empty_in_row(m, iy - 1, ix) + sk_count_empty_in_row(m, iy + 1, ix) + sk_count_empty(m, iy, ix - 1) + sk_count_empty(m, iy, ix + 1);
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_explains(m, r, iy, ix, j, i);
  @*/
static bool sk_is_explained_by(const sk_monitor *m, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t j, int32_t i)
{
  int64_t beside_mm;
  if (!sk_is_in_map(j, i) || m->accumulated_flag[j][i] != SK_FLAG_SET) { return false; }
  beside_mm = m->height_mm[j][i];
  if (beside_mm > (int64_t)sk_new_height_mm(m, iy, ix) - r->neighbour_threshold_mm) { return true; }
  return beside_mm - m->height_mm[iy][ix] > r->slope_threshold_mm;
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_in_map(iy, ix) && -1 <= j <= SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_explained_in_row(m, r, iy, ix, j);
  @*/
static bool sk_is_explained_in_row(const sk_monitor *m, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t j)
{
  return sk_is_explained_by(m, r, iy, ix, j, ix - 1) || sk_is_explained_by(m, r, iy, ix, j, ix) || sk_is_explained_by(m, r, iy, ix, j, ix + 1);
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_excused(m, r, iy, ix);
  @*/
static bool sk_is_excused(const sk_monitor *m, const sk_monitor_rules *r, int32_t iy, int32_t ix)
{
  if (sk_count_empty_beside(m, iy, ix) >= 2) { return true; }
  if (sk_is_explained_in_row(m, r, iy, ix, iy - 1) || sk_is_explained_in_row(m, r, iy, ix, iy + 1)) { return true; }
  return sk_is_explained_by(m, r, iy, ix, iy, ix - 1) || sk_is_explained_by(m, r, iy, ix, iy, ix + 1);
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rises(m, r, iy, ix);
  @*/
static bool sk_is_risen(const sk_monitor *m, const sk_monitor_rules *r, int32_t iy, int32_t ix)
{
  if (m->accumulated_flag[iy][ix] == SK_FLAG_EMPTY) { return false; }
  return (int64_t)sk_new_height_mm(m, iy, ix) - m->height_mm[iy][ix] > r->height_threshold_mm;
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_due(m, r, now_us, iy, ix, m->temporary_flag[iy][ix]);
  @*/
static bool sk_is_due(const sk_monitor *m, const sk_monitor_rules *r, int64_t now_us, int32_t iy, int32_t ix)
{
  if (m->temporary_flag[iy][ix] == SK_FLAG_NOT_VISITED) { return true; }
  if (m->temporary_flag[iy][ix] != SK_FLAG_SET) { return false; }
  if (now_us < 0 || r->wait_us < 0 || m->began_us[iy][ix] > now_us) { return true; }
  return m->began_us[iy][ix] <= now_us - r->wait_us;
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures sk_verdict(m, r, now_us, iy, ix, m->temporary_flag[iy][ix], \result);
  @*/
static uint8_t sk_verdict_of(const sk_monitor *m, const sk_monitor_rules *r, int64_t now_us, int32_t iy, int32_t ix)
{
  if (!sk_is_due(m, r, now_us, iy, ix)) { return m->temporary_flag[iy][ix]; }
  if (!sk_is_risen(m, r, iy, ix)) { return SK_FLAG_NOT_VISITED; }
  if (m->second_mm[iy][ix] == SK_NO_HEIGHT) { return SK_FLAG_INTERPOLATED_NOT_VISITED; }
  return sk_is_excused(m, r, iy, ix) ? SK_FLAG_CHANGED : SK_FLAG_OBSTACLE;
}

bool sk_check_cell(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us, int32_t iy, int32_t ix)
{
  if (!sk_is_in_map(iy, ix)) { return false; }
  m->temporary_flag[iy][ix] = sk_verdict_of(m, r, now_us, iy, ix);
  return true;
}

/*@ requires \valid(m) && \valid_read(r) && \separated(m, r) && 0 <= iy < SK_MAP_CELLS;
  @ assigns m->temporary_flag[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures \forall integer ix; 0 <= ix < SK_MAP_CELLS ==>
  @   sk_verdict{Pre}(m, r, now_us, iy, ix, \at(m->temporary_flag[iy][ix], Pre), m->temporary_flag[iy][ix]);
  @*/
static void sk_check_row(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant done: \forall integer i; 0 <= i < ix ==>
    @   sk_verdict{Pre}(m, r, now_us, iy, i, \at(m->temporary_flag[iy][i], Pre), m->temporary_flag[iy][i]);
    @ loop invariant rest: \forall integer i; ix <= i < SK_MAP_CELLS ==> m->temporary_flag[iy][i] == \at(m->temporary_flag[iy][i], Pre);
    @ loop assigns ix, m->temporary_flag[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) { m->temporary_flag[iy][ix] = sk_verdict_of(m, r, now_us, iy, ix); }
}

/*@ requires \valid(m) && \valid_read(r) && \separated(m, r);
  @ assigns m->temporary_flag[..][..];
  @ ensures \forall integer iy, ix; sk_in_map(iy, ix) ==>
  @   sk_verdict{Pre}(m, r, now_us, iy, ix, \at(m->temporary_flag[iy][ix], Pre), m->temporary_flag[iy][ix]);
  @*/
static void sk_check_all(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant done: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==>
    @   sk_verdict{Pre}(m, r, now_us, j, i, \at(m->temporary_flag[j][i], Pre), m->temporary_flag[j][i]);
    @ loop invariant rest: \forall integer j, i; iy <= j < SK_MAP_CELLS && 0 <= i < SK_MAP_CELLS ==>
    @   m->temporary_flag[j][i] == \at(m->temporary_flag[j][i], Pre);
    @ loop assigns iy, m->temporary_flag[..][..];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_check_row(m, r, now_us, iy); }
}

/*@ requires \valid(m) && \valid_read(r) && \separated(m, r) && sk_monitor_valid(m) && m->overflowed == false;
  @ assigns m->temporary_flag[..][..];
  @ ensures \forall integer iy, ix; sk_in_map(iy, ix) ==>
  @   sk_verdict{Pre}(m, r, now_us, iy, ix, \at(m->temporary_flag[iy][ix], Pre), m->temporary_flag[iy][ix]);
  @*/
static void sk_check_listed(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us)
{
  int64_t k;
  /*@ loop invariant 0 <= k <= m->modified;
    @ loop invariant done: \forall integer j, i; sk_in_map(j, i) && sk_listed(m, j, i) && m->place[j][i] < k ==>
    @   sk_verdict{Pre}(m, r, now_us, j, i, \at(m->temporary_flag[j][i], Pre), m->temporary_flag[j][i]);
    @ loop invariant rest: \forall integer j, i; sk_in_map(j, i) && !(sk_listed(m, j, i) && m->place[j][i] < k) ==>
    @   m->temporary_flag[j][i] == \at(m->temporary_flag[j][i], Pre);
    @ loop assigns k, m->temporary_flag[..][..];
    @ loop variant m->modified - k;
    @*/
  for (k = 0; k < m->modified; k++) {
    /*@ assert listed: sk_entry_ok(m, k); */
    int32_t iy = (int32_t)m->modified_iy[k];
    int32_t ix = (int32_t)m->modified_ix[k];
    /*@ assert entry: sk_in_map(iy, ix) && sk_listed(m, iy, ix) && m->place[iy][ix] == k; */
    /*@ assert no_other: \forall integer j, i; sk_in_map(j, i) && sk_listed(m, j, i) && m->place[j][i] == k ==> j == iy && i == ix; */
    m->temporary_flag[iy][ix] = sk_verdict_of(m, r, now_us, iy, ix);
  }
}

void sk_check_modified(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us)
{
  if (m->overflowed) { sk_check_all(m, r, now_us); }
  else { sk_check_listed(m, r, now_us); }
}
