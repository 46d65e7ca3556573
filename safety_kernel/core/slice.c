#include "slice.h"
#include "map_cell.h"

typedef struct sk_range { int32_t low, high; } sk_range;

/* Least and greatest of each coordinate. */
typedef struct sk_extent { int32_t x_low, x_high, y_low, y_high, z_low, z_high; } sk_extent;

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_counts_fit(s);
  @*/
static bool sk_counts_ok(const sk_slice *s)
{
  return s->link >= 0 && s->link <= 3 && s->vertices >= 1 && s->vertices <= SK_SLICE_VERTICES && s->planes >= 1 && s->planes <= SK_SLICE_PLANES;
}

/* Of a slice with all the vertices there can be, as those of the sweep are: a number of rounds known beforehand goes in lanes. */
/*@ requires \valid_read(s) && sk_counts_fit(s) && 0 <= axis < 3 && s->vertices == SK_SLICE_VERTICES;
  @ assigns \nothing;
  @ ensures sk_is_lowest(s, axis, \result.low) && sk_is_highest(s, axis, \result.high);
  @*/
static sk_range sk_full_range(const sk_slice *s, int32_t axis)
{
  sk_range range;
  int32_t low = s->xyz_mm[axis][0];
  int32_t high = low;
  int32_t i;
  /*@ loop invariant 0 <= i <= SK_SLICE_VERTICES;
    @ loop invariant \forall integer j; 0 <= j < i ==> low <= s->xyz_mm[axis][j] <= high;
    @ loop invariant \exists integer j; 0 <= j < s->vertices && low == s->xyz_mm[axis][j];
    @ loop invariant \exists integer j; 0 <= j < s->vertices && high == s->xyz_mm[axis][j];
    @ loop assigns i, low, high;
    @ loop variant SK_SLICE_VERTICES - i;
    @*/
  for (i = 0; i < SK_SLICE_VERTICES; i++) {
    low = s->xyz_mm[axis][i] < low ? s->xyz_mm[axis][i] : low;
    high = s->xyz_mm[axis][i] > high ? s->xyz_mm[axis][i] : high;
  }
  range.low = low;
  range.high = high;
  return range;
}

/*@ requires \valid_read(s) && sk_counts_fit(s) && 0 <= axis < 3;
  @ assigns \nothing;
  @ ensures sk_is_lowest(s, axis, \result.low) && sk_is_highest(s, axis, \result.high);
  @*/
static sk_range sk_part_range(const sk_slice *s, int32_t axis)
{
  sk_range range;
  int32_t low = s->xyz_mm[axis][0];
  int32_t high = low;
  int32_t i;
  /*@ loop invariant 0 <= i <= s->vertices;
    @ loop invariant \forall integer j; 0 <= j < i ==> low <= s->xyz_mm[axis][j] <= high;
    @ loop invariant \exists integer j; 0 <= j < s->vertices && low == s->xyz_mm[axis][j];
    @ loop invariant \exists integer j; 0 <= j < s->vertices && high == s->xyz_mm[axis][j];
    @ loop assigns i, low, high;
    @ loop variant s->vertices - i;
    @*/
  for (i = 0; i < s->vertices; i++) {
    low = s->xyz_mm[axis][i] < low ? s->xyz_mm[axis][i] : low;
    high = s->xyz_mm[axis][i] > high ? s->xyz_mm[axis][i] : high;
  }
  range.low = low;
  range.high = high;
  return range;
}

/*@ requires \valid_read(s) && sk_counts_fit(s) && 0 <= axis < 3;
  @ assigns \nothing;
  @ ensures sk_is_lowest(s, axis, \result.low) && sk_is_highest(s, axis, \result.high);
  @*/
static sk_range sk_axis_range(const sk_slice *s, int32_t axis)
{
  if (s->vertices == SK_SLICE_VERTICES) { return sk_full_range(s, axis); }
  return sk_part_range(s, axis);
}

/*@ requires \valid_read(s) && sk_counts_fit(s);
  @ assigns \nothing;
  @ ensures sk_is_lowest(s, 0, \result.x_low) && sk_is_highest(s, 0, \result.x_high);
  @ ensures sk_is_lowest(s, 1, \result.y_low) && sk_is_highest(s, 1, \result.y_high);
  @ ensures sk_is_lowest(s, 2, \result.z_low) && sk_is_highest(s, 2, \result.z_high);
  @*/
