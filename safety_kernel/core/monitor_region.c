#include "monitor_region.h"

/*@ requires 0 <= i < SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures \result == sk_nearest(i) && -SK_COORD_MAX_MM <= \result <= SK_COORD_MAX_MM;
  @*/
static int32_t sk_nearest_mm(int32_t i)
{
  int32_t low_mm = SK_CELL_MM * i + SK_MAP_ORIGIN_MM;
  if (low_mm > 0) { return low_mm; }
  return low_mm + SK_CELL_MM < 0 ? low_mm + SK_CELL_MM : 0;
}

/*@ requires -SK_COORD_MAX_MM <= v_mm <= SK_COORD_MAX_MM;
  @ assigns \nothing;
  @ ensures \result == v_mm * v_mm && 0 <= \result <= SK_COORD_MAX_MM * SK_COORD_MAX_MM;
  @*/
static int64_t sk_square_mm2(int32_t v_mm)
{
  return (int64_t)v_mm * v_mm;
}

/*@ requires sk_in_map(iy, ix) && 0 < radius_mm <= SK_COORD_MAX_MM;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_reaches(iy, ix, radius_mm);
  @*/
static bool sk_is_reached(int32_t iy, int32_t ix, int32_t radius_mm)
{
  return sk_square_mm2(sk_nearest_mm(ix)) + sk_square_mm2(sk_nearest_mm(iy)) <= sk_square_mm2(radius_mm);
}

/*@ requires \valid_read(p) && sk_in_map(iy, ix) && 0 <= p->dig_zones <= BERM_DIG_ZONES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_digs(p, iy, ix);
  @*/
static bool sk_is_dug(const berm_parameters *p, int32_t iy, int32_t ix)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->dig_zones;
    @ loop invariant \forall integer i; 0 <= i < k ==> !sk_digs_at(p, i, iy, ix);
    @ loop assigns k;
    @ loop variant p->dig_zones - k;
    @*/
  for (k = 0; k < p->dig_zones; k++) {
    if (sk_is_touched(iy, ix, p->dig_zone[k].x_low_mm, p->dig_zone[k].y_low_mm, p->dig_zone[k].x_high_mm, p->dig_zone[k].y_high_mm)) { return true; }
  }
  return false;
}

/*@ requires \valid_read(p) && sk_in_map(iy, ix) && 0 <= p->truck_zones <= BERM_TRUCK_ZONES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_loads(p, iy, ix);
  @*/
static bool sk_is_loaded(const berm_parameters *p, int32_t iy, int32_t ix)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->truck_zones;
    @ loop invariant \forall integer i; 0 <= i < k ==> !sk_loads_at(p, i, iy, ix);
    @ loop assigns k;
    @ loop variant p->truck_zones - k;
    @*/
  for (k = 0; k < p->truck_zones; k++) {
    if (sk_is_touched(iy, ix, p->truck_zone[k].x_low_mm, p->truck_zone[k].y_low_mm, p->truck_zone[k].x_high_mm, p->truck_zone[k].y_high_mm)) { return true; }
  }
  return false;
}

/*@ requires \valid_read(p) && sk_in_map(iy, ix) && 0 <= p->lanes <= BERM_LANES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_drives(p, iy, ix);
  @*/
static bool sk_is_driven(const berm_parameters *p, int32_t iy, int32_t ix)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->lanes;
    @ loop invariant \forall integer i; 0 <= i < k ==> !sk_drives_at(p, i, iy, ix);
    @ loop assigns k;
    @ loop variant p->lanes - k;
    @*/
  for (k = 0; k < p->lanes; k++) {
    if (sk_is_touched(iy, ix, p->lane[k].x_low_mm, p->lane[k].y_low_mm, p->lane[k].x_high_mm, p->lane[k].y_high_mm)) { return true; }
  }
  return false;
}

/*@ requires \valid_read(p) && sk_in_map(iy, ix) && sk_region_rules_ok(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_watches(p, lanes_open, iy, ix);
  @*/
static bool sk_is_watched(const berm_parameters *p, bool lanes_open, int32_t iy, int32_t ix)
{
  if (!sk_is_reached(iy, ix, p->workspace_radius_mm) || sk_is_reached(iy, ix, p->own_body_radius_mm)) { return false; }
  if (sk_is_dug(p, iy, ix) || sk_is_loaded(p, iy, ix)) { return false; }
  return !(lanes_open && sk_is_driven(p, iy, ix));
}

/*@ requires \valid(r) && \valid_read(p) && 0 <= iy < SK_MAP_CELLS && sk_region_rules_ok(p);
  @ assigns r->watched[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> (r->watched[iy][ix] != 0 <==> sk_watches(p, lanes_open, iy, ix));
  @*/
static void sk_watch_row(sk_monitor_rules *r, const berm_parameters *p, bool lanes_open, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant \forall integer i; 0 <= i < ix ==> (r->watched[iy][i] != 0 <==> sk_watches(p, lanes_open, iy, i));
    @ loop assigns ix, r->watched[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) { r->watched[iy][ix] = sk_is_watched(p, lanes_open, iy, ix) ? 1U : 0U; }
}

void sk_watch_region(sk_monitor_rules *r, const berm_parameters *p, bool lanes_open)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> (r->watched[j][i] != 0 <==> sk_watches(p, lanes_open, j, i));
    @ loop assigns iy, r->watched[0 .. SK_MAP_CELLS - 1][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_watch_row(r, p, lanes_open, iy); }
}

/* The first cell of the row that is in danger, or -1. */
/*@ requires \valid_read(m) && \valid_read(r) && 0 <= iy < SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures range: -1 <= \result < SK_MAP_CELLS;
  @ ensures found: \result >= 0 ==> sk_in_danger(m, r, iy, \result);
  @ ensures none: \result < 0 ==> \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> !sk_in_danger(m, r, iy, ix);
  @*/
static int32_t sk_find_in_row(const sk_monitor *m, const sk_monitor_rules *r, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant \forall integer i; 0 <= i < ix ==> !sk_in_danger(m, r, iy, i);
    @ loop assigns ix;
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    if (sk_flag_is_obstacle(m->accumulated_flag[iy][ix]) && r->watched[iy][ix] != 0U) { return ix; }
  }
  return -1;
}

bool sk_find_obstacle(const sk_monitor *m, const sk_monitor_rules *r, sk_monitor_cell *where)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> !sk_in_danger(m, r, j, i);
    @ loop assigns iy;
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) {
    int32_t ix = sk_find_in_row(m, r, iy);
    if (ix >= 0) {
      where->iy = iy;
      where->ix = ix;
      return true;
    }
  }
  where->iy = -1;
  where->ix = -1;
  return false;
}
