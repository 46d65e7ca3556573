#include "clearance.h"
#include "cell_zone.h"

#define SK_SIDE_MAX 9223372036854775807 /* beyond any n . vertex */

enum { SK_PLANE_UNTRIED = 0, SK_PLANE_HOLDS = 1, SK_PLANE_FAILS = 2 };

/* What is found out about a plane when it is first needed. */
typedef struct sk_tried { uint16_t plane[SK_SLICE_PLANES]; } sk_tried; /* SK_PLANE_* */

/*@ predicate sk_tried_right{L}(sk_slice *s, sk_tried *t) = \forall integer k; 0 <= k < SK_SLICE_PLANES ==>
  @   (\at(t->plane[k], L) == SK_PLANE_HOLDS ==> sk_plane_bounds{L}(s, k)) &&
  @   (\at(t->plane[k], L) == SK_PLANE_FAILS ==> !sk_plane_bounds{L}(s, k)) &&
  @   0 <= \at(t->plane[k], L) <= SK_PLANE_FAILS;
  @*/

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_plane_fits(p);
  @*/
static bool sk_plane_ok(const sk_plane *p)
{
  return -SK_NORMAL_MAX <= p->nx && p->nx <= SK_NORMAL_MAX && -SK_NORMAL_MAX <= p->ny && p->ny <= SK_NORMAL_MAX && -SK_NORMAL_MAX <= p->nz &&
         p->nz <= SK_NORMAL_MAX && -SK_PLANE_OFFSET_MAX <= p->d && p->d <= SK_PLANE_OFFSET_MAX;
}

/*@ requires \valid_read(s) && sk_counts_fit(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_planes_fit(s);
  @*/
