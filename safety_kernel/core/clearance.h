/* Clearance: every cell under a convex slice of the swept volume must be observed, fresh, and separated from the slice by a plane
 * with integer coefficients; the dig-zone rule excepts contact with soil that is to be dug. */
#ifndef SK_CLEARANCE_H
#define SK_CLEARANCE_H
#include "clearance_rules.h"
#include "slice.h"
SK_BEGIN

/* For each cell under the slice's bounding rectangle the plane that is claimed to separate it: n . corner <= d for the column. */
typedef struct sk_choice { uint8_t plane_of[SK_MAP_CELLS][SK_MAP_CELLS]; } sk_choice;

enum {
  SK_CLEAR = 0, SK_BLOCKED_COLLISION = 1, SK_BLOCKED_UNKNOWN = 2, SK_BLOCKED_STALE = 3, SK_BLOCKED_FLOOR = 4, SK_BLOCKED_OVERPASS = 5,
  SK_BLOCKED_INVALID = 6
};

typedef struct sk_clearance_result { int32_t verdict; int32_t iy, ix; int32_t cells; } sk_clearance_result;

/*@ predicate sk_plane_fits{L}(sk_plane *p) =
  @   -SK_NORMAL_MAX <= \at(p->nx, L) <= SK_NORMAL_MAX && -SK_NORMAL_MAX <= \at(p->ny, L) <= SK_NORMAL_MAX &&
  @   -SK_NORMAL_MAX <= \at(p->nz, L) <= SK_NORMAL_MAX && -SK_PLANE_OFFSET_MAX <= \at(p->d, L) <= SK_PLANE_OFFSET_MAX;
  @ predicate sk_planes_fit{L}(sk_slice *s) = \forall integer k; 0 <= k < \at(s->planes, L) ==> sk_plane_fits{L}(&s->plane[k]);
  @ predicate sk_slice_fits{L}(sk_slice *s) = sk_counts_fit{L}(s) && sk_vertices_fit{L}(s) && sk_planes_fit{L}(s);
  @ // every vertex strictly on the positive side of a plane whose normal does not point down
  @ predicate sk_vertex_above{L}(sk_plane *p, sk_slice *s, integer i) =
  @   \at(p->nx, L) * \at(s->xyz_mm[0][i], L) + \at(p->ny, L) * \at(s->xyz_mm[1][i], L) + \at(p->nz, L) * \at(s->xyz_mm[2][i], L) >
  @     \at(p->d, L);
  @ predicate sk_plane_bounds{L}(sk_slice *s, integer k) = \at(s->plane[k].nz, L) >= 0 &&
  @   \forall integer i; 0 <= i < \at(s->vertices, L) ==> sk_vertex_above{L}(&s->plane[k], s, i);
  @ predicate sk_point_below{L}(sk_plane *p, integer x, integer y, integer z) =
  @   \at(p->nx, L) * x + \at(p->ny, L) * y + \at(p->nz, L) * z <= \at(p->d, L);
  @ // the four corners of the square with low corner (x, y), at height z
  @ predicate sk_square_below{L}(sk_plane *p, integer x, integer y, integer z) =
  @   sk_point_below{L}(p, x, y, z) && sk_point_below{L}(p, x + SK_CELL_MM, y, z) &&
  @   sk_point_below{L}(p, x, y + SK_CELL_MM, z) && sk_point_below{L}(p, x + SK_CELL_MM, y + SK_CELL_MM, z);
  @ predicate sk_column_below{L}(sk_height_map *m, sk_clearance_rules *r, sk_plane *p, integer iy, integer ix) =
  @   (sk_passable{L}(m, r, iy, ix) ==> sk_square_below{L}(p, sk_cell_low(ix), sk_cell_low(iy), sk_column_top{L}(m, r, iy, ix))) &&
  @   (!sk_passable{L}(m, r, iy, ix) ==> \at(p->nz, L) == 0 && sk_square_below{L}(p, sk_cell_low(ix), sk_cell_low(iy), 0));
  @
  @ predicate sk_slice_above{L}(sk_slice *s, integer z) = \forall integer i; 0 <= i < \at(s->vertices, L) ==> \at(s->xyz_mm[2][i], L) >= z;
  @ predicate sk_known{L}(sk_height_map *m, sk_clearance_rules *r, integer iy, integer ix) =
  @   sk_current{L}(m, r, iy, ix) || (\at(r->dig_stale, L) == true && 0 <= \at(m->seen_us[iy][ix], L));
  @ // known, and no higher than soil is in this zone: a person who stands there is not soil
  @ predicate sk_diggable{L}(sk_height_map *m, sk_clearance_rules *r, integer i, integer iy, integer ix) =
  @   sk_known{L}(m, r, iy, ix) && sk_top{L}(m, iy, ix) <= \at(r->dig_zone[i].ceiling_mm, L);
  @ predicate sk_dig_exempt{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, integer iy, integer ix) =
  @   \at(r->dig_allowed, L) == true && \at(s->link, L) != 0 &&
  @   \exists integer i; 0 <= i < \at(r->dig_zones, L) && sk_cell_in_zone{L}(&r->dig_zone[i], iy, ix) &&
  @     sk_slice_above{L}(s, \at(r->dig_zone[i].floor_mm, L)) && sk_diggable{L}(m, r, i, iy, ix);
  @ predicate sk_below_floor{L}(sk_slice *s, sk_clearance_rules *r, integer iy, integer ix) =
  @   \at(r->dig_allowed, L) == true && \at(s->link, L) != 0 &&
  @   \exists integer i; 0 <= i < \at(r->dig_zones, L) && sk_cell_in_zone{L}(&r->dig_zone[i], iy, ix) &&
  @     !sk_slice_above{L}(s, \at(r->dig_zone[i].floor_mm, L));
  @ predicate sk_separated{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, integer k, integer iy, integer ix) =
  @   0 <= k < \at(s->planes, L) && sk_plane_bounds{L}(s, k) && sk_column_below{L}(m, r, &s->plane[k], iy, ix);
  @ // a cell of the slice is clear, plane k being the one chosen for it
  @ predicate sk_cell_clear{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, integer k, integer iy, integer ix) =
  @   (sk_own_body{L}(r, iy, ix) ==> \at(s->link, L) <= 1) &&
  @   (!sk_own_body{L}(r, iy, ix) ==> sk_separated{L}(m, s, r, k, iy, ix) || sk_dig_exempt{L}(m, s, r, iy, ix));
  @ // why it is not
  @ predicate sk_blocked_because{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, integer iy, integer ix, integer verdict) =
  @   (verdict == SK_BLOCKED_COLLISION && sk_current{L}(m, r, iy, ix)) ||
  @   (verdict == SK_BLOCKED_UNKNOWN && (sk_own_body{L}(r, iy, ix) || \at(m->seen_us[iy][ix], L) < 0)) ||
  @   (verdict == SK_BLOCKED_STALE && 0 <= \at(m->seen_us[iy][ix], L) && !sk_current{L}(m, r, iy, ix)) ||
  @   (verdict == SK_BLOCKED_OVERPASS && sk_current{L}(m, r, iy, ix) && !sk_passable{L}(m, r, iy, ix)) ||
  @   (verdict == SK_BLOCKED_FLOOR && sk_below_floor{L}(s, r, iy, ix));
  @ logic integer sk_chosen{L}(sk_choice *choice, integer iy, integer ix) = \at(choice->plane_of[iy][ix], L);
  @ // every cell of the slice in the rows before iy, and in row iy before ix
  @ predicate sk_clear_before{L}(sk_height_map *m, sk_slice *s, sk_choice *choice, sk_clearance_rules *r, integer iy, integer ix) =
  @   \forall integer j, i; sk_under_slice{L}(s, j, i) && (j < iy || (j == iy && i < ix)) ==>
  @     sk_in_map(j, i) && sk_cell_clear{L}(m, s, r, sk_chosen{L}(choice, j, i), j, i);
  @*/

/* A column is the cell's closed square, from below everything up to the effective height plus margin. A cell never observed or stale (seen longer than
 * fresh_us ago, or in the future) is a column without a top: only a vertical plane (nz == 0) separates it. nz < 0 is never accepted. A slice with
 * a cell outside the map is BLOCKED_UNKNOWN.
 * Overpass rule: a cell whose effective height is above pass_mm of that cell is a column without a top too; it is BLOCKED_OVERPASS where the plane
 * chosen for it would separate it at its height, else BLOCKED_COLLISION.
 * Own body: a cell with all four corners within own_body_radius is clear for tail and boom and BLOCKED_UNKNOWN for stick and bucket, whatever it holds.
 * Dig-zone rule, for the implements alone: a cell whose square lies wholly inside a dig zone needs no separation when dig_allowed, every vertex of
 * the slice is at or above the zone's floor, and the cell is observed, fresh (or dig_stale) and no higher than the zone's ceiling; not separated and
 * below the floor it is BLOCKED_FLOOR.
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
