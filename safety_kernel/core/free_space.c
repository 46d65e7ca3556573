#include "free_space.h"

/*@ requires -1000000 <= low_mm <= 1000000;
  @ assigns \nothing;
  @ ensures SK_VOXEL_MM * \result + low_mm <= v_mm < SK_VOXEL_MM * (\result + 1) + low_mm;
  @*/
static int32_t sk_voxel_index(int32_t v_mm, int32_t low_mm)
{
  int64_t offset = (int64_t)v_mm - low_mm;
  int64_t q = offset / SK_VOXEL_MM; /* towards zero */
  if (offset % SK_VOXEL_MM < 0) { q = q - 1; }
  return (int32_t)q;
}

sk_voxel sk_voxel_of(int32_t x_mm, int32_t y_mm, int32_t z_mm)
{
  sk_voxel v;
  v.level = sk_voxel_index(z_mm, SK_VOXEL_FLOOR_MM);
  v.jy = sk_voxel_index(y_mm, SK_MAP_ORIGIN_MM);
  v.jx = sk_voxel_index(x_mm, SK_MAP_ORIGIN_MM);
  return v;
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_voxel_in_space(v);
  @*/
static bool sk_is_in_space(sk_voxel v)
{
  return v.level >= 0 && v.level < SK_VOXEL_LEVELS && v.jy >= 0 && v.jy < SK_VOXELS && v.jx >= 0 && v.jx < SK_VOXELS;
}

/* What was UNKNOWN before stays so: that is all that the loops over rows and levels need to know of the rest. */
/*@ requires \valid(s) && 0 <= k < SK_VOXEL_LEVELS && 0 <= j < SK_VOXELS;
  @ assigns s->voxel[..][..][..];
  @ ensures unknown: \forall integer i; 0 <= i < SK_VOXELS ==> sk_unknown_at(s, k, j, i);
  @ ensures stays: \forall integer l, n, m; sk_unknown_at{Pre}(s, l, n, m) ==> sk_unknown_at{Post}(s, l, n, m);
  @*/
static void sk_begin_row(sk_free_space *s, int32_t k, int32_t j)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= SK_VOXELS;
    @ loop invariant unknown: \forall integer n; 0 <= n < i ==> sk_unknown_at(s, k, j, n);
    @ loop invariant stays: \forall integer l, n, m; sk_unknown_at{Pre}(s, l, n, m) ==> sk_unknown_at{Here}(s, l, n, m);
    @ loop assigns i, s->voxel[..][..][..];
    @ loop variant SK_VOXELS - i;
    @*/
  for (i = 0; i < SK_VOXELS; i++) { s->voxel[k][j][i] = SK_VOXEL_UNKNOWN; }
}

/*@ requires \valid(s) && 0 <= k < SK_VOXEL_LEVELS;
  @ assigns s->voxel[..][..][..];
  @ ensures unknown: \forall integer j, i; 0 <= j < SK_VOXELS && 0 <= i < SK_VOXELS ==> sk_unknown_at(s, k, j, i);
  @ ensures stays: \forall integer l, n, m; sk_unknown_at{Pre}(s, l, n, m) ==> sk_unknown_at{Post}(s, l, n, m);
  @*/
static void sk_begin_level(sk_free_space *s, int32_t k)
{
  int32_t j;
  /*@ loop invariant 0 <= j <= SK_VOXELS;
    @ loop invariant unknown: \forall integer n, i; 0 <= n < j && 0 <= i < SK_VOXELS ==> sk_unknown_at(s, k, n, i);
    @ loop invariant stays: \forall integer l, n, m; sk_unknown_at{Pre}(s, l, n, m) ==> sk_unknown_at{Here}(s, l, n, m);
    @ loop assigns j, s->voxel[..][..][..];
    @ loop variant SK_VOXELS - j;
    @*/
  for (j = 0; j < SK_VOXELS; j++) { sk_begin_row(s, k, j); }
}

/*@ requires \valid(s) && 0 <= iy < SK_MAP_CELLS;
  @ assigns s->foreign[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> s->foreign[iy][ix] == 0;
  @*/
static void sk_begin_counts(sk_free_space *s, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant \forall integer n; 0 <= n < ix ==> s->foreign[iy][n] == 0;
    @ loop assigns ix, s->foreign[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) { s->foreign[iy][ix] = 0U; }
}

