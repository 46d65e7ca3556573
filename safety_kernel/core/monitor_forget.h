/* What the Workspace Monitor learns anew where the ground has become another one: a truck has come. */
#ifndef SK_MONITOR_FORGET_H
#define SK_MONITOR_FORGET_H
#include "workspace_monitor.h"
SK_BEGIN

/* Forgets every cell that touches the rectangle, and no other. Whoever calls this must know that nobody is in it. */
/*@ requires \valid(m) && sk_monitor_valid(m);
  @ assigns m->temporary_flag[..][..], m->highest_mm[..][..], m->second_mm[..][..], m->accumulated_flag[..][..], m->height_mm[..][..],
  @   m->obstacle_height_mm[..][..];
  @ ensures valid: sk_monitor_valid(m);
  @ ensures forgotten: \forall integer iy, ix; sk_in_map(iy, ix) && sk_touches(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==> sk_cell_blank(m, iy, ix);
  @ ensures others: \forall integer iy, ix; sk_in_map(iy, ix) && !sk_touches(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
  @   sk_all_kept{Pre, Post}(m, iy, ix);
  @*/
void sk_forget_rectangle(sk_monitor *m, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm);

SK_END
#endif
