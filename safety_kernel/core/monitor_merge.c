#include "monitor_merge.h"
#include "monitor_list.h"

/* A cell of both maps, by value. */
typedef struct merge_cell {
  uint8_t temporary;
  uint16_t flag;
  int32_t new_mm, height_mm, obstacle_mm;
} merge_cell;

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_quiet(temporary);
  @*/
static bool is_quiet(uint8_t temporary)
{
  return temporary == SK_FLAG_NOT_VISITED || temporary == SK_FLAG_INTERPOLATED_NOT_VISITED;
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_reports(temporary);
  @*/
static bool reports_obstacle(uint8_t temporary)
{
  if (temporary == SK_FLAG_EMPTY || temporary == SK_FLAG_SET || temporary == SK_FLAG_INTERPOLATED) { return false; }
  return !is_quiet(temporary) && temporary != SK_FLAG_CHANGED;
}

/*@ requires -2147483648 <= threshold_mm <= 2147483647;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_left(x.new_mm, x.height_mm, x.obstacle_mm, threshold_mm, continuous);
  @*/
static bool obstacle_has_left(merge_cell x, int64_t threshold_mm, bool continuous)
{
  int64_t rise_mm = (int64_t)x.new_mm - x.height_mm;
  if (!continuous) { return 2 * rise_mm < threshold_mm; }
  return x.new_mm < x.obstacle_mm - threshold_mm && rise_mm <= threshold_mm;
}

/*@ requires -2147483648 <= threshold_mm <= 2147483647;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_sank(x.new_mm, x.height_mm, threshold_mm, continuous);
  @*/
static bool change_has_sunk(merge_cell x, int64_t threshold_mm, bool continuous)
{
  int64_t rise_mm = (int64_t)x.new_mm - x.height_mm;
  if (!continuous) { return 2 * rise_mm < threshold_mm; }
  return -rise_mm > threshold_mm;
}

/*@ requires -2147483648 <= threshold_mm <= 2147483647;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_clears(x.temporary, x.new_mm, x.flag, x.height_mm, x.obstacle_mm, threshold_mm, continuous);
  @*/
static bool mark_clears(merge_cell x, int64_t threshold_mm, bool continuous)
{
  if (!is_quiet(x.temporary)) { return false; }
  if (sk_flag_is_obstacle(x.flag)) { return obstacle_has_left(x, threshold_mm, continuous); }
  return x.flag == SK_FLAG_CHANGED && change_has_sunk(x, threshold_mm, continuous);
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_fills(x.temporary, x.flag);
  @*/
static bool is_first(merge_cell x)
{
  if (!is_quiet(x.temporary)) { return false; }
  return x.flag == SK_FLAG_EMPTY || (x.flag == SK_FLAG_INTERPOLATED && x.temporary == SK_FLAG_NOT_VISITED);
}

/* An obstacle stays one until its height clears it. */
/*@ requires -2147483648 <= threshold_mm <= 2147483647;
  @ assigns \nothing;
  @ ensures sk_merged_flag(x.temporary, x.new_mm, x.flag, x.height_mm, x.obstacle_mm, threshold_mm, continuous, \result);
  @*/
static uint16_t flag_after(merge_cell x, int64_t threshold_mm, bool continuous)
{
  if (reports_obstacle(x.temporary)) { return SK_FLAG_OBSTACLE; }
  if (x.temporary == SK_FLAG_CHANGED && !sk_flag_is_obstacle(x.flag)) { return SK_FLAG_CHANGED; }
  if (is_first(x)) { return x.temporary == SK_FLAG_NOT_VISITED ? SK_FLAG_SET : SK_FLAG_INTERPOLATED; }
  if (mark_clears(x, threshold_mm, continuous)) { return SK_FLAG_SET; }
  return x.flag;
}

/* Of a cell that nothing moves in, and that had a height. */
/*@ requires -2147483648 <= threshold_mm <= 2147483647 && sk_quiet(x.temporary);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_follows(x.temporary, x.new_mm, x.flag, x.height_mm, x.obstacle_mm, threshold_mm, continuous);
  @*/
static bool height_follows(merge_cell x, int64_t threshold_mm, bool continuous)
{
  bool clears = mark_clears(x, threshold_mm, continuous);
  if (sk_flag_is_obstacle(x.flag) && !clears) { return false; }
  if (continuous && x.temporary == SK_FLAG_NOT_VISITED) { return true; }
  return (continuous || clears) && x.new_mm < x.height_mm;
}

/*@ requires -2147483648 <= threshold_mm <= 2147483647;
  @ assigns \nothing;
  @ ensures sk_merged_height(x.temporary, x.new_mm, x.flag, x.height_mm, x.obstacle_mm, threshold_mm, continuous, \result);
  @*/
static int32_t height_after(merge_cell x, int64_t threshold_mm, bool continuous)
{
  bool takes = false;
  if (is_quiet(x.temporary)) { takes = is_first(x) || height_follows(x, threshold_mm, continuous); }
  else if (x.temporary == SK_FLAG_CHANGED) { takes = continuous && !sk_flag_is_obstacle(x.flag); }
  return takes ? x.new_mm : x.height_mm;
}

/*@ assigns \nothing;
  @ ensures sk_merged_obstacle(x.temporary, x.new_mm, x.flag, x.obstacle_mm, \result);
  @*/
static int32_t obstacle_after(merge_cell x)
{
  if (x.temporary != SK_FLAG_CHANGED && !reports_obstacle(x.temporary)) { return x.obstacle_mm; }
  return sk_flag_is_obstacle(x.flag) && x.obstacle_mm > x.new_mm ? x.obstacle_mm : x.new_mm;
}

/* A cell in the middle of being scanned is put off to the next update. */
/*@ assigns \nothing;
  @ ensures sk_merged_temporary(temporary, \result);
  @*/
static uint8_t temporary_after(uint8_t temporary)
{
  if (temporary == SK_FLAG_SET) { return SK_FLAG_NOT_VISITED; }
  return temporary == SK_FLAG_INTERPOLATED ? SK_FLAG_INTERPOLATED_NOT_VISITED : SK_FLAG_EMPTY;
}

/*@ requires \valid_read(m) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result.temporary == m->temporary_flag[iy][ix] && \result.flag == m->accumulated_flag[iy][ix];
  @ ensures \result.new_mm == sk_new_height(m, iy, ix) && \result.height_mm == m->height_mm[iy][ix];
  @ ensures \result.obstacle_mm == m->obstacle_height_mm[iy][ix];
  @*/
static merge_cell cell_at(const sk_monitor *m, int32_t iy, int32_t ix)
{
  merge_cell x;
  x.temporary = m->temporary_flag[iy][ix];
  x.flag = m->accumulated_flag[iy][ix];
  x.new_mm = sk_new_height_mm(m, iy, ix);
  x.height_mm = m->height_mm[iy][ix];
  x.obstacle_mm = m->obstacle_height_mm[iy][ix];
  return x;
}

/* That only the one cell changes is said by `others`; `assigns` names its row, since the provers follow that sooner than one place in an array. */
/*@ requires \valid(m) && sk_in_map(iy, ix);
  @ assigns m->temporary_flag[iy][0 .. SK_MAP_CELLS - 1], m->accumulated_flag[iy][0 .. SK_MAP_CELLS - 1], m->height_mm[iy][0 .. SK_MAP_CELLS - 1],
  @   m->obstacle_height_mm[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures SK_TEMPORARY_MERGED(Pre, Post, iy, ix) && SK_FLAG_MERGED(Pre, Post, iy, ix, threshold_mm, continuous);
  @ ensures SK_HEIGHT_MERGED(Pre, Post, iy, ix, threshold_mm, continuous) && SK_OBSTACLE_MERGED(Pre, Post, iy, ix);
  @ ensures others_temporary: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==>
  @   m->temporary_flag[j][i] == \old(m->temporary_flag[j][i]);
  @ ensures others_flag: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==>
  @   m->accumulated_flag[j][i] == \old(m->accumulated_flag[j][i]);
  @ ensures others_height: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> m->height_mm[j][i] == \old(m->height_mm[j][i]);
  @ ensures others_obstacle: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==>
  @   m->obstacle_height_mm[j][i] == \old(m->obstacle_height_mm[j][i]);
  @*/
static void sk_merge_one(sk_monitor *m, int32_t iy, int32_t ix, int32_t threshold_mm, bool continuous)
{
  merge_cell x = cell_at(m, iy, ix);
  m->height_mm[iy][ix] = height_after(x, threshold_mm, continuous);
  m->obstacle_height_mm[iy][ix] = obstacle_after(x);
  m->accumulated_flag[iy][ix] = flag_after(x, threshold_mm, continuous);
  m->temporary_flag[iy][ix] = temporary_after(x.temporary);
}

bool sk_merge_cell(sk_monitor *m, const sk_monitor_rules *r, int32_t iy, int32_t ix)
{
  if (!sk_is_in_map(iy, ix)) { return false; }
  sk_merge_one(m, iy, ix, r->height_threshold_mm, r->continuous);
  return true;
}

/*@ requires \valid(m) && 0 <= iy < SK_MAP_CELLS;
  @ assigns m->temporary_flag[iy][0 .. SK_MAP_CELLS - 1], m->accumulated_flag[iy][0 .. SK_MAP_CELLS - 1], m->height_mm[iy][0 .. SK_MAP_CELLS - 1],
  @   m->obstacle_height_mm[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures temporary: \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> SK_TEMPORARY_MERGED(Pre, Post, iy, ix);
  @ ensures flag: \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> SK_FLAG_MERGED(Pre, Post, iy, ix, threshold_mm, continuous);
  @ ensures height: \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> SK_HEIGHT_MERGED(Pre, Post, iy, ix, threshold_mm, continuous);
  @ ensures obstacle: \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> SK_OBSTACLE_MERGED(Pre, Post, iy, ix);
  @ ensures others_temporary: \forall integer j, i; sk_in_map(j, i) && j != iy ==> m->temporary_flag[j][i] == \old(m->temporary_flag[j][i]);
  @ ensures others_flag: \forall integer j, i; sk_in_map(j, i) && j != iy ==> m->accumulated_flag[j][i] == \old(m->accumulated_flag[j][i]);
  @ ensures others_height: \forall integer j, i; sk_in_map(j, i) && j != iy ==> m->height_mm[j][i] == \old(m->height_mm[j][i]);
  @ ensures others_obstacle: \forall integer j, i; sk_in_map(j, i) && j != iy ==> m->obstacle_height_mm[j][i] == \old(m->obstacle_height_mm[j][i]);
  @*/
static void sk_merge_row(sk_monitor *m, int32_t iy, int32_t threshold_mm, bool continuous)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant done_temporary: \forall integer i; 0 <= i < ix ==> SK_TEMPORARY_MERGED(Pre, Here, iy, i);
    @ loop invariant done_flag: \forall integer i; 0 <= i < ix ==> SK_FLAG_MERGED(Pre, Here, iy, i, threshold_mm, continuous);
    @ loop invariant done_height: \forall integer i; 0 <= i < ix ==> SK_HEIGHT_MERGED(Pre, Here, iy, i, threshold_mm, continuous);
    @ loop invariant done_obstacle: \forall integer i; 0 <= i < ix ==> SK_OBSTACLE_MERGED(Pre, Here, iy, i);
    @ loop invariant rest_temporary: \forall integer i; ix <= i < SK_MAP_CELLS ==>
    @   m->temporary_flag[iy][i] == \at(m->temporary_flag[iy][i], Pre);
    @ loop invariant rest_flag: \forall integer i; ix <= i < SK_MAP_CELLS ==>
    @   m->accumulated_flag[iy][i] == \at(m->accumulated_flag[iy][i], Pre);
    @ loop invariant rest_height: \forall integer i; ix <= i < SK_MAP_CELLS ==>
    @   m->height_mm[iy][i] == \at(m->height_mm[iy][i], Pre);
    @ loop invariant rest_obstacle: \forall integer i; ix <= i < SK_MAP_CELLS ==>
    @   m->obstacle_height_mm[iy][i] == \at(m->obstacle_height_mm[iy][i], Pre);
    @ loop assigns ix, m->temporary_flag[iy][0 .. SK_MAP_CELLS - 1], m->accumulated_flag[iy][0 .. SK_MAP_CELLS - 1],
    @   m->height_mm[iy][0 .. SK_MAP_CELLS - 1], m->obstacle_height_mm[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    /*@ assert as_before: \forall integer i; i == ix ==> SK_CELL_KEPT(Pre, Here, iy, i); */
    sk_merge_one(m, iy, ix, threshold_mm, continuous);
    /*@ assert this: \forall integer i; i == ix ==> SK_CELL_MERGED(Pre, Here, iy, i, threshold_mm, continuous); */
  }
}

/* The cells of the map that are still modified, from the beginning. */
/*@ requires \valid(m) && sk_list_ok(m) && 0 <= iy < SK_MAP_CELLS;
  @ assigns m->modified_iy[..], m->modified_ix[..], m->place[iy][0 .. SK_MAP_CELLS - 1], m->modified, m->overflowed;
  @ ensures list: sk_list_ok(m);
  @ ensures lasting: \old(m->overflowed) == true ==> m->overflowed == true;
  @ ensures listed: m->overflowed == true || \forall integer ix; 0 <= ix < SK_MAP_CELLS && m->temporary_flag[iy][ix] != SK_FLAG_EMPTY ==>
  @   sk_listed(m, iy, ix);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && sk_listed{Pre}(m, j, i) ==> sk_listed{Post}(m, j, i);
  @*/
static void sk_list_row(sk_monitor *m, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant list: sk_list_ok(m);
    @ loop invariant lasting: \at(m->overflowed, Pre) == true ==> m->overflowed == true;
    @ loop invariant listed: m->overflowed == true || \forall integer i; 0 <= i < ix && m->temporary_flag[iy][i] != SK_FLAG_EMPTY ==>
    @   sk_listed(m, iy, i);
    @ loop invariant others: \forall integer j, i; sk_in_map(j, i) && sk_listed{Pre}(m, j, i) ==> sk_listed{Here}(m, j, i);
    @ loop assigns ix, m->modified_iy[..], m->modified_ix[..], m->place[iy][0 .. SK_MAP_CELLS - 1], m->modified, m->overflowed;
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    if (m->temporary_flag[iy][ix] != SK_FLAG_EMPTY) { sk_list_add(m, iy, ix); }
  }
}

