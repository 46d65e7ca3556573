#include "scanline_raster.h"

/* A segment seen along its longer horizontal axis: columns are cells along it, rows cells across it. */
typedef struct sk_course {
  bool along_x;            /* columns run along x */
  int32_t a0, b0, z0;      /* the end with the lower coordinate along */
  int32_t a1, b1, z1;
} sk_course;

/* Bounds of the segment where it passes a column's border. */
typedef struct sk_border { int32_t b_low, b_high, z_high; } sk_border;

/*@ predicate sk_column_in_range(integer c) = -1000 <= c <= 1000;
  @ predicate sk_coordinate_in_range(integer v) = -SK_COORD_MAX_MM <= v <= SK_COORD_MAX_MM;
  @ predicate sk_height_in_range(integer z) = -SK_HEIGHT_MAX_MM <= z <= SK_HEIGHT_MAX_MM;
  @ predicate sk_course_fits(sk_course s) = s.a0 < s.a1 && sk_coordinate_in_range(s.a0) && sk_coordinate_in_range(s.a1) &&
  @   sk_coordinate_in_range(s.b0) && sk_coordinate_in_range(s.b1) && sk_height_in_range(s.z0) && sk_height_in_range(s.z1);
  @ logic integer sk_column_of(boolean along_x, integer iy, integer ix) = along_x ? ix : iy;
  @ logic integer sk_row_of(boolean along_x, integer iy, integer ix) = along_x ? iy : ix;
  @
  @ // v is at or below, above the line that goes from v0 to v1 in da steps, after run steps
  @ predicate sk_below_line(integer v, integer v0, integer v1, integer da, integer run) = da * (v - v0) <= (v1 - v0) * run;
  @ predicate sk_above_line(integer v, integer v0, integer v1, integer da, integer run) = da * (v - v0) >= (v1 - v0) * run;
  @ // bounds at both ends of a piece are bounds in between
  @ lemma sk_piece_below: \forall integer v, w, v0, v1, da, r0, r1; \forall real t; da > 0 && r0 <= t * da <= r1 &&
  @   sk_below_line(v, v0, v1, da, r0) && sk_below_line(w, v0, v1, da, r1) ==> sk_least(v, w) <= sk_at(v0, v1, t);
  @ lemma sk_piece_above: \forall integer v, w, v0, v1, da, r0, r1; \forall real t; da > 0 && r0 <= t * da <= r1 &&
  @   sk_above_line(v, v0, v1, da, r0) && sk_above_line(w, v0, v1, da, r1) ==> sk_at(v0, v1, t) <= sk_most(v, w);
  @ lemma sk_at_between: \forall integer v0, v1; \forall real t; 0 <= t <= 1 ==> sk_least(v0, v1) <= sk_at(v0, v1, t) <= sk_most(v0, v1);
  @ lemma sk_at_reversed: \forall integer v0, v1; \forall real t; sk_at(v0, v1, t) == sk_at(v1, v0, 1 - t);
  @*/