SK_CLONES static sk_extent sk_extent_of(const sk_slice *s)
{
  sk_extent e;
  sk_range x, y, z;
  x = sk_axis_range(s, 0);
  y = sk_axis_range(s, 1);
  z = sk_axis_range(s, 2);
  e.x_low = x.low;
  e.x_high = x.high;
  e.y_low = y.low;
  e.y_high = y.high;
  e.z_low = z.low;
  e.z_high = z.high;
  return e;
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_coordinate_fits(low_mm) && sk_coordinate_fits(high_mm);
  @*/
static bool sk_range_ok(int32_t low_mm, int32_t high_mm)
{
  return -SK_COORD_MAX_MM <= low_mm && low_mm <= SK_COORD_MAX_MM && -SK_COORD_MAX_MM <= high_mm && high_mm <= SK_COORD_MAX_MM;
}

/*@ requires \valid_read(s) && sk_counts_fit(s);
  @ requires sk_is_lowest(s, 0, e.x_low) && sk_is_highest(s, 0, e.x_high);
  @ requires sk_is_lowest(s, 1, e.y_low) && sk_is_highest(s, 1, e.y_high);
  @ requires sk_is_lowest(s, 2, e.z_low) && sk_is_highest(s, 2, e.z_high);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_vertices_fit(s);
  @*/
static bool sk_extent_ok(const sk_slice *s, sk_extent e)
{
  (void)s;
  if (!sk_range_ok(e.x_low, e.x_high)) { return false; }
  if (!sk_range_ok(e.y_low, e.y_high)) { return false; }
  return sk_range_ok(e.z_low, e.z_high);
}

bool sk_slice_vertices_ok(const sk_slice *s)
{
  if (!sk_counts_ok(s)) { return false; }
  return sk_extent_ok(s, sk_extent_of(s));
}

/* First and last cell along an axis; a cell that ends at the lowest coordinate is touched. */
/*@ requires \valid_read(s) && sk_counts_fit(s) && 0 <= axis <= 1 && sk_coordinate_fits(low_mm) && sk_is_lowest(s, axis, low_mm);
  @ assigns \nothing;
  @ ensures first: \forall integer cell; cell < \result ==> !sk_extent_meets(s, axis, cell);
  @ ensures met: sk_extent_meets(s, axis, \result);
  @ ensures low: sk_cell_low(\result) < low_mm <= sk_cell_low(\result) + SK_CELL_MM;
  @*/
static int32_t sk_first_cell(const sk_slice *s, int32_t axis, int32_t low_mm)
{
  (void)s;
  (void)axis;
  return sk_cell_of(low_mm - 1);
}

/*@ requires \valid_read(s) && sk_counts_fit(s) && 0 <= axis <= 1 && sk_coordinate_fits(high_mm) && sk_is_highest(s, axis, high_mm);
  @ assigns \nothing;
  @ ensures last: \forall integer cell; cell > \result ==> !sk_extent_meets(s, axis, cell);
  @ ensures met: sk_extent_meets(s, axis, \result);
  @ ensures high: sk_cell_low(\result) <= high_mm < sk_cell_low(\result) + SK_CELL_MM;
  @*/
static int32_t sk_last_cell(const sk_slice *s, int32_t axis, int32_t high_mm)
{
  (void)s;
  (void)axis;
  return sk_cell_of(high_mm);
}

bool sk_slice_footprint(const sk_slice *s, sk_footprint *out)
{
  sk_extent e;
  int32_t ix_low, ix_high, iy_low, iy_high;
  if (!sk_counts_ok(s)) { return false; }
  e = sk_extent_of(s);
  if (!sk_extent_ok(s, e)) { return false; }
  ix_low = sk_first_cell(s, 0, e.x_low);
  ix_high = sk_last_cell(s, 0, e.x_high);
  iy_low = sk_first_cell(s, 1, e.y_low);
  iy_high = sk_last_cell(s, 1, e.y_high);
  /*@ assert met: sk_extent_meets(s, 0, ix_low) && sk_extent_meets(s, 0, ix_high) && sk_extent_meets(s, 1, iy_low) && sk_extent_meets(s, 1, iy_high); */
  /*@ assert sk_extent_is_range(s, 0, ix_low, ix_high); */
  /*@ assert sk_extent_is_range(s, 1, iy_low, iy_high); */
  if (ix_low < 0 || ix_high >= SK_MAP_CELLS || iy_low < 0 || iy_high >= SK_MAP_CELLS) {
    /*@ assert outside: sk_outside_map(s); */
    return false;
  }
  out->cells.ix_low = ix_low;
  out->cells.ix_high = ix_high;
  out->cells.iy_low = iy_low;
  out->cells.iy_high = iy_high;
  out->z_low_mm = e.z_low;
  return true;
}

bool sk_slice_rectangle(const sk_slice *s, sk_rectangle *out)
{
  sk_footprint f;
  f.z_low_mm = 0;
  if (!sk_slice_footprint(s, &f)) { return false; }
  *out = f.cells;
  return true;
}