void sk_space_begin(sk_free_space *s)
{
  int32_t k;
  int32_t iy;
  /*@ loop invariant 0 <= k <= SK_VOXEL_LEVELS;
    @ loop invariant unknown: \forall integer n, j, i; 0 <= n < k && 0 <= j < SK_VOXELS && 0 <= i < SK_VOXELS ==> sk_unknown_at(s, n, j, i);
    @ loop assigns k, s->voxel[..][..][..];
    @ loop variant SK_VOXEL_LEVELS - k;
    @*/
  for (k = 0; k < SK_VOXEL_LEVELS; k++) { sk_begin_level(s, k); }
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant \forall integer n, ix; 0 <= n < iy && 0 <= ix < SK_MAP_CELLS ==> s->foreign[n][ix] == 0;
    @ loop assigns iy, s->foreign[..][..];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_begin_counts(s, iy); }
}

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_open_at(s, k, j, i);
  @*/
static bool sk_is_open(const sk_free_space *s, int32_t k, int32_t j, int32_t i)
{
  if (k < 0 || k >= SK_VOXEL_LEVELS || j < 0 || j >= SK_VOXELS || i < 0 || i >= SK_VOXELS) { return false; }
  return s->voxel[k][j][i] == SK_VOXEL_FREE || s->voxel[k][j][i] == SK_VOXEL_FOREIGN;
}

/*@ requires \valid_read(s) && 0 <= i < SK_VOXELS && -1 <= j <= SK_VOXELS && -1 <= k <= SK_VOXEL_LEVELS;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_open_in_row(s, k, j, i);
  @*/
static bool sk_is_open_in_row(const sk_free_space *s, int32_t k, int32_t j, int32_t i)
{
  return sk_is_open(s, k, j, i - 1) && sk_is_open(s, k, j, i) && sk_is_open(s, k, j, i + 1);
}

/*@ requires \valid_read(s) && 0 <= i < SK_VOXELS && 0 <= j < SK_VOXELS && -1 <= k <= SK_VOXEL_LEVELS;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_open_in_layer(s, k, j, i);
  @*/
static bool sk_is_open_in_layer(const sk_free_space *s, int32_t k, int32_t j, int32_t i)
{
  return sk_is_open_in_row(s, k, j - 1, i) && sk_is_open_in_row(s, k, j, i) && sk_is_open_in_row(s, k, j + 1, i);
}

/*@ requires \valid_read(s) && sk_voxel_in_space(v);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_open_around(s, v.level, v.jy, v.jx);
  @*/
static bool sk_is_open_around(const sk_free_space *s, sk_voxel v)
{
  return sk_is_open_in_layer(s, v.level - 1, v.jy, v.jx) && sk_is_open_in_layer(s, v.level, v.jy, v.jx) &&
         sk_is_open_in_layer(s, v.level + 1, v.jy, v.jx);
}

/*@ requires \valid(s) && sk_voxel_in_space(v);
  @ assigns s->voxel[..][..][..];
  @ ensures set: s->voxel[v.level][v.jy][v.jx] == flag;
  @ ensures others: \forall integer l, n, m; sk_in_space(l, n, m) && !(l == v.level && n == v.jy && m == v.jx) ==>
  @   s->voxel[l][n][m] == \old(s->voxel[l][n][m]);
  @*/
static void sk_turn_voxel(sk_free_space *s, sk_voxel v, uint8_t flag)
{
  s->voxel[v.level][v.jy][v.jx] = flag;
}

/* One FOREIGN voxel more in its cell, or one less. */
/*@ requires \valid(s) && sk_voxel_in_space(v);
  @ assigns s->foreign[..][..];
  @ ensures more: more == true ==> s->foreign[v.jy / 2][v.jx / 2] == sk_one_more(\old(s->foreign[v.jy / 2][v.jx / 2]));
  @ ensures less: more == false ==> s->foreign[v.jy / 2][v.jx / 2] == sk_one_less(\old(s->foreign[v.jy / 2][v.jx / 2]));
  @ ensures others: \forall integer iy, ix; sk_in_map(iy, ix) && !(iy == v.jy / 2 && ix == v.jx / 2) ==> s->foreign[iy][ix] == \old(s->foreign[iy][ix]);
  @*/
static void sk_count_foreign(sk_free_space *s, sk_voxel v, bool more)
{
  int32_t iy = v.jy / 2;
  int32_t ix = v.jx / 2;
  uint16_t n = s->foreign[iy][ix];
  if (more && n < 65535U) { s->foreign[iy][ix] = (uint16_t)(n + 1U); }
  if (!more && n > 0U) { s->foreign[iy][ix] = (uint16_t)(n - 1U); }
}

