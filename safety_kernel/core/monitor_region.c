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
  @ ensures \result != 0 <==> sk_reaches(iy, ix, radius_mm);
  @*/
static uint8_t sk_is_reached(int32_t iy, int32_t ix, int32_t radius_mm)
{
  int64_t distance_mm2 = sk_square_mm2(sk_nearest_mm(ix)) + sk_square_mm2(sk_nearest_mm(iy));
  return distance_mm2 <= sk_square_mm2(radius_mm) ? 1U : 0U;
}

/*@ requires \valid(r) && 0 <= iy < SK_MAP_CELLS && 0 < radius_mm <= SK_COORD_MAX_MM;
  @ assigns r->watched[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> (r->watched[iy][ix] != 0 <==> sk_reaches(iy, ix, radius_mm));
  @*/
static void sk_watch_row(sk_monitor_rules *r, int32_t iy, int32_t radius_mm)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant \forall integer i; 0 <= i < ix ==> (r->watched[iy][i] != 0 <==> sk_reaches(iy, i, radius_mm));
    @ loop assigns ix, r->watched[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) { r->watched[iy][ix] = sk_is_reached(iy, ix, radius_mm); }
}

bool sk_watch_circle(sk_monitor_rules *r, int32_t radius_mm)
{
  int32_t iy;
  if (radius_mm <= 0 || radius_mm > SK_COORD_MAX_MM) { return false; }
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> (r->watched[j][i] != 0 <==> sk_reaches(j, i, radius_mm));
    @ loop assigns iy, r->watched[0 .. SK_MAP_CELLS - 1][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_watch_row(r, iy, radius_mm); }
  return true;
}

bool sk_region_exclude(sk_monitor_rules *r, int32_t iy, int32_t ix)
{
  if (!sk_is_in_map(iy, ix)) { return false; }
  r->watched[iy][ix] = 0U;
  return true;
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
