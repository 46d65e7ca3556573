/* Clearance: every cell under a convex slice of the swept volume must be observed, fresh, and separated from the slice by a plane
 * with integer coefficients; the dig-zone rule excepts contact with soil that is to be dug. */
#ifndef SK_CLEARANCE_H
#define SK_CLEARANCE_H
#include "height_map.h"
#include "config/parameter_block.h"
SK_BEGIN

#define SK_SLICE_VERTICES 24
#define SK_SLICE_PLANES 24
#define SK_NORMAL_MAX 1048576 /* bound of each component of a plane's normal */
#define SK_PLANE_OFFSET_MAX 9007199254740992 /* bound of d, 2^53 */

typedef struct sk_plane { int32_t nx, ny, nz; int64_t d; } sk_plane;

typedef struct sk_slice {
  int32_t link;                              /* joint index of the link: 1 boom, 2 stick, 3 bucket */
  int32_t vertices;                          /* 1..SK_SLICE_VERTICES */
  int32_t vertex_mm[SK_SLICE_VERTICES][3];   /* base frame; their convex hull covers the slice */
  int32_t planes;                            /* 1..SK_SLICE_PLANES */
  sk_plane plane[SK_SLICE_PLANES];           /* claimed: n . vertex > d for every vertex */
} sk_slice;

/* Cells of a slice: every cell whose closed square meets the bounding rectangle of the vertices (so a coordinate on a cell's border counts for
 * the cells on both sides). */
typedef struct sk_rectangle { int32_t ix_low, ix_high, iy_low, iy_high; } sk_rectangle;

/* For each cell under the slice's bounding rectangle the plane that is claimed to separate it: n . corner <= d for the column. */
typedef struct sk_choice { uint8_t plane_of[SK_MAP_CELLS][SK_MAP_CELLS]; } sk_choice;

typedef struct sk_clearance_rules {
  int64_t now_us;
  int32_t fresh_us;
  int32_t margin_mm;
  int32_t own_body_radius_mm;  /* cells wholly nearer the origin are the machine's own: nothing to check for the boom, blocked for stick and bucket */
  bool dig_allowed;            /* swing speed bound is under the dig limit (decided by the caller from the reach box) */
  int32_t dig_zones;
  berm_dig_zone dig_zone[BERM_DIG_ZONES];
  bool dig_stale;              /* the dig-zone rule takes stale cells as they were last seen: for creeping out of a pit that the bucket hides */
} sk_clearance_rules;

enum {
  SK_CLEAR = 0, SK_BLOCKED_COLLISION = 1, SK_BLOCKED_UNKNOWN = 2, SK_BLOCKED_STALE = 3, SK_BLOCKED_FLOOR = 4, SK_BLOCKED_INVALID = 5
};

typedef struct sk_clearance_result { int32_t verdict; int32_t iy, ix; int32_t cells; } sk_clearance_result;