static bool sk_planes_ok(const sk_slice *s)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= s->planes;
    @ loop invariant \forall integer j; 0 <= j < k ==> sk_plane_fits(&s->plane[j]);
    @ loop assigns k;
    @ loop variant s->planes - k;
    @*/
  for (k = 0; k < s->planes; k++) {
    if (!sk_plane_ok(&s->plane[k])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && \valid_read(s) && 0 <= i < SK_SLICE_VERTICES && sk_plane_fits(p) && sk_vertex_fits(s, i);
  @ assigns \nothing;
  @ ensures \result > p->d <==> sk_vertex_above(p, s, i);
  @*/
static inline int64_t sk_side_of(const sk_plane *p, const sk_slice *s, int32_t i)
{
  return (int64_t)p->nx * s->xyz_mm[0][i] + (int64_t)p->ny * s->xyz_mm[1][i] + (int64_t)p->nz * s->xyz_mm[2][i];
}

/* The least n . vertex of a slice with all the vertices there can be, as those of the sweep are: a number of rounds known beforehand goes in lanes. */
/*@ requires \valid_read(s) && sk_slice_fits(s) && 0 <= k < s->planes && s->vertices == SK_SLICE_VERTICES;
  @ assigns \nothing;
  @ ensures \result > s->plane[k].d <==> \forall integer i; 0 <= i < s->vertices ==> sk_vertex_above(&s->plane[k], s, i);
  @*/
SK_CLONES static int64_t sk_least_side(const sk_slice *s, int32_t k)
{
  const sk_plane *p = &s->plane[k];
  int64_t least = SK_SIDE_MAX;
  int32_t i;
  /*@ loop invariant 0 <= i <= SK_SLICE_VERTICES;
    @ loop invariant above: least > p->d ==> \forall integer j; 0 <= j < i ==> sk_vertex_above(&s->plane[k], s, j);
    @ loop invariant below: least <= p->d ==> \exists integer j; 0 <= j < i && !sk_vertex_above(&s->plane[k], s, j);
    @ loop assigns i, least;
    @ loop variant SK_SLICE_VERTICES - i;
    @*/
  for (i = 0; i < SK_SLICE_VERTICES; i++) {
    /*@ assert sk_vertex_fits(s, i) && sk_plane_fits(p); */
    int64_t side = sk_side_of(p, s, i);
    least = side < least ? side : least;
  }
  return least;
}

/* Whether every vertex is strictly on the plane's positive side. */
/*@ requires \valid_read(s) && sk_slice_fits(s) && 0 <= k < s->planes;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_plane_bounds(s, k);
  @*/
static bool sk_plane_holds(const sk_slice *s, int32_t k)
{
  const sk_plane *p = &s->plane[k];
  int32_t i;
  if (p->nz < 0) { return false; }
  if (s->vertices == SK_SLICE_VERTICES) { return sk_least_side(s, k) > p->d; }
  /*@ loop invariant 0 <= i <= s->vertices;
    @ loop invariant \forall integer j; 0 <= j < i ==> sk_vertex_above(&s->plane[k], s, j);
    @ loop assigns i;
    @ loop variant s->vertices - i;
    @*/
  for (i = 0; i < s->vertices; i++) {
    /*@ assert sk_vertex_fits(s, i) && sk_plane_fits(p); */
    int64_t side = sk_side_of(p, s, i);
    if (side <= p->d) {
      /*@ assert !sk_vertex_above(&s->plane[k], s, i); */
      return false;
    }
  }
  return true;
}

/* The same, found out once for each plane. */
/*@ requires \valid_read(s) && sk_slice_fits(s) && \valid(t) && \separated(s, t) && 0 <= k && sk_tried_right(s, t);
  @ assigns t->plane[0 .. SK_SLICE_PLANES - 1];
  @ ensures sk_tried_right(s, t);
  @ ensures \result == true <==> k < s->planes && sk_plane_bounds(s, k);
  @*/
static bool sk_plane_usable(const sk_slice *s, sk_tried *t, int32_t k)
{
  if (k >= s->planes) { return false; }
  if (t->plane[k] == SK_PLANE_UNTRIED) {
    if (sk_plane_holds(s, k)) { t->plane[k] = SK_PLANE_HOLDS; }
    else { t->plane[k] = SK_PLANE_FAILS; }
  }
  return t->plane[k] == SK_PLANE_HOLDS;
}

/* Whether the four corners of a cell are on the plane's other side: the one farthest along the normal is. */
/*@ requires \valid_read(p) && sk_plane_fits(p) && sk_coordinate_fits(x_mm) && sk_coordinate_fits(y_mm) && -4294967296 <= z_mm <= 4294967296;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_square_below(p, x_mm, y_mm, z_mm);
  @*/
static bool sk_square_is_below(const sk_plane *p, int64_t x_mm, int64_t y_mm, int64_t z_mm)
{
  int64_t side = p->nx * x_mm + p->ny * y_mm + p->nz * z_mm;
  if (p->nx > 0) { side = side + (int64_t)p->nx * SK_CELL_MM; }
  if (p->ny > 0) { side = side + (int64_t)p->ny * SK_CELL_MM; }
  return side <= p->d;
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_rules_fit(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_known(m, r, iy, ix);
  @*/
static bool sk_is_known(const sk_height_map *m, const sk_clearance_rules *r, int32_t iy, int32_t ix)
{
  return sk_is_current(m, r, iy, ix) || (r->dig_stale && m->seen_us[iy][ix] >= 0);
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_rules_fit(r) && \valid_read(p) && sk_plane_fits(p) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_column_below(m, r, p, iy, ix);
  @*/
static bool sk_column_is_below(const sk_height_map *m, const sk_clearance_rules *r, const sk_plane *p, int32_t iy, int32_t ix)
{
  int32_t x = sk_cell_low_mm(ix);
  int32_t y = sk_cell_low_mm(iy);
  if (sk_is_passable(m, r, iy, ix)) { return sk_square_is_below(p, x, y, sk_column_top_mm(m, r, iy, ix)); }
  return p->nz == 0 && sk_square_is_below(p, x, y, 0);
}

/* A cell that is not separated, by the dig rule: clear, below the floor, or a collision when the rule does not apply. A cell in two zones may be dug
 * when either allows it. */
/*@ requires \valid_read(s) && sk_counts_fit(s) && \valid_read(r) && sk_rules_fit(r) && sk_in_map(iy, ix) && sk_is_lowest(s, 2, z_low_mm);
  @ requires \valid_read(m);
  @ assigns \nothing;
  @ ensures \result == SK_CLEAR || \result == SK_BLOCKED_FLOOR || \result == SK_BLOCKED_COLLISION;
  @ ensures \result == SK_CLEAR <==> sk_dig_exempt(m, s, r, iy, ix);
  @ ensures \result == SK_BLOCKED_FLOOR ==> sk_below_floor(s, r, iy, ix);
  @*/
static int32_t sk_dig_verdict(const sk_height_map *m, const sk_slice *s, const sk_clearance_rules *r, int32_t z_low_mm, int32_t iy, int32_t ix)
{
  bool known = sk_is_known(m, r, iy, ix);
  int32_t top_mm = sk_map_top(m, iy, ix);
  int32_t verdict = SK_BLOCKED_COLLISION;
  int32_t i;
  if (!r->dig_allowed || s->link == 0) { return SK_BLOCKED_COLLISION; }
  /*@ loop invariant 0 <= i <= r->dig_zones;
    @ loop invariant \forall integer j; 0 <= j < i && sk_cell_in_zone(&r->dig_zone[j], iy, ix) ==>
    @   z_low_mm < r->dig_zone[j].floor_mm || !sk_diggable(m, r, j, iy, ix);
    @ loop invariant verdict == SK_BLOCKED_COLLISION || verdict == SK_BLOCKED_FLOOR;
    @ loop invariant verdict == SK_BLOCKED_FLOOR ==> sk_below_floor(s, r, iy, ix);
    @ loop assigns i, verdict;
    @ loop variant r->dig_zones - i;
    @*/
  for (i = 0; i < r->dig_zones; i++) {
    if (sk_is_in_zone(&r->dig_zone[i], iy, ix)) {
      if (z_low_mm < r->dig_zone[i].floor_mm) { verdict = SK_BLOCKED_FLOOR; }
      else if (known && top_mm <= r->dig_zone[i].ceiling_mm) { return SK_CLEAR; }
    }
  }
  return verdict;
}

/* Why a cell that is neither separated nor exempt is blocked, where it is not for the overpass rule. */
/*@ requires \valid_read(m) && \valid_read(r) && sk_rules_fit(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures unknown: \result == SK_BLOCKED_UNKNOWN ==> m->seen_us[iy][ix] < 0;
  @ ensures stale: \result == SK_BLOCKED_STALE ==> 0 <= m->seen_us[iy][ix] && !sk_current(m, r, iy, ix);
  @ ensures collision: \result == SK_BLOCKED_COLLISION ==> sk_current(m, r, iy, ix);
  @ ensures SK_BLOCKED_COLLISION <= \result <= SK_BLOCKED_STALE;
  @*/
static int32_t sk_contact_verdict(const sk_height_map *m, const sk_clearance_rules *r, int32_t iy, int32_t ix)
{
  if (m->seen_us[iy][ix] < 0) { return SK_BLOCKED_UNKNOWN; }
  if (!sk_is_current(m, r, iy, ix)) { return SK_BLOCKED_STALE; }
  return SK_BLOCKED_COLLISION;
}

/*@ predicate sk_readable(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, sk_tried *t) =
  @   \valid_read(m) && \valid_read(s) && \valid_read(r) && \valid(t) && \separated(t, m, s, r);
  @ predicate sk_row_clear{L}(sk_height_map *m, sk_slice *s, sk_choice *choice, sk_clearance_rules *r, integer iy, integer from, integer to) =
  @   \forall integer i; from <= i < to ==> sk_cell_clear{L}(m, s, r, sk_chosen{L}(choice, iy, i), iy, i);
  @*/

/*@ requires sk_readable(m, s, r, t) && sk_slice_fits(s) && sk_rules_fit(r) && sk_tried_right(s, t);
  @ requires 0 <= k && sk_in_map(iy, ix);
  @ assigns t->plane[0 .. SK_SLICE_PLANES - 1];
  @ ensures sk_tried_right(s, t);
  @ ensures \result == true <==> sk_separated(m, s, r, k, iy, ix);
  @*/
static bool sk_is_separated(const sk_height_map *m, const sk_slice *s, int32_t k, const sk_clearance_rules *r, sk_tried *t, int32_t iy, int32_t ix)
{
  if (!sk_plane_usable(s, t, k)) { return false; }
  return sk_column_is_below(m, r, &s->plane[k], iy, ix);
}

/* Whether the slice is clear of a current column at its height, which is too high to be passed over. */
/*@ requires sk_readable(m, s, r, t) && sk_slice_fits(s) && sk_rules_fit(r) && sk_tried_right(s, t);
  @ requires 0 <= k && sk_in_map(iy, ix);
  @ assigns t->plane[0 .. SK_SLICE_PLANES - 1];
  @ ensures sk_tried_right(s, t);
  @ ensures \result == true <==> sk_current(m, r, iy, ix) && !sk_passable(m, r, iy, ix) && k < s->planes && sk_plane_bounds(s, k) &&
  @   sk_square_below(&s->plane[k], sk_cell_low(ix), sk_cell_low(iy), sk_column_top(m, r, iy, ix));
  @*/
SK_SELDOM static bool sk_would_pass_over(const sk_height_map *m, const sk_slice *s, int32_t k, const sk_clearance_rules *r, sk_tried *t, int32_t iy,
                                         int32_t ix)
{
  if (!sk_is_current(m, r, iy, ix) || sk_is_passable(m, r, iy, ix) || !sk_plane_usable(s, t, k)) { return false; }
  return sk_square_is_below(&s->plane[k], sk_cell_low_mm(ix), sk_cell_low_mm(iy), sk_column_top_mm(m, r, iy, ix));
}

/*@ requires sk_readable(m, s, r, t) && sk_slice_fits(s) && sk_rules_fit(r) && sk_tried_right(s, t);
  @ requires 0 <= k && sk_in_map(iy, ix) && sk_is_lowest(s, 2, z_low_mm);
  @ assigns t->plane[0 .. SK_SLICE_PLANES - 1];
  @ ensures sk_tried_right(s, t);
  @ ensures \result == SK_CLEAR <==> sk_cell_clear(m, s, r, k, iy, ix);
  @ ensures \result != SK_CLEAR ==> sk_blocked_because(m, s, r, iy, ix, \result);
  @*/
static int32_t sk_cell_verdict(const sk_height_map *m, const sk_slice *s, int32_t k, const sk_clearance_rules *r, sk_tried *t, int32_t z_low_mm,
                               int32_t iy, int32_t ix)
{
  int32_t verdict;
  if (sk_is_own_body(r, iy, ix)) {
    if (s->link <= 1) { return SK_CLEAR; }
    return SK_BLOCKED_UNKNOWN;
  }
  if (sk_is_separated(m, s, k, r, t, iy, ix)) { return SK_CLEAR; }
  verdict = sk_dig_verdict(m, s, r, z_low_mm, iy, ix);
  if (verdict != SK_BLOCKED_COLLISION) { return verdict; }
  if (sk_would_pass_over(m, s, k, r, t, iy, ix)) { return SK_BLOCKED_OVERPASS; }
  return sk_contact_verdict(m, r, iy, ix);
}

/* What a cell is held against to be clear at a glance, as nearly all are: current, no higher than may be passed over, and below a level plane 0. */
typedef struct sk_glance {
  bool level;                   /* whether there is such a plane, and no own body to look for */
  int64_t oldest_us, newest_us; /* of a current cell */
  int32_t most_mm;              /* height without the margin */
} sk_glance;

/*@ predicate sk_level_plane{L}(sk_plane *p) = \at(p->nx, L) == 0 && \at(p->ny, L) == 0 && \at(p->nz, L) == 1;
  @ lemma sk_level_square{L}: \forall sk_plane *p; \forall integer x, y, z;
  @   sk_level_plane{L}(p) && z <= \at(p->d, L) ==> sk_square_below{L}(p, x, y, z);
  @ predicate sk_glance_right{L}(sk_slice *s, sk_clearance_rules *r, sk_glance g) = g.level != 0 ==>
  @   sk_plane_bounds{L}(s, 0) && sk_level_plane{L}(&s->plane[0]) && \at(r->own_body_radius_mm, L) == 0 &&
  @   0 <= g.oldest_us && \at(r->now_us, L) - \at(r->fresh_us, L) <= g.oldest_us && g.newest_us == \at(r->now_us, L) &&
  @   g.most_mm == \at(s->plane[0].d, L) - \at(r->margin_mm, L);
  @*/

/*@ requires \valid_read(m) && \valid_read(s) && \valid_read(r) && sk_slice_fits(s) && sk_rules_fit(r) && 0 <= k;
  @ requires sk_in_map(iy, ix) && sk_glance_right(s, r, g);
  @ assigns \nothing;
  @ ensures \result == true ==> sk_cell_clear(m, s, r, k, iy, ix);
  @*/
static inline bool sk_is_settled(const sk_height_map *m, const sk_slice *s, int32_t k, const sk_clearance_rules *r, sk_glance g, int32_t iy, int32_t ix)
{
  int64_t seen_us = m->seen_us[iy][ix];
  int32_t most_mm = r->pass_mm[iy][ix] < g.most_mm ? r->pass_mm[iy][ix] : g.most_mm;
  (void)s;
  /*@ assert nobody: g.level != 0 ==> !sk_own_body(r, iy, ix); */
  if (k != 0 || !g.level || seen_us < g.oldest_us || seen_us > g.newest_us) { return false; }
  /*@ assert current: sk_current(m, r, iy, ix); */
  if (m->height_mm[iy][ix] > most_mm || m->previous_mm[iy][ix] > most_mm) { return false; }
  /*@ assert passable: sk_passable(m, r, iy, ix); */
  /*@ assert top: sk_column_top(m, r, iy, ix) <= s->plane[0].d; */
  /*@ assert square: sk_square_below(&s->plane[0], sk_cell_low(ix), sk_cell_low(iy), sk_column_top(m, r, iy, ix)); */
  /*@ assert column: sk_column_below(m, r, &s->plane[0], iy, ix); */
  return true;
}

/* A plane 0 that is level and below the lowest vertex, as that of the sweep's slices is, need not be held against the vertices. */
/*@ requires \valid_read(s) && \valid_read(r) && sk_slice_fits(s) && sk_rules_fit(r) && sk_is_lowest(s, 2, z_low_mm);
  @ assigns \nothing;
  @ ensures sk_glance_right(s, r, \result);
  @*/
static sk_glance sk_glance_of(const sk_slice *s, const sk_clearance_rules *r, int32_t z_low_mm)
{
  const sk_plane *p = &s->plane[0];
  sk_glance g;
  g.level = r->own_body_radius_mm == 0 && p->nx == 0 && p->ny == 0 && p->nz == 1 && p->d < z_low_mm && p->d >= -SK_COORD_MAX_MM - 1;
  g.oldest_us = sk_most_of(0, r->now_us - r->fresh_us);
  g.newest_us = r->now_us;
  g.most_mm = g.level ? (int32_t)p->d - r->margin_mm : 0;
  /*@ assert above: g.level != 0 ==> \forall integer i; 0 <= i < s->vertices ==> sk_vertex_above(&s->plane[0], s, i); */
  return g;
}

/* Whether a cell is below a plane that was found to hold for a cell before it, where there is no own body to look for. */
/*@ requires sk_readable(m, s, r, t) && sk_slice_fits(s) && sk_rules_fit(r) && sk_tried_right(s, t) && 0 <= k && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true ==> sk_cell_clear(m, s, r, k, iy, ix);
  @*/
static inline bool sk_is_below_known(const sk_height_map *m, const sk_slice *s, int32_t k, const sk_clearance_rules *r, const sk_tried *t, int32_t iy, int32_t ix)
{
  /*@ assert nobody: r->own_body_radius_mm == 0 ==> !sk_own_body(r, iy, ix); */
  if (k >= s->planes || r->own_body_radius_mm != 0 || t->plane[k] != SK_PLANE_HOLDS) { return false; }
  return sk_column_is_below(m, r, &s->plane[k], iy, ix);
}

/* The first of a row's cells from one on that is not settled, or one beyond the last. */
/*@ requires \valid_read(m) && \valid_read(s) && \valid_read(choice) && \valid_read(r) && sk_slice_fits(s) && sk_rules_fit(r);
  @ requires sk_glance_right(s, r, g) && 0 <= iy < SK_MAP_CELLS && 0 <= from <= to + 1 && to < SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures from <= \result <= to + 1;
  @ ensures sk_row_clear(m, s, choice, r, iy, from, \result);
  @*/
static inline int32_t sk_settled_end(const sk_height_map *m, const sk_slice *s, const sk_choice *choice, const sk_clearance_rules *r, sk_glance g, int32_t iy,
                                     int32_t from, int32_t to)
{
  int32_t ix;
  /*@ loop invariant from <= ix <= to + 1;
    @ loop invariant sk_row_clear(m, s, choice, r, iy, from, ix);
    @ loop assigns ix;
    @ loop variant to - ix;
    @*/
  for (ix = from; ix <= to; ix++) {
    if (!sk_is_settled(m, s, choice->plane_of[iy][ix], r, g, iy, ix)) { return ix; }
  }
  return ix;
}

/* Column of the first blocked cell of a row, ix_high + 1 when all are clear. */
/*@ requires sk_readable(m, s, r, t) && sk_slice_fits(s) && sk_rules_fit(r) && sk_tried_right(s, t) && sk_is_lowest(s, 2, z_low_mm);
  @ requires \valid_read(choice) && \separated(t, choice) && sk_glance_right(s, r, g);
  @ requires 0 <= iy < SK_MAP_CELLS && 0 <= ix_low <= ix_high < SK_MAP_CELLS;
  @ assigns t->plane[0 .. SK_SLICE_PLANES - 1];
  @ ensures sk_tried_right(s, t);
  @ ensures ix_low <= \result <= ix_high + 1;
  @ ensures clear: sk_row_clear{Pre}(m, s, choice, r, iy, ix_low, \result);
  @ ensures blocked: \result <= ix_high ==>
  @   !sk_cell_clear{Pre}(m, s, r, sk_chosen{Pre}(choice, iy, \result), iy, \result);
  @*/
static int32_t sk_row_end(const sk_height_map *m, const sk_slice *s, const sk_choice *choice, const sk_clearance_rules *r, sk_tried *t,
                          int32_t z_low_mm, sk_glance g, int32_t iy, int32_t ix_low, int32_t ix_high)
{
  int32_t ix;
  /*@ loop invariant ix_low <= ix <= ix_high + 1;
    @ loop invariant sk_tried_right(s, t);
    @ loop invariant sk_row_clear{Pre}(m, s, choice, r, iy, ix_low, ix);
    @ loop assigns ix, t->plane[0 .. SK_SLICE_PLANES - 1];
    @ loop variant ix_high - ix;
    @*/
  for (ix = sk_settled_end(m, s, choice, r, g, iy, ix_low, ix_high); ix <= ix_high; ix = sk_settled_end(m, s, choice, r, g, iy, ix + 1, ix_high)) {
    bool below = sk_is_below_known(m, s, choice->plane_of[iy][ix], r, t, iy, ix);
    if (!below && sk_cell_verdict(m, s, choice->plane_of[iy][ix], r, t, z_low_mm, iy, ix) != SK_CLEAR) { return ix; }
  }
  return ix;
}

/*@ requires \valid(out);
  @ assigns *out;
  @ ensures out->verdict == verdict && out->iy == iy && out->ix == ix && out->cells == cells;
  @*/
static void sk_report(sk_clearance_result *out, int32_t verdict, int32_t iy, int32_t ix, int32_t cells)
{
  out->verdict = verdict;
  out->iy = iy;
  out->ix = ix;
  out->cells = cells;
}

/*@ requires \valid(t);
  @ assigns t->plane[0 .. SK_SLICE_PLANES - 1];
  @ ensures sk_tried_right(s, t);
  @*/
static void sk_untried(const sk_slice *s, sk_tried *t)
{
  int32_t k;
  (void)s;
  /*@ loop invariant 0 <= k <= SK_SLICE_PLANES;
    @ loop invariant \forall integer j; 0 <= j < k ==> t->plane[j] == SK_PLANE_UNTRIED;
    @ loop assigns k, t->plane[0 .. SK_SLICE_PLANES - 1];
    @ loop variant SK_SLICE_PLANES - k;
    @*/
  for (k = 0; k < SK_SLICE_PLANES; k++) { t->plane[k] = SK_PLANE_UNTRIED; }
}

/* The cells of the rectangle row by row, up to the first that is blocked. */
/*@ requires \valid_read(m) && \valid_read(s) && \valid_read(choice) && \valid_read(r) && \valid(out) && \separated(out, m, s, choice, r);
  @ requires sk_slice_fits(s) && sk_rules_fit(r);
  @ requires sk_range_in_map(f.cells) && sk_is_lowest(s, 2, f.z_low_mm);
  @ requires sk_extent_is_range(s, 0, f.cells.ix_low, f.cells.ix_high) && sk_extent_is_range(s, 1, f.cells.iy_low, f.cells.iy_high);
  @ assigns *out;
  @ ensures verdicts: SK_CLEAR <= out->verdict < SK_BLOCKED_INVALID;
  @ ensures clear: out->verdict == SK_CLEAR ==> sk_clear_before{Pre}(m, s, choice, r, SK_MAP_CELLS, 0);
  @ ensures no_cell: out->iy < 0 ==> out->iy == -1 && out->ix == -1 && out->verdict == SK_CLEAR;
  @ ensures blocked: out->iy >= 0 ==> sk_in_map(out->iy, out->ix) && sk_under_slice{Pre}(s, out->iy, out->ix) &&
  @   !sk_cell_clear{Pre}(m, s, r, sk_chosen{Pre}(choice, out->iy, out->ix), out->iy, out->ix) &&
  @   sk_blocked_because{Pre}(m, s, r, out->iy, out->ix, out->verdict);
  @ ensures first: out->iy >= 0 ==> sk_clear_before{Pre}(m, s, choice, r, out->iy, out->ix);
  @*/
static void sk_check_box(const sk_height_map *m, const sk_slice *s, const sk_choice *choice, const sk_clearance_rules *r, sk_footprint f,
                         sk_clearance_result *out)
{
  sk_rectangle box = f.cells;
  int32_t z_low_mm = f.z_low_mm;
  sk_glance g = sk_glance_of(s, r, z_low_mm);
  sk_tried tried;
  int32_t cells = 0;
  int32_t iy;
  sk_untried(s, &tried);
  /*@ loop invariant box.iy_low <= iy <= box.iy_high + 1;
    @ loop invariant sk_tried_right(s, &tried);
    @ loop invariant \forall integer j, i; box.iy_low <= j < iy && box.ix_low <= i <= box.ix_high ==>
    @   sk_cell_clear{Pre}(m, s, r, sk_chosen{Pre}(choice, j, i), j, i);
    @ loop invariant 0 <= cells <= SK_MAP_CELLS * (iy - box.iy_low);
    @ loop assigns iy, cells, tried.plane[0 .. SK_SLICE_PLANES - 1];
    @ loop variant box.iy_high - iy;
    @*/
  for (iy = box.iy_low; iy <= box.iy_high; iy++) {
    int32_t ix = sk_row_end(m, s, choice, r, &tried, z_low_mm, g, iy, box.ix_low, box.ix_high);
    cells = cells + (ix - box.ix_low);
    if (ix <= box.ix_high) {
      int32_t verdict = sk_cell_verdict(m, s, choice->plane_of[iy][ix], r, &tried, z_low_mm, iy, ix);
      /*@ assert first: sk_clear_before{Pre}(m, s, choice, r, iy, ix); */
      /*@ assert under: sk_under_slice{Pre}(s, iy, ix); */
      /*@ assert not_clear: !sk_cell_clear{Pre}(m, s, r, sk_chosen{Pre}(choice, iy, ix), iy, ix); */
      /*@ assert why: sk_blocked_because{Pre}(m, s, r, iy, ix, verdict); */
      sk_report(out, verdict, iy, ix, cells + 1);
      return;
    }
  }
  /*@ assert all: sk_clear_before{Pre}(m, s, choice, r, SK_MAP_CELLS, 0); */
  sk_report(out, SK_CLEAR, -1, -1, cells);
}

void sk_clear_slice(const sk_height_map *m, const sk_slice *s, const sk_choice *choice, const sk_clearance_rules *rules, sk_clearance_result *out)
{
  sk_footprint f;
  bool inside;
  f.z_low_mm = 0;
  inside = sk_slice_footprint(s, &f); /* has looked at every vertex then */
  if (!sk_rules_ok(rules) || (!inside && !sk_slice_vertices_ok(s)) || !sk_planes_ok(s)) {
    sk_report(out, SK_BLOCKED_INVALID, -1, -1, 0);
    return;
  }
  if (!inside) {
    sk_report(out, SK_BLOCKED_UNKNOWN, -1, -1, 0);
    return;
  }
  sk_check_box(m, s, choice, rules, f, out);
}
