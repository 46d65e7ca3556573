/* Occlusion interpolation (leger-1998 section 2.1, Figure 3): every cell that the segment between two neighbouring returns crosses is
 * raised to an upper bound of the segment's height inside it. */
#ifndef SK_SCANLINE_RASTER_H
#define SK_SCANLINE_RASTER_H
#include "height_map.h"
#include "line_scale.h"
SK_BEGIN

typedef struct sk_point { int32_t x_mm, y_mm, z_mm; } sk_point;

/*@ // the real coordinate at fraction t of the way from v0 to v1
  @ logic real sk_at(integer v0, integer v1, real t) = v0 + sk_times(t, v1 - v0);
  @ // the closed cell i along an axis holds the coordinate
  @ predicate sk_cell_holds(integer i, real v) = sk_cell_low(i) <= v <= sk_cell_low(i) + SK_CELL_MM;
  @ // the point of the segment at t lies over the closed cell
  @ predicate sk_crosses(sk_point p, sk_point q, real t, integer iy, integer ix) = 0 <= t <= 1 &&
  @   sk_cell_holds(ix, sk_at(p.x_mm, q.x_mm, t)) && sk_cell_holds(iy, sk_at(p.y_mm, q.y_mm, t));
  @ // every cell that the segment crosses is at least as high as the segment above it, and stamped
  @ predicate sk_covers{L}(sk_height_map *m, sk_point p, sk_point q, integer now) = \forall real t; \forall integer iy, ix;
  @   sk_in_map(iy, ix) && sk_crosses(p, q, t, iy, ix) ==>
  @     \at(m->height_mm[iy][ix], L) >= sk_at(p.z_mm, q.z_mm, t) && \at(m->seen_us[iy][ix], L) == now;
  @ predicate sk_cell_meets(integer i, integer v0, integer v1) =
  @   sk_cell_low(i) <= sk_most(v0, v1) && sk_least(v0, v1) <= sk_cell_low(i) + SK_CELL_MM;
  @ predicate sk_in_bounds(sk_point p, sk_point q, integer iy, integer ix) =
  @   sk_cell_meets(ix, p.x_mm, q.x_mm) && sk_cell_meets(iy, p.y_mm, q.y_mm);
  @ // only cells of the bounding rectangle change, and they only rise over the generation that was current
  @ predicate sk_only_raises{A, B}(sk_height_map *m, sk_point p, sk_point q, integer now) = \forall integer iy, ix; sk_in_map(iy, ix) ==>
  @   sk_cell_kept{A, B}(m, iy, ix) ||
  @   (sk_in_bounds(p, q, iy, ix) && sk_cell_raised{A, B}(m, iy, ix, -SK_HEIGHT_MAX_MM, now));
  @ predicate sk_point_fits(sk_point p) = -SK_COORD_MAX_MM <= p.x_mm <= SK_COORD_MAX_MM && -SK_COORD_MAX_MM <= p.y_mm <= SK_COORD_MAX_MM &&
  @   -SK_HEIGHT_MAX_MM <= p.z_mm <= SK_HEIGHT_MAX_MM;
  @*/

/* All coordinates are clamped to +-SK_COORD_MAX_MM (z to +-SK_HEIGHT_MAX_MM) by the caller; a point outside, now_us < 0 or generation_us <= 0 is
 * refused: returns -1 and changes nothing. Otherwise returns the number of cells raised. A cell is closed: a segment that touches its border crosses
 * it. Equal points: the cells that hold the point. */
/*@ requires \valid(m) && \valid_read(p) && \valid_read(q) && \separated(m, p) && \separated(m, q);
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures accepts: \result >= 0 <==> sk_point_fits(\old(*p)) && sk_point_fits(\old(*q)) && now_us >= 0 && generation_us > 0;
  @ ensures refused: \result < 0 ==> \result == -1 && sk_map_kept{Pre, Post}(m);
  @ ensures covers: \result >= 0 ==> sk_covers(m, \old(*p), \old(*q), now_us);
  @ ensures only: \result >= 0 ==> sk_only_raises{Pre, Post}(m, \old(*p), \old(*q), now_us);
  @*/
int32_t sk_raster_segment(sk_height_map *m, const sk_point *p, const sk_point *q, int64_t now_us, int32_t generation_us);

SK_END
#endif
