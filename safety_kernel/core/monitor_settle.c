#include "monitor_settle.h"

/*@ requires \valid(m) && sk_in_map(iy, ix);
  @ assigns m->accumulated_flag[iy][ix], m->height_mm[iy][ix];
  @ ensures settled: \old(m->accumulated_flag[iy][ix]) == SK_FLAG_CHANGED ==> m->accumulated_flag[iy][ix] == SK_FLAG_SET &&
  @   m->height_mm[iy][ix] == (continuous ? \old(m->height_mm[iy][ix]) : m->obstacle_height_mm[iy][ix]);
  @ ensures other: \old(m->accumulated_flag[iy][ix]) != SK_FLAG_CHANGED ==>
  @   m->accumulated_flag[iy][ix] == \old(m->accumulated_flag[iy][ix]) && m->height_mm[iy][ix] == \old(m->height_mm[iy][ix]);
  @*/
static void settle_cell(sk_monitor *m, bool continuous, int32_t iy, int32_t ix)
{
  if (m->accumulated_flag[iy][ix] != SK_FLAG_CHANGED) { return; }
  m->accumulated_flag[iy][ix] = SK_FLAG_SET;
  if (!continuous) { m->height_mm[iy][ix] = m->obstacle_height_mm[iy][ix]; }
}

/*@ requires \valid(m) && 0 <= iy < SK_MAP_CELLS;
  @ assigns m->accumulated_flag[iy][0 .. SK_MAP_CELLS - 1], m->height_mm[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures settled: \forall integer i; 0 <= i < SK_MAP_CELLS && sk_settles{Pre}(m, iy, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
  @   m->accumulated_flag[iy][i] == SK_FLAG_SET && m->height_mm[iy][i] == (continuous ? \old(m->height_mm[iy][i]) : m->obstacle_height_mm[iy][i]);
  @ ensures others: \forall integer i; 0 <= i < SK_MAP_CELLS && !sk_settles{Pre}(m, iy, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
  @   m->accumulated_flag[iy][i] == \old(m->accumulated_flag[iy][i]) && m->height_mm[iy][i] == \old(m->height_mm[iy][i]);
  @*/
static void settle_row(sk_monitor *m, bool continuous, int32_t iy, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant settled: \forall integer i; 0 <= i < ix && sk_settles{Pre}(m, iy, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
    @   m->accumulated_flag[iy][i] == SK_FLAG_SET &&
    @   m->height_mm[iy][i] == (continuous ? \at(m->height_mm[iy][i], Pre) : m->obstacle_height_mm[iy][i]);
    @ loop invariant others: \forall integer i; 0 <= i < SK_MAP_CELLS && !(i < ix && sk_settles{Pre}(m, iy, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) ==>
    @   m->accumulated_flag[iy][i] == \at(m->accumulated_flag[iy][i], Pre) && m->height_mm[iy][i] == \at(m->height_mm[iy][i], Pre);
    @ loop assigns ix, m->accumulated_flag[iy][0 .. SK_MAP_CELLS - 1], m->height_mm[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    if (sk_is_touched(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) { settle_cell(m, continuous, iy, ix); }
  }
}

void sk_settle_rectangle(sk_monitor *m, bool continuous, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant settled: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS &&
    @   sk_settles{Pre}(m, j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==> m->accumulated_flag[j][i] == SK_FLAG_SET &&
    @   m->height_mm[j][i] == (continuous ? \at(m->height_mm[j][i], Pre) : m->obstacle_height_mm[j][i]);
    @ loop invariant others: \forall integer j, i; sk_in_map(j, i) && !(j < iy && sk_settles{Pre}(m, j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) ==>
    @   m->accumulated_flag[j][i] == \at(m->accumulated_flag[j][i], Pre) && m->height_mm[j][i] == \at(m->height_mm[j][i], Pre);
    @ loop assigns iy, m->accumulated_flag[..][..], m->height_mm[..][..];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { settle_row(m, continuous, iy, x_low_mm, y_low_mm, x_high_mm, y_high_mm); }
}
