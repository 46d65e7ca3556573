/* What the Workspace Monitor makes of the cells that changed while it learned the ground: their ground. */
#ifndef SK_MONITOR_SETTLE_H
#define SK_MONITOR_SETTLE_H
#include "workspace_monitor.h"
SK_BEGIN

/*@ predicate sk_settles{L}(sk_monitor *m, integer iy, integer ix, integer x_low, integer y_low, integer x_high, integer y_high) =
  @   sk_touches(iy, ix, x_low, y_low, x_high, y_high) && \at(m->accumulated_flag[iy][ix], L) == SK_FLAG_CHANGED;
  @*/

/* Every CHANGED cell that touches the rectangle is SET. What stands there now is its height; where the map follows what is seen it is so already. No
 * other cell changes: an obstacle stays one. What is still CHANGED after the ground has been learned explains no rise beside it (CheckCell), so that
 * the rims of what stands there, seen now high and now low, would be obstacles. Whoever calls this must know that nobody is in the rectangle. */
/*@ requires \valid(m) && sk_monitor_valid(m);
  @ assigns m->accumulated_flag[..][..], m->height_mm[..][..];
  @ ensures valid: sk_monitor_valid(m);
  @ ensures settled: \forall integer iy, ix; sk_in_map(iy, ix) && sk_settles{Pre}(m, iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
  @   m->accumulated_flag[iy][ix] == SK_FLAG_SET &&
  @   m->height_mm[iy][ix] == (continuous ? \old(m->height_mm[iy][ix]) : m->obstacle_height_mm[iy][ix]);
  @ ensures others: \forall integer iy, ix; sk_in_map(iy, ix) && !sk_settles{Pre}(m, iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
  @   m->accumulated_flag[iy][ix] == \old(m->accumulated_flag[iy][ix]) && m->height_mm[iy][ix] == \old(m->height_mm[iy][ix]);
  @*/
void sk_settle_rectangle(sk_monitor *m, bool continuous, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm);

SK_END
#endif
