/* The safety region, and the question whether an obstacle is in it. */
#ifndef SK_MONITOR_REGION_H
#define SK_MONITOR_REGION_H
#include "monitor_rules.h"
#include "parameter_rules.h"
SK_BEGIN

typedef struct sk_monitor_cell { int32_t iy, ix; } sk_monitor_cell;

/*@ // the coordinate of a cell's closed interval that is nearest the origin
  @ logic integer sk_nearest(integer i) = sk_cell_low(i) > 0 ? sk_cell_low(i) : (sk_cell_low(i) + SK_CELL_MM < 0 ? sk_cell_low(i) + SK_CELL_MM : 0);
  @ predicate sk_reaches(integer iy, integer ix, integer radius) =
  @   sk_nearest(ix) * sk_nearest(ix) + sk_nearest(iy) * sk_nearest(iy) <= radius * radius;
  @ predicate sk_touches(integer iy, integer ix, integer x_low, integer y_low, integer x_high, integer y_high) =
  @   sk_cell_low(ix) <= x_high && sk_cell_low(ix) + SK_CELL_MM >= x_low && sk_cell_low(iy) <= y_high && sk_cell_low(iy) + SK_CELL_MM >= y_low;
  @ predicate sk_digs_at(berm_parameters *p, integer k, integer iy, integer ix) =
  @   sk_touches(iy, ix, p->dig_zone[k].x_low_mm, p->dig_zone[k].y_low_mm, p->dig_zone[k].x_high_mm, p->dig_zone[k].y_high_mm);
  @ predicate sk_loads_at(berm_parameters *p, integer k, integer iy, integer ix) =
  @   sk_touches(iy, ix, p->truck_zone[k].x_low_mm, p->truck_zone[k].y_low_mm, p->truck_zone[k].x_high_mm, p->truck_zone[k].y_high_mm);
  @ predicate sk_drives_at(berm_parameters *p, integer k, integer iy, integer ix) =
  @   sk_touches(iy, ix, p->lane[k].x_low_mm, p->lane[k].y_low_mm, p->lane[k].x_high_mm, p->lane[k].y_high_mm);
  @ predicate sk_digs(berm_parameters *p, integer iy, integer ix) = \exists integer k; 0 <= k < p->dig_zones && sk_digs_at(p, k, iy, ix);
  @ predicate sk_loads(berm_parameters *p, integer iy, integer ix) = \exists integer k; 0 <= k < p->truck_zones && sk_loads_at(p, k, iy, ix);
  @ predicate sk_drives(berm_parameters *p, integer iy, integer ix) = \exists integer k; 0 <= k < p->lanes && sk_drives_at(p, k, iy, ix);
  @ // within the radius; without the own body, what the machine itself changes (soil, the load of a truck), and, open, the lanes
  @ predicate sk_watches(berm_parameters *p, integer lanes_open, integer iy, integer ix) = sk_reaches(iy, ix, p->workspace_radius_mm) &&
  @   !sk_reaches(iy, ix, p->own_body_radius_mm) && !sk_digs(p, iy, ix) && !sk_loads(p, iy, ix) && !(lanes_open != 0 && sk_drives(p, iy, ix));
  @ // what of the parameters the region takes
  @ predicate sk_region_rules_ok(berm_parameters *p) = 0 < p->workspace_radius_mm <= 15000 && 0 < p->own_body_radius_mm <= 15000 &&
  @   sk_rule_dig_zone_count(p) && sk_rule_truck_zone_count(p) && sk_rule_lane_count(p);
  @*/

/*@ requires sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_touches(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm);
  @*/
static inline bool sk_is_touched(int32_t iy, int32_t ix, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm)
{
  int32_t x_mm = SK_CELL_MM * ix + SK_MAP_ORIGIN_MM, y_mm = SK_CELL_MM * iy + SK_MAP_ORIGIN_MM;
  return x_mm <= x_high_mm && x_mm + SK_CELL_MM >= x_low_mm && y_mm <= y_high_mm && y_mm + SK_CELL_MM >= y_low_mm;
}

/* The region of the parameter block: its circle, less what the machine itself changes, and less the lanes while they are open to trucks. */
/*@ requires \valid(r) && \valid_read(p) && sk_region_rules_ok(p);
  @ assigns r->watched[0 .. SK_MAP_CELLS - 1][0 .. SK_MAP_CELLS - 1];
  @ ensures \forall integer iy, ix; sk_in_map(iy, ix) ==> (r->watched[iy][ix] != 0 <==> sk_watches(p, lanes_open, iy, ix));
  @*/
void sk_watch_region(sk_monitor_rules *r, const berm_parameters *p, bool lanes_open);

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