/*@ requires \valid(m);
  @ assigns m->modified_iy[..], m->modified_ix[..], m->place[..][..], m->modified, m->overflowed;
  @ ensures sk_monitor_valid(m);
  @*/
static void sk_list_anew(sk_monitor *m)
{
  int32_t iy;
  sk_list_clear(m);
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant list: sk_list_ok(m);
    @ loop invariant listed: m->overflowed == true || \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS &&
    @   m->temporary_flag[j][i] != SK_FLAG_EMPTY ==> sk_listed(m, j, i);
    @ loop assigns iy, m->modified_iy[..], m->modified_ix[..], m->place[..][..], m->modified, m->overflowed;
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_list_row(m, iy); }
}

/*@ requires \valid(m);
  @ assigns m->temporary_flag[..][..], m->accumulated_flag[..][..], m->height_mm[..][..], m->obstacle_height_mm[..][..];
  @ ensures temporary: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_TEMPORARY_MERGED(Pre, Post, iy, ix);
  @ ensures flag: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_FLAG_MERGED(Pre, Post, iy, ix, threshold_mm, continuous);
  @ ensures height: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_HEIGHT_MERGED(Pre, Post, iy, ix, threshold_mm, continuous);
  @ ensures obstacle: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_OBSTACLE_MERGED(Pre, Post, iy, ix);
  @*/
