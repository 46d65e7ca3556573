#include "monitor_histogram.h"

/*@ requires \valid(h) && sk_in_map(iy, ix);
  @ assigns h->seen[iy][ix][0 .. SK_HISTOGRAM_BINS - 1];
  @ ensures sk_bins_blank(h, iy, ix);
  @*/
static void sk_blank_bins(sk_monitor_histogram *h, int32_t iy, int32_t ix)
{
  int32_t b;
  /*@ loop invariant 0 <= b <= SK_HISTOGRAM_BINS;
    @ loop invariant \forall integer c; 0 <= c < b ==> h->seen[iy][ix][c] == 0;
    @ loop assigns b, h->seen[iy][ix][0 .. SK_HISTOGRAM_BINS - 1];
    @ loop variant SK_HISTOGRAM_BINS - b;
    @*/
  for (b = 0; b < SK_HISTOGRAM_BINS; b++) { h->seen[iy][ix][b] = 0U; }
}

/*@ requires \valid(h) && sk_in_map(iy, ix);
  @ assigns h->seen[..][..][..], h->state[..][..], h->observed[..][..], h->line_mm[..][..], h->lines[..][..], h->departed_mm[..][..],
  @   h->departed_us[..][..][..], h->ground_us[..][..];
  @ ensures blank: sk_histogram_blank(h, iy, ix);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_cell_kept{Pre, Post}(h, j, i);
  @*/
static void sk_blank_histogram(sk_monitor_histogram *h, int32_t iy, int32_t ix)
{
  sk_blank_bins(h, iy, ix);
  /*@ assert other_bins: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_bins_kept{Pre, Here}(h, j, i); */
  h->state[iy][ix] = SK_CELL_LEARNING;
  h->observed[iy][ix] = 0U;
  h->line_mm[iy][ix] = 0;
  h->lines[iy][ix] = 0;
  h->departed_mm[iy][ix] = 0;
  h->departed_us[iy][ix][0] = -1;
  h->departed_us[iy][ix][1] = -1;
  h->ground_us[iy][ix] = SK_NO_GROUND;
  /*@ assert own_bins: sk_bins_blank(h, iy, ix); */
  /*@ assert still: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_bins_kept{Pre, Here}(h, j, i); */
  /*@ assert ground: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_ground_kept{Pre, Here}(h, j, i); */
  /*@ assert times: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_times_kept{Pre, Here}(h, j, i); */
}

/*@ requires \valid(h) && 0 <= iy < SK_MAP_CELLS;
  @ assigns h->seen[..][..][..], h->state[..][..], h->observed[..][..], h->line_mm[..][..], h->lines[..][..], h->departed_mm[..][..],
  @   h->departed_us[..][..][..], h->ground_us[..][..];
  @ ensures forgotten: \forall integer ix; 0 <= ix < SK_MAP_CELLS && sk_touches(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
  @   sk_histogram_blank(h, iy, ix);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && sk_touches(j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) ==>
  @   sk_cell_kept{Pre, Post}(h, j, i);
  @*/