/*@ predicate sk_counts_fit{L}(sk_slice *s) =
  @   1 <= \at(s->link, L) <= 3 && 1 <= \at(s->vertices, L) <= SK_SLICE_VERTICES && 1 <= \at(s->planes, L) <= SK_SLICE_PLANES;
  @ predicate sk_coordinate_fits(integer v) = -SK_COORD_MAX_MM <= v <= SK_COORD_MAX_MM;
  @ predicate sk_vertex_fits{L}(sk_slice *s, integer i) = sk_coordinate_fits(\at(s->vertex_mm[i][0], L)) &&
  @   sk_coordinate_fits(\at(s->vertex_mm[i][1], L)) && sk_coordinate_fits(\at(s->vertex_mm[i][2], L));
  @ predicate sk_vertices_fit{L}(sk_slice *s) = \forall integer i; 0 <= i < \at(s->vertices, L) ==> sk_vertex_fits{L}(s, i);
  @ predicate sk_plane_fits{L}(sk_plane *p) =
  @   -SK_NORMAL_MAX <= \at(p->nx, L) <= SK_NORMAL_MAX && -SK_NORMAL_MAX <= \at(p->ny, L) <= SK_NORMAL_MAX &&
  @   -SK_NORMAL_MAX <= \at(p->nz, L) <= SK_NORMAL_MAX && -SK_PLANE_OFFSET_MAX <= \at(p->d, L) <= SK_PLANE_OFFSET_MAX;
  @ predicate sk_planes_fit{L}(sk_slice *s) = \forall integer k; 0 <= k < \at(s->planes, L) ==> sk_plane_fits{L}(&s->plane[k]);
  @ predicate sk_slice_fits{L}(sk_slice *s) = sk_counts_fit{L}(s) && sk_vertices_fit{L}(s) && sk_planes_fit{L}(s);
  @ predicate sk_rules_fit{L}(sk_clearance_rules *r) =
  @   0 <= \at(r->now_us, L) && 0 <= \at(r->fresh_us, L) && 0 <= \at(r->margin_mm, L) <= SK_COORD_MAX_MM &&
  @   0 <= \at(r->own_body_radius_mm, L) <= SK_COORD_MAX_MM && 0 <= \at(r->dig_zones, L) <= BERM_DIG_ZONES;
  @
  @ // the closed cell meets the vertices' extent along the axis
  @ predicate sk_extent_meets{L}(sk_slice *s, integer axis, integer cell) = \exists integer i, j;
  @   0 <= i < \at(s->vertices, L) && 0 <= j < \at(s->vertices, L) &&
  @   \at(s->vertex_mm[i][axis], L) <= sk_cell_low(cell) + SK_CELL_MM && sk_cell_low(cell) <= \at(s->vertex_mm[j][axis], L);
  @ predicate sk_under_slice{L}(sk_slice *s, integer iy, integer ix) = sk_extent_meets{L}(s, 0, ix) && sk_extent_meets{L}(s, 1, iy);
  @ predicate sk_outside_map{L}(sk_slice *s) = \exists integer i;
  @   (sk_extent_meets{L}(s, 0, i) || sk_extent_meets{L}(s, 1, i)) && !(0 <= i < SK_MAP_CELLS);
  @ predicate sk_extent_is_range{L}(sk_slice *s, integer axis, integer low, integer high) =
  @   \forall integer cell; sk_extent_meets{L}(s, axis, cell) <==> low <= cell <= high;
  @
  @ // every vertex strictly on the positive side of a plane whose normal does not point down
  @ predicate sk_vertex_above{L}(sk_plane *p, sk_slice *s, integer i) =
  @   \at(p->nx, L) * \at(s->vertex_mm[i][0], L) + \at(p->ny, L) * \at(s->vertex_mm[i][1], L) + \at(p->nz, L) * \at(s->vertex_mm[i][2], L) >
  @     \at(p->d, L);
  @ predicate sk_plane_bounds{L}(sk_slice *s, integer k) = \at(s->plane[k].nz, L) >= 0 &&
  @   \forall integer i; 0 <= i < \at(s->vertices, L) ==> sk_vertex_above{L}(&s->plane[k], s, i);
  @ predicate sk_point_below{L}(sk_plane *p, integer x, integer y, integer z) =
  @   \at(p->nx, L) * x + \at(p->ny, L) * y + \at(p->nz, L) * z <= \at(p->d, L);
  @ // the four corners of the square with low corner (x, y), at height z
  @ predicate sk_square_below{L}(sk_plane *p, integer x, integer y, integer z) =
  @   sk_point_below{L}(p, x, y, z) && sk_point_below{L}(p, x + SK_CELL_MM, y, z) &&
  @   sk_point_below{L}(p, x, y + SK_CELL_MM, z) && sk_point_below{L}(p, x + SK_CELL_MM, y + SK_CELL_MM, z);
  @ predicate sk_current{L}(sk_height_map *m, sk_clearance_rules *r, integer iy, integer ix) =
  @   0 <= \at(m->seen_us[iy][ix], L) && \at(r->now_us, L) - \at(r->fresh_us, L) <= \at(m->seen_us[iy][ix], L) <= \at(r->now_us, L);
  @ predicate sk_column_below{L}(sk_height_map *m, sk_clearance_rules *r, sk_plane *p, integer iy, integer ix) =
  @   (sk_current{L}(m, r, iy, ix) ==>
  @     sk_square_below{L}(p, sk_cell_low(ix), sk_cell_low(iy), sk_top{L}(m, iy, ix) + \at(r->margin_mm, L))) &&
  @   (!sk_current{L}(m, r, iy, ix) ==> \at(p->nz, L) == 0 && sk_square_below{L}(p, sk_cell_low(ix), sk_cell_low(iy), 0));
  @
  @ predicate sk_in_circle(integer x, integer y, integer radius) = x * x + y * y <= radius * radius;
  @ predicate sk_own_body{L}(sk_clearance_rules *r, integer iy, integer ix) =
  @   sk_in_circle(sk_cell_low(ix), sk_cell_low(iy), \at(r->own_body_radius_mm, L)) &&
  @   sk_in_circle(sk_cell_low(ix) + SK_CELL_MM, sk_cell_low(iy), \at(r->own_body_radius_mm, L)) &&
  @   sk_in_circle(sk_cell_low(ix), sk_cell_low(iy) + SK_CELL_MM, \at(r->own_body_radius_mm, L)) &&
  @   sk_in_circle(sk_cell_low(ix) + SK_CELL_MM, sk_cell_low(iy) + SK_CELL_MM, \at(r->own_body_radius_mm, L));
  @ predicate sk_cell_in_zone{L}(berm_dig_zone *zone, integer iy, integer ix) =
  @   \at(zone->x_low_mm, L) <= sk_cell_low(ix) && sk_cell_low(ix) + SK_CELL_MM <= \at(zone->x_high_mm, L) &&
  @   \at(zone->y_low_mm, L) <= sk_cell_low(iy) && sk_cell_low(iy) + SK_CELL_MM <= \at(zone->y_high_mm, L);
  @ predicate sk_slice_above{L}(sk_slice *s, integer z) = \forall integer i; 0 <= i < \at(s->vertices, L) ==> \at(s->vertex_mm[i][2], L) >= z;
  @ predicate sk_known{L}(sk_height_map *m, sk_clearance_rules *r, integer iy, integer ix) =
  @   sk_current{L}(m, r, iy, ix) || (\at(r->dig_stale, L) == true && 0 <= \at(m->seen_us[iy][ix], L));
  @ // known, and no higher than soil is in this zone: a person who stands there is not soil
  @ predicate sk_diggable{L}(sk_height_map *m, sk_clearance_rules *r, integer i, integer iy, integer ix) =
  @   sk_known{L}(m, r, iy, ix) && sk_top{L}(m, iy, ix) <= \at(r->dig_zone[i].ceiling_mm, L);
  @ predicate sk_dig_exempt{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, integer iy, integer ix) =
  @   \at(r->dig_allowed, L) == true &&
  @   \exists integer i; 0 <= i < \at(r->dig_zones, L) && sk_cell_in_zone{L}(&r->dig_zone[i], iy, ix) &&
  @     sk_slice_above{L}(s, \at(r->dig_zone[i].floor_mm, L)) && sk_diggable{L}(m, r, i, iy, ix);
  @ predicate sk_below_floor{L}(sk_slice *s, sk_clearance_rules *r, integer iy, integer ix) = \at(r->dig_allowed, L) == true &&
  @   \exists integer i; 0 <= i < \at(r->dig_zones, L) && sk_cell_in_zone{L}(&r->dig_zone[i], iy, ix) &&
  @     !sk_slice_above{L}(s, \at(r->dig_zone[i].floor_mm, L));
  @ predicate sk_separated{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, integer k, integer iy, integer ix) =
  @   0 <= k < \at(s->planes, L) && sk_plane_bounds{L}(s, k) && sk_column_below{L}(m, r, &s->plane[k], iy, ix);
  @ // a cell of the slice is clear, plane k being the one chosen for it
  @ predicate sk_cell_clear{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, integer k, integer iy, integer ix) =
  @   (sk_own_body{L}(r, iy, ix) ==> \at(s->link, L) == 1) &&
  @   (!sk_own_body{L}(r, iy, ix) ==> sk_separated{L}(m, s, r, k, iy, ix) || sk_dig_exempt{L}(m, s, r, iy, ix));
  @ // why it is not
  @ predicate sk_blocked_because{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, integer iy, integer ix, integer verdict) =
  @   (verdict == SK_BLOCKED_COLLISION && sk_current{L}(m, r, iy, ix)) ||
  @   (verdict == SK_BLOCKED_UNKNOWN && (sk_own_body{L}(r, iy, ix) || \at(m->seen_us[iy][ix], L) < 0)) ||
  @   (verdict == SK_BLOCKED_STALE && 0 <= \at(m->seen_us[iy][ix], L) && !sk_current{L}(m, r, iy, ix)) ||
  @   (verdict == SK_BLOCKED_FLOOR && sk_below_floor{L}(s, r, iy, ix));
  @ logic integer sk_chosen{L}(sk_choice *choice, integer iy, integer ix) = \at(choice->plane_of[iy][ix], L);
  @ // every cell of the slice in the rows before iy, and in row iy before ix
  @ predicate sk_clear_before{L}(sk_height_map *m, sk_slice *s, sk_choice *choice, sk_clearance_rules *r, integer iy, integer ix) =
  @   \forall integer j, i; sk_under_slice{L}(s, j, i) && (j < iy || (j == iy && i < ix)) ==>
  @     sk_in_map(j, i) && sk_cell_clear{L}(m, s, r, sk_chosen{L}(choice, j, i), j, i);
  @*/

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

