/* A convex slice of the swept volume, where its lowest point is and which cells lie under it. */
#ifndef SK_SLICE_H
#define SK_SLICE_H
#include "height_map.h"
SK_BEGIN

#define SK_SLICE_VERTICES 24
#define SK_SLICE_PLANES 24
#define SK_NORMAL_MAX 1048576 /* bound of each component of a plane's normal */
#define SK_PLANE_OFFSET_MAX 9007199254740992 /* bound of d, 2^53 */

typedef struct sk_plane { int32_t nx, ny, nz; int64_t d; } sk_plane;

typedef struct sk_slice {
  int32_t link;                              /* joint index of the link: 0 upper body (its tail), 1 boom, 2 stick, 3 bucket */
  int32_t vertices;                          /* 1..SK_SLICE_VERTICES */
  int32_t xyz_mm[3][SK_SLICE_VERTICES];      /* vertices in the base frame, [axis][vertex]; their convex hull covers the slice */
  int32_t planes;                            /* 1..SK_SLICE_PLANES */
  sk_plane plane[SK_SLICE_PLANES];           /* claimed: n . vertex > d for every vertex */
} sk_slice;

/* Cells of a slice: every cell whose closed square meets the bounding rectangle of the vertices (so a coordinate on a cell's border counts for
 * the cells on both sides). */
typedef struct sk_rectangle { int32_t ix_low, ix_high, iy_low, iy_high; } sk_rectangle;

/* The cells, and the lowest vertex. */
typedef struct sk_footprint { sk_rectangle cells; int32_t z_low_mm; } sk_footprint;

/*@ predicate sk_counts_fit{L}(sk_slice *s) =
  @   0 <= \at(s->link, L) <= 3 && 1 <= \at(s->vertices, L) <= SK_SLICE_VERTICES && 1 <= \at(s->planes, L) <= SK_SLICE_PLANES;
  @ predicate sk_coordinate_fits(integer v) = -SK_COORD_MAX_MM <= v <= SK_COORD_MAX_MM;
  @ predicate sk_vertex_fits{L}(sk_slice *s, integer i) = sk_coordinate_fits(\at(s->xyz_mm[0][i], L)) &&
  @   sk_coordinate_fits(\at(s->xyz_mm[1][i], L)) && sk_coordinate_fits(\at(s->xyz_mm[2][i], L));
  @ predicate sk_vertices_fit{L}(sk_slice *s) = \forall integer i; 0 <= i < \at(s->vertices, L) ==> sk_vertex_fits{L}(s, i);
  @
  @ // the closed cell meets the vertices' extent along the axis
  @ predicate sk_extent_meets{L}(sk_slice *s, integer axis, integer cell) = \exists integer i, j;
  @   0 <= i < \at(s->vertices, L) && 0 <= j < \at(s->vertices, L) &&
  @   \at(s->xyz_mm[axis][i], L) <= sk_cell_low(cell) + SK_CELL_MM && sk_cell_low(cell) <= \at(s->xyz_mm[axis][j], L);
  @ predicate sk_under_slice{L}(sk_slice *s, integer iy, integer ix) = sk_extent_meets{L}(s, 0, ix) && sk_extent_meets{L}(s, 1, iy);
  @ predicate sk_outside_map{L}(sk_slice *s) = \exists integer i;
  @   (sk_extent_meets{L}(s, 0, i) || sk_extent_meets{L}(s, 1, i)) && !(0 <= i < SK_MAP_CELLS);
  @ predicate sk_extent_is_range{L}(sk_slice *s, integer axis, integer low, integer high) =
  @   \forall integer cell; sk_extent_meets{L}(s, axis, cell) <==> low <= cell <= high;
  @ predicate sk_range_in_map(sk_rectangle cells) =
  @   0 <= cells.ix_low <= cells.ix_high < SK_MAP_CELLS && 0 <= cells.iy_low <= cells.iy_high < SK_MAP_CELLS;
  @ predicate sk_is_lowest{L}(sk_slice *s, integer axis, integer v) =
  @   (\forall integer i; 0 <= i < \at(s->vertices, L) ==> v <= \at(s->xyz_mm[axis][i], L)) &&
  @   (\exists integer i; 0 <= i < \at(s->vertices, L) && v == \at(s->xyz_mm[axis][i], L));
  @ predicate sk_is_highest{L}(sk_slice *s, integer axis, integer v) =
  @   (\forall integer i; 0 <= i < \at(s->vertices, L) ==> v >= \at(s->xyz_mm[axis][i], L)) &&
  @   (\exists integer i; 0 <= i < \at(s->vertices, L) && v == \at(s->xyz_mm[axis][i], L));
  @*/

/* False, and *out unchanged, when a count or a coordinate is out of range or a cell lies outside the map. */
/*@ requires \valid_read(s) && \valid(out) && \separated(s, out);
  @ assigns *out;
  @ ensures refused: \result == false ==> *out == \old(*out);
  @ ensures why: \result == false ==> !sk_counts_fit{Pre}(s) || !sk_vertices_fit{Pre}(s) || sk_outside_map{Pre}(s);
  @ ensures fits: \result == true ==> sk_counts_fit{Pre}(s) && sk_vertices_fit{Pre}(s);
  @ ensures x: \result == true ==> sk_extent_is_range{Pre}(s, 0, out->cells.ix_low, out->cells.ix_high);
  @ ensures y: \result == true ==> sk_extent_is_range{Pre}(s, 1, out->cells.iy_low, out->cells.iy_high);
  @ ensures inside: \result == true ==> sk_range_in_map(out->cells);
  @ ensures lowest: \result == true ==> sk_is_lowest{Pre}(s, 2, out->z_low_mm);
  @*/
bool sk_slice_footprint(const sk_slice *s, sk_footprint *out);

/* The cells that sk_clear_slice asks about, for whoever fills sk_choice. False, and *out unchanged, when a count or a coordinate is out of range or
 * a cell lies outside the map. */
/*@ requires \valid_read(s) && \valid(out) && \separated(s, out);
  @ assigns *out;
  @ ensures refused: \result == false ==> *out == \old(*out);
  @ ensures why: \result == false ==> !sk_counts_fit{Pre}(s) || !sk_vertices_fit{Pre}(s) || sk_outside_map{Pre}(s);
  @ ensures x: \result == true ==> sk_extent_is_range{Pre}(s, 0, out->ix_low, out->ix_high);
  @ ensures y: \result == true ==> sk_extent_is_range{Pre}(s, 1, out->iy_low, out->iy_high);
  @ ensures inside: \result == true ==> 0 <= out->ix_low <= out->ix_high < SK_MAP_CELLS && 0 <= out->iy_low <= out->iy_high < SK_MAP_CELLS;
  @*/
bool sk_slice_rectangle(const sk_slice *s, sk_rectangle *out);

/* Whether counts and coordinates are in range. */
/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_counts_fit(s) && sk_vertices_fit(s);
  @*/
bool sk_slice_vertices_ok(const sk_slice *s);

SK_END
#endif