static void sk_merge_all(sk_monitor *m, int32_t threshold_mm, bool continuous)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant done_temporary: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> SK_TEMPORARY_MERGED(Pre, Here, j, i);
    @ loop invariant done_flag: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==>
    @   SK_FLAG_MERGED(Pre, Here, j, i, threshold_mm, continuous);
    @ loop invariant done_height: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==>
    @   SK_HEIGHT_MERGED(Pre, Here, j, i, threshold_mm, continuous);
    @ loop invariant done_obstacle: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> SK_OBSTACLE_MERGED(Pre, Here, j, i);
    @ loop invariant rest_temporary: \forall integer j, i; iy <= j < SK_MAP_CELLS && 0 <= i < SK_MAP_CELLS ==>
    @   m->temporary_flag[j][i] == \at(m->temporary_flag[j][i], Pre);
    @ loop invariant rest_flag: \forall integer j, i; iy <= j < SK_MAP_CELLS && 0 <= i < SK_MAP_CELLS ==>
    @   m->accumulated_flag[j][i] == \at(m->accumulated_flag[j][i], Pre);
    @ loop invariant rest_height: \forall integer j, i; iy <= j < SK_MAP_CELLS && 0 <= i < SK_MAP_CELLS ==>
    @   m->height_mm[j][i] == \at(m->height_mm[j][i], Pre);
    @ loop invariant rest_obstacle: \forall integer j, i; iy <= j < SK_MAP_CELLS && 0 <= i < SK_MAP_CELLS ==>
    @   m->obstacle_height_mm[j][i] == \at(m->obstacle_height_mm[j][i], Pre);
    @ loop assigns iy, m->temporary_flag[..][..], m->accumulated_flag[..][..], m->height_mm[..][..], m->obstacle_height_mm[..][..];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) {
    /*@ assert as_before: \forall integer j, i; j == iy && 0 <= i < SK_MAP_CELLS ==> SK_CELL_KEPT(Pre, Here, j, i); */
    sk_merge_row(m, iy, threshold_mm, continuous);
    /*@ assert above_temporary: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> SK_TEMPORARY_MERGED(Pre, Here, j, i); */
    /*@ assert above_flag: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==>
      @   SK_FLAG_MERGED(Pre, Here, j, i, threshold_mm, continuous); */
    /*@ assert above_height: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==>
      @   SK_HEIGHT_MERGED(Pre, Here, j, i, threshold_mm, continuous); */
    /*@ assert above_obstacle: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> SK_OBSTACLE_MERGED(Pre, Here, j, i); */
    /*@ assert this: \forall integer j, i; j == iy && 0 <= i < SK_MAP_CELLS ==> SK_CELL_MERGED(Pre, Here, j, i, threshold_mm, continuous); */
  }
}

