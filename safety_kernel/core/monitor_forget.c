#include "monitor_forget.h"

/*@ requires \valid(m) && sk_monitor_valid(m) && 0 <= iy < SK_MAP_CELLS;
  @ assigns m->temporary_flag[..][..], m->highest_mm[..][..], m->second_mm[..][..], m->accumulated_flag[..][..], m->height_mm[..][..],
  @   m->obstacle_height_mm[..][..];
  @ ensures valid: sk_monitor_valid(m);
  @ ensures forgotten: \forall integer ix; 0 <= ix < SK_MAP_CELLS && sk_touches(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==> sk_cell_blank(m, iy, ix);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && sk_touches(j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) ==>
  @   sk_all_kept{Pre, Post}(m, j, i);
  @*/
static void forget_row(sk_monitor *m, int32_t iy, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant valid: sk_monitor_valid(m);
    @ loop invariant forgotten: \forall integer i; 0 <= i < ix && sk_touches(iy, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==> sk_cell_blank(m, iy, i);
    @ loop invariant others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i < ix && sk_touches(j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) ==>
    @   sk_all_kept{Pre, Here}(m, j, i);
    @ loop assigns ix, m->temporary_flag[..][..], m->highest_mm[..][..], m->second_mm[..][..], m->accumulated_flag[..][..], m->height_mm[..][..],
    @   m->obstacle_height_mm[..][..];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    if (sk_is_touched(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) { sk_monitor_forget(m, iy, ix); }
  }
}

void sk_forget_rectangle(sk_monitor *m, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant valid: sk_monitor_valid(m);
    @ loop invariant forgotten: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS && sk_touches(j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
    @   sk_cell_blank(m, j, i);
    @ loop invariant others: \forall integer j, i; sk_in_map(j, i) && !(j < iy && sk_touches(j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) ==>
    @   sk_all_kept{Pre, Here}(m, j, i);
    @ loop assigns iy, m->temporary_flag[..][..], m->highest_mm[..][..], m->second_mm[..][..], m->accumulated_flag[..][..], m->height_mm[..][..],
    @   m->obstacle_height_mm[..][..];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { forget_row(m, iy, x_low_mm, y_low_mm, x_high_mm, y_high_mm); }
}
