#include "monitor_histogram.h"

/* The first cell of the row with somebody in it that is watched, or -1. */
/*@ requires \valid_read(h) && \valid_read(r) && 0 <= iy < SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures range: -1 <= \result < SK_MAP_CELLS;
  @ ensures found: \result >= 0 ==> sk_somebody_watched(h, r, iy, \result);
  @ ensures none: \result < 0 ==> \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> !sk_somebody_watched(h, r, iy, ix);
  @*/
static int32_t sk_somebody_in_row(const sk_monitor_histogram *h, const sk_monitor_rules *r, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant \forall integer i; 0 <= i < ix ==> !sk_somebody_watched(h, r, iy, i);
    @ loop assigns ix;
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    if (h->state[iy][ix] != SK_CELL_LEARNING && h->state[iy][ix] != SK_CELL_CLEAR && r->watched[iy][ix] != 0U) { return ix; }
  }
  return -1;
}

/*@ requires \valid_read(h) && \valid_read(r) && \valid(where) && \separated(where, h) && \separated(where, r);
  @ assigns *where;
  @ ensures found: \result == true <==> sk_somebody_in_region{Pre}(h, r);
  @ ensures where: \result == true ==> sk_in_map(where->iy, where->ix) && sk_somebody_watched{Pre}(h, r, where->iy, where->ix);
  @ ensures nowhere: \result == false ==> where->iy == -1 && where->ix == -1;
  @*/
static bool sk_find_somebody(const sk_monitor_histogram *h, const sk_monitor_rules *r, sk_monitor_cell *where)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> !sk_somebody_watched(h, r, j, i);
    @ loop assigns iy;
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) {
    int32_t ix = sk_somebody_in_row(h, r, iy);
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

bool sk_histogram_step(sk_monitor_histogram *h, const sk_monitor_rules *r, int64_t now_us, sk_monitor_cell *where)
{
  int32_t dwell_us = r->dwell_us;
  if (now_us < 0 || !sk_do_monitor_rules_fit(r)) {
    where->iy = -1;
    where->ix = -1;
    return true;
  }
  if (sk_find_somebody(h, r, where)) {
    h->somebody_us = now_us;
    return true;
  }
  return sk_is_monitor_dwelling(h->somebody_us, dwell_us, now_us);
}
