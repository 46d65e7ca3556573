/* The safety region, and the question whether an obstacle is in it. */
#ifndef SK_MONITOR_REGION_H
#define SK_MONITOR_REGION_H
#include "monitor_rules.h"
SK_BEGIN

typedef struct sk_monitor_cell { int32_t iy, ix; } sk_monitor_cell;

/*@ // the coordinate of a cell's closed interval that is nearest the origin
  @ logic integer sk_nearest(integer i) = sk_cell_low(i) > 0 ? sk_cell_low(i) : (sk_cell_low(i) + SK_CELL_MM < 0 ? sk_cell_low(i) + SK_CELL_MM : 0);
  @ predicate sk_reaches(integer iy, integer ix, integer radius) =
  @   sk_nearest(ix) * sk_nearest(ix) + sk_nearest(iy) * sk_nearest(iy) <= radius * radius;
  @*/

/* The region of every cell that has a point within radius_mm of the swing axis. False, and nothing changed, unless 0 < radius_mm <= SK_COORD_MAX_MM. */
/*@ requires \valid(r);
  @ assigns r->watched[0 .. SK_MAP_CELLS - 1][0 .. SK_MAP_CELLS - 1];
  @ ensures accepts: \result == true <==> 0 < radius_mm <= SK_COORD_MAX_MM;
  @ ensures refused: \result == false ==> \forall integer iy, ix; sk_in_map(iy, ix) ==> r->watched[iy][ix] == \old(r->watched[iy][ix]);
  @ ensures circle: \result == true ==> \forall integer iy, ix; sk_in_map(iy, ix) ==> (r->watched[iy][ix] != 0 <==> sk_reaches(iy, ix, radius_mm));
  @*/
bool sk_watch_circle(sk_monitor_rules *r, int32_t radius_mm);

/* Takes one cell out of the region (the own body, a dig zone); sk_watch_circle puts it back. False, and nothing changed, outside the map. */
/*@ requires \valid(r);
  @ assigns r->watched[0 .. SK_MAP_CELLS - 1][0 .. SK_MAP_CELLS - 1];
  @ ensures accepts: \result == true <==> sk_in_map(iy, ix);
  @ ensures excluded: \result == true ==> r->watched[iy][ix] == 0;
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> r->watched[j][i] == \old(r->watched[j][i]);
  @ ensures refused: \result == false ==> \forall integer j, i; sk_in_map(j, i) ==> r->watched[j][i] == \old(r->watched[j][i]);
  @*/
bool sk_region_exclude(sk_monitor_rules *r, int32_t iy, int32_t ix);

/* Whether an obstacle, or a flag that is none, is in the region; the first such cell into *where, or -1, -1. */
/*@ requires \valid_read(m) && \valid_read(r) && \valid(where) && \separated(where, m) && \separated(where, r);
  @ assigns *where;
  @ ensures found: \result == true <==> sk_obstacle_in_region{Pre}(m, r);
  @ ensures where: \result == true ==> sk_in_map(where->iy, where->ix) && sk_in_danger{Pre}(m, r, where->iy, where->ix);
  @ ensures nowhere: \result == false ==> where->iy == -1 && where->ix == -1;
  @*/
bool sk_find_obstacle(const sk_monitor *m, const sk_monitor_rules *r, sk_monitor_cell *where);

SK_END
#endif