/* A column is the cell's closed square, from below everything up to the effective height plus margin. A cell never observed or stale (seen longer than
 * fresh_us ago, or in the future) is a column without a top: only a vertical plane (nz == 0) separates it. nz < 0 is never accepted. A slice with
 * a cell outside the map is BLOCKED_UNKNOWN.
 * Own body: a cell with all four corners within own_body_radius is clear for the boom and BLOCKED_UNKNOWN for stick and bucket, whatever it holds.
 * Dig-zone rule: a cell whose square lies wholly inside a dig zone needs no separation when dig_allowed, every vertex of the slice is at or above the
 * zone's floor, and the cell is observed, fresh (or dig_stale) and no higher than the zone's ceiling; not separated and below the floor it is
 * BLOCKED_FLOOR.
 * out->verdict is SK_CLEAR only if every plane that is used has every vertex strictly on its positive side and every cell of the rectangle passes;
 * then, and where no cell is to blame, iy = ix = -1; else they name the first blocked cell, row by row. On anything malformed (counts, ranges,
 * link) the verdict is SK_BLOCKED_INVALID. */
/*@ requires \valid_read(m) && \valid_read(s) && \valid_read(choice) && \valid_read(rules) && \valid(out);
  @ requires \separated(out, m, s, choice, rules);
  @ assigns *out;
  @ ensures verdicts: SK_CLEAR <= out->verdict <= SK_BLOCKED_INVALID;
  @ ensures invalid: out->verdict == SK_BLOCKED_INVALID <==> !(sk_slice_fits{Pre}(s) && sk_rules_fit{Pre}(rules));
  @ ensures clear: out->verdict == SK_CLEAR ==> \forall integer iy, ix; sk_under_slice{Pre}(s, iy, ix) ==>
  @   sk_in_map(iy, ix) && sk_cell_clear{Pre}(m, s, rules, sk_chosen{Pre}(choice, iy, ix), iy, ix);
  @ ensures no_cell: out->iy < 0 ==> out->iy == -1 && out->ix == -1 && (out->verdict == SK_CLEAR || out->verdict == SK_BLOCKED_INVALID ||
  @   (out->verdict == SK_BLOCKED_UNKNOWN && sk_outside_map{Pre}(s)));
  @ ensures blocked: out->iy >= 0 ==> sk_in_map(out->iy, out->ix) && sk_under_slice{Pre}(s, out->iy, out->ix) &&
  @   !sk_cell_clear{Pre}(m, s, rules, sk_chosen{Pre}(choice, out->iy, out->ix), out->iy, out->ix) &&
  @   sk_blocked_because{Pre}(m, s, rules, out->iy, out->ix, out->verdict);
  @ ensures first: out->iy >= 0 ==> sk_clear_before{Pre}(m, s, choice, rules, out->iy, out->ix);
  @*/
void sk_clear_slice(const sk_height_map *m, const sk_slice *s, const sk_choice *choice, const sk_clearance_rules *rules, sk_clearance_result *out);

SK_END
#endif