static void sk_forget_histograms(sk_monitor_histogram *h, int32_t iy, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant forgotten: \forall integer i; 0 <= i < ix && sk_touches(iy, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
    @   sk_histogram_blank(h, iy, i);
    @ loop invariant others: \forall integer j, i; sk_in_map(j, i) &&
    @   !(j == iy && i < ix && sk_touches(j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) ==> sk_cell_kept{Pre, Here}(h, j, i);
    @ loop assigns ix, h->seen[..][..][..], h->state[..][..], h->observed[..][..], h->line_mm[..][..], h->lines[..][..], h->departed_mm[..][..],
    @   h->departed_us[..][..][..], h->ground_us[..][..];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    if (sk_is_touched(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) { sk_blank_histogram(h, iy, ix); }
    /*@ assert kept: \forall integer i; 0 <= i < ix ==> sk_cell_kept{LoopCurrent, Here}(h, iy, i); */
    /*@ assert kept_bins: \forall integer i, b; 0 <= i < ix && sk_in_bins(b) ==> h->seen[iy][i][b] == \at(h->seen[iy][i][b], LoopCurrent); */
    /*@ assert bins: \forall integer i; 0 <= i < ix && sk_bins_blank{LoopCurrent}(h, iy, i) ==> sk_bins_blank(h, iy, i); */
  }
}

void sk_histogram_forget(sk_monitor_histogram *h, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant forgotten: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS &&
    @   sk_touches(j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==> sk_histogram_blank(h, j, i);
    @ loop invariant others: \forall integer j, i; sk_in_map(j, i) && !(j < iy && sk_touches(j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) ==>
    @   sk_cell_kept{Pre, Here}(h, j, i);
    @ loop assigns iy, h->seen[..][..][..], h->state[..][..], h->observed[..][..], h->line_mm[..][..], h->lines[..][..], h->departed_mm[..][..],
    @   h->departed_us[..][..][..], h->ground_us[..][..];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_forget_histograms(h, iy, x_low_mm, y_low_mm, x_high_mm, y_high_mm); }
}

void sk_histogram_begin(sk_monitor_histogram *h)
{
  sk_histogram_forget(h, SK_MAP_ORIGIN_MM, SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM);
  h->somebody_us = -1;
}

/*@ requires \valid(h) && 0 <= iy < SK_MAP_CELLS;
  @ assigns h->state[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures settled: \forall integer i; 0 <= i < SK_MAP_CELLS && sk_touches(iy, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) &&
  @   \old(h->state[iy][i]) == SK_CELL_LEARNING ==> h->state[iy][i] == SK_CELL_CLEAR;
  @ ensures others: \forall integer i; 0 <= i < SK_MAP_CELLS && !(sk_touches(iy, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) &&
  @   \old(h->state[iy][i]) == SK_CELL_LEARNING) ==> h->state[iy][i] == \old(h->state[iy][i]);
  @*/
static void sk_settle_histograms(sk_monitor_histogram *h, int32_t iy, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant settled: \forall integer i; 0 <= i < ix && sk_touches(iy, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) &&
    @   \at(h->state[iy][i], Pre) == SK_CELL_LEARNING ==> h->state[iy][i] == SK_CELL_CLEAR;
    @ loop invariant others: \forall integer i; 0 <= i < SK_MAP_CELLS && !(i < ix && sk_touches(iy, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) &&
    @   \at(h->state[iy][i], Pre) == SK_CELL_LEARNING) ==> h->state[iy][i] == \at(h->state[iy][i], Pre);
    @ loop assigns ix, h->state[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    if (h->state[iy][ix] == SK_CELL_LEARNING && sk_is_touched(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm)) { h->state[iy][ix] = SK_CELL_CLEAR; }
  }
}

void sk_histogram_settle(sk_monitor_histogram *h, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant settled: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS && \at(h->state[j][i], Pre) == SK_CELL_LEARNING &&
    @   sk_touches(j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==> h->state[j][i] == SK_CELL_CLEAR;
    @ loop invariant others: \forall integer j, i; sk_in_map(j, i) && !(j < iy && sk_touches(j, i, x_low_mm, y_low_mm, x_high_mm, y_high_mm) &&
    @   \at(h->state[j][i], Pre) == SK_CELL_LEARNING) ==> h->state[j][i] == \at(h->state[j][i], Pre);
    @ loop assigns iy, h->state[..][..];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_settle_histograms(h, iy, x_low_mm, y_low_mm, x_high_mm, y_high_mm); }
}

void sk_histogram_forget_cell(sk_monitor_histogram *h, int32_t iy, int32_t ix)
{
  if (sk_is_in_map(iy, ix)) { sk_blank_histogram(h, iy, ix); }
}

void sk_histogram_settle_cell(sk_monitor_histogram *h, int32_t iy, int32_t ix)
{
  if (sk_is_in_map(iy, ix) && h->state[iy][ix] == SK_CELL_LEARNING) { h->state[iy][ix] = SK_CELL_CLEAR; }
}