bool sk_space_return(sk_free_space *s, sk_voxel v, bool learning)
{
  uint8_t flag;
  if (!sk_is_in_space(v)) { return false; }
  flag = s->voxel[v.level][v.jy][v.jx];
  if (flag == SK_VOXEL_UNKNOWN) {
    sk_turn_voxel(s, v, SK_VOXEL_SOLID);
    return false;
  }
  if (learning) {
    if (flag == SK_VOXEL_FREE || flag == SK_VOXEL_FOREIGN) { sk_turn_voxel(s, v, SK_VOXEL_SOLID); }
    if (flag == SK_VOXEL_FOREIGN) { sk_count_foreign(s, v, false); }
    return false;
  }
  if (flag != SK_VOXEL_FREE || !sk_is_open_around(s, v)) { return false; }
  sk_turn_voxel(s, v, SK_VOXEL_FOREIGN);
  sk_count_foreign(s, v, true);
  return true;
}

void sk_space_pass(sk_free_space *s, sk_voxel v)
{
  uint8_t flag;
  if (!sk_is_in_space(v)) { return; }
  flag = s->voxel[v.level][v.jy][v.jx];
  if (flag == SK_VOXEL_UNKNOWN) { sk_turn_voxel(s, v, SK_VOXEL_FREE); }
  if (flag == SK_VOXEL_FOREIGN) {
    sk_turn_voxel(s, v, SK_VOXEL_FREE);
    sk_count_foreign(s, v, false);
  }
}

void sk_space_forget(sk_free_space *s, int32_t iy, int32_t ix)
{
  int32_t k;
  if (iy < 0 || iy >= SK_MAP_CELLS || ix < 0 || ix >= SK_MAP_CELLS) { return; }
  /*@ loop invariant 0 <= k <= SK_VOXEL_LEVELS;
    @ loop invariant unknown: \forall integer n, j, i; 0 <= n < k && 2 * iy <= j <= 2 * iy + 1 && 2 * ix <= i <= 2 * ix + 1 ==>
    @   s->voxel[n][j][i] == SK_VOXEL_UNKNOWN;
    @ loop invariant others: \forall integer n, j, i; sk_in_space(n, j, i) && !(n < k && 2 * iy <= j <= 2 * iy + 1 && 2 * ix <= i <= 2 * ix + 1) ==>
    @   s->voxel[n][j][i] == \at(s->voxel[n][j][i], Pre);
    @ loop assigns k, s->voxel[..][..][..];
    @ loop variant SK_VOXEL_LEVELS - k;
    @*/
  for (k = 0; k < SK_VOXEL_LEVELS; k++) {
    s->voxel[k][2 * iy][2 * ix] = SK_VOXEL_UNKNOWN;
    s->voxel[k][2 * iy][2 * ix + 1] = SK_VOXEL_UNKNOWN;
    s->voxel[k][2 * iy + 1][2 * ix] = SK_VOXEL_UNKNOWN;
    s->voxel[k][2 * iy + 1][2 * ix + 1] = SK_VOXEL_UNKNOWN;
  }
  s->foreign[iy][ix] = 0U;
}

/* The first cell of the row, or -1. */
/*@ requires \valid_read(s) && \valid_read(r) && 0 <= iy < SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures range: -1 <= \result < SK_MAP_CELLS;
  @ ensures found: \result >= 0 ==> sk_foreign_in_region(s, r, least, iy, \result);
  @ ensures none: \result < 0 ==> \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> !sk_foreign_in_region(s, r, least, iy, ix);
  @*/
static int32_t sk_find_foreign(const sk_free_space *s, const sk_monitor_rules *r, int32_t least, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant \forall integer i; 0 <= i < ix ==> !sk_foreign_in_region(s, r, least, iy, i);
    @ loop assigns ix;
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    if ((int32_t)s->foreign[iy][ix] >= least && r->watched[iy][ix] != 0U) { return ix; }
  }
  return -1;
}

bool sk_space_find(const sk_free_space *s, const sk_monitor_rules *r, int32_t least, sk_monitor_cell *where)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> !sk_foreign_in_region(s, r, least, j, i);
    @ loop assigns iy;
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) {
    int32_t ix = sk_find_foreign(s, r, least, iy);
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