/*@ requires \valid(m) && sk_monitor_valid(m) && m->overflowed == false;
  @ assigns m->temporary_flag[..][..], m->accumulated_flag[..][..], m->height_mm[..][..], m->obstacle_height_mm[..][..];
  @ ensures valid: sk_monitor_valid(m);
  @ ensures temporary: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_TEMPORARY_MERGED(Pre, Post, iy, ix);
  @ ensures flag: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_FLAG_MERGED(Pre, Post, iy, ix, threshold_mm, continuous);
  @ ensures height: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_HEIGHT_MERGED(Pre, Post, iy, ix, threshold_mm, continuous);
  @ ensures obstacle: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_OBSTACLE_MERGED(Pre, Post, iy, ix);
  @*/
static void sk_merge_listed(sk_monitor *m, int32_t threshold_mm, bool continuous)
{
  int64_t k;
  /*@ loop invariant 0 <= k <= m->modified;
    @ loop invariant done_temporary: \forall integer j, i; sk_in_map(j, i) && sk_listed(m, j, i) && m->place[j][i] < k ==>
    @   SK_TEMPORARY_MERGED(Pre, Here, j, i);
    @ loop invariant done_flag: \forall integer j, i; sk_in_map(j, i) && sk_listed(m, j, i) && m->place[j][i] < k ==>
    @   SK_FLAG_MERGED(Pre, Here, j, i, threshold_mm, continuous);
    @ loop invariant done_height: \forall integer j, i; sk_in_map(j, i) && sk_listed(m, j, i) && m->place[j][i] < k ==>
    @   SK_HEIGHT_MERGED(Pre, Here, j, i, threshold_mm, continuous);
    @ loop invariant done_obstacle: \forall integer j, i; sk_in_map(j, i) && sk_listed(m, j, i) && m->place[j][i] < k ==>
    @   SK_OBSTACLE_MERGED(Pre, Here, j, i);
    @ loop invariant rest_temporary: \forall integer j, i; sk_in_map(j, i) && !(sk_listed(m, j, i) && m->place[j][i] < k) ==>
    @   m->temporary_flag[j][i] == \at(m->temporary_flag[j][i], Pre);
    @ loop invariant rest_flag: \forall integer j, i; sk_in_map(j, i) && !(sk_listed(m, j, i) && m->place[j][i] < k) ==>
    @   m->accumulated_flag[j][i] == \at(m->accumulated_flag[j][i], Pre);
    @ loop invariant rest_height: \forall integer j, i; sk_in_map(j, i) && !(sk_listed(m, j, i) && m->place[j][i] < k) ==>
    @   m->height_mm[j][i] == \at(m->height_mm[j][i], Pre);
    @ loop invariant rest_obstacle: \forall integer j, i; sk_in_map(j, i) && !(sk_listed(m, j, i) && m->place[j][i] < k) ==>
    @   m->obstacle_height_mm[j][i] == \at(m->obstacle_height_mm[j][i], Pre);
    @ loop assigns k, m->temporary_flag[..][..], m->accumulated_flag[..][..], m->height_mm[..][..], m->obstacle_height_mm[..][..];
    @ loop variant m->modified - k;
    @*/
  for (k = 0; k < m->modified; k++) {
    /*@ assert listed: sk_entry_ok(m, k); */
    int32_t iy = (int32_t)m->modified_iy[k];
    int32_t ix = (int32_t)m->modified_ix[k];
    /*@ assert entry: sk_in_map(iy, ix) && sk_listed(m, iy, ix) && m->place[iy][ix] == k; */
    /*@ assert no_other: \forall integer j, i; sk_in_map(j, i) && sk_listed(m, j, i) && m->place[j][i] == k ==> j == iy && i == ix; */
    /*@ assert as_before: \forall integer j, i; j == iy && i == ix ==> SK_CELL_KEPT(Pre, Here, j, i); */
    sk_merge_one(m, iy, ix, threshold_mm, continuous);
    /*@ assert this: \forall integer j, i; j == iy && i == ix ==> SK_CELL_MERGED(Pre, Here, j, i, threshold_mm, continuous); */
  }
}

/* What was merged leaves the list; from the last entry down, so that what takes its place was looked at already. */
/*@ requires \valid(m) && sk_monitor_valid(m) && m->overflowed == false;
  @ assigns m->modified_iy[..], m->modified_ix[..], m->place[..][..], m->modified;
  @ ensures sk_monitor_valid(m);
  @*/
static void sk_list_shorten(sk_monitor *m)
{
  int64_t k;
  /*@ loop invariant 0 <= k <= m->modified;
    @ loop invariant list: sk_list_ok(m);
    @ loop invariant listed: \forall integer j, i; sk_in_map(j, i) && m->temporary_flag[j][i] != SK_FLAG_EMPTY ==> sk_listed(m, j, i);
    @ loop assigns k, m->modified_iy[..], m->modified_ix[..], m->place[..][..], m->modified;
    @ loop variant k;
    @*/
  for (k = m->modified; k > 0; k--) {
    /*@ assert listed: sk_entry_ok(m, k - 1); */
    int32_t iy = (int32_t)m->modified_iy[k - 1];
    int32_t ix = (int32_t)m->modified_ix[k - 1];
    /*@ assert no_other: \forall integer j, i; sk_in_map(j, i) && sk_listed(m, j, i) && m->place[j][i] == k - 1 ==> j == iy && i == ix; */
    if (m->temporary_flag[iy][ix] == SK_FLAG_EMPTY) { sk_list_remove(m, k - 1); }
  }
}

void sk_merge_modified(sk_monitor *m, const sk_monitor_rules *r)
{
  if (m->overflowed) {
    sk_merge_all(m, r->height_threshold_mm, r->continuous);
    sk_list_anew(m);
  } else {
    sk_merge_listed(m, r->height_threshold_mm, r->continuous);
    sk_list_shorten(m);
  }
}
