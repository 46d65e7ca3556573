#include "scanline_raster.h"
#include "map_cell.h"

/* A segment seen along its longer horizontal axis: columns are cells along it, rows cells across it. */
typedef struct sk_course {
  bool along_x;            /* columns run along x */
  int32_t a0, b0, z0;      /* the end with the lower coordinate along */
  int32_t da, db, dz;      /* to the other end; da > 0 */
} sk_course;

/* Bounds of the segment, relative to its start, where it passes a column's border. */
typedef struct sk_border { int32_t b_low, b_high, z_high; } sk_border;

/*@ // algebra of one line from (0, 0) to (da, dv); each lemma is proved like any goal
  @ lemma sk_unscale: \forall real d, x, y; d > 0 && sk_times(d, x) <= sk_times(d, y) ==> x <= y;
  @ lemma sk_rising: \forall real s, r0, r1; s >= 0 && r0 <= r1 ==> sk_times(s, r0) <= sk_times(s, r1);
  @ lemma sk_falling: \forall real s, r0, r1; s <= 0 && r0 <= r1 ==> sk_times(s, r0) >= sk_times(s, r1);
  @ lemma sk_amid: \forall real s, r, r0, r1; r0 <= r <= r1 ==> (sk_times(s, r0) <= sk_times(s, r) <= sk_times(s, r1) ||
  @   sk_times(s, r1) <= sk_times(s, r) <= sk_times(s, r0));
  @ lemma sk_still_over: \forall real dv, da, v, w, r; da > 0 && w >= v && sk_over_line(dv, da, r, v) ==> sk_over_line(dv, da, r, w);
  @ lemma sk_still_under: \forall real dv, da, v, w, r; da > 0 && w <= v && sk_under_line(dv, da, r, v) ==> sk_under_line(dv, da, r, w);
  @ // a bound at both ends of a piece is a bound on the piece
  @ lemma sk_bounded_above: \forall real dv, da, a, v, r0, r1, u; da > 0 && r0 <= a <= r1 && sk_on_line(dv, da, a, v) &&
  @   sk_over_line(dv, da, r0, u) && sk_over_line(dv, da, r1, u) ==> v <= u;
  @ lemma sk_bounded_below: \forall real dv, da, a, v, r0, r1, u; da > 0 && r0 <= a <= r1 && sk_on_line(dv, da, a, v) &&
  @   sk_under_line(dv, da, r0, u) && sk_under_line(dv, da, r1, u) ==> v >= u;
  @ lemma sk_fraction_on: \forall real dv, da, t; sk_on_line(dv, da, sk_times(t, da), sk_times(t, dv));
  @ lemma sk_fraction_within: \forall real t, d; 0 <= t <= 1 && d >= 0 ==> 0 <= sk_times(t, d) <= d;
  @ lemma sk_at_run: \forall integer v0, v1, d; \forall real t; d == v1 - v0 ==> sk_at(v0, v1, t) == v0 + sk_times(t, d);
  @ // along a segment: level, below its higher end, and the same from its other end
  @ lemma sk_level: \forall integer v; \forall real t; sk_at(v, v, t) == v;
  @ lemma sk_below_higher_end: \forall integer v0, v1; \forall real t; 0 <= t <= 1 ==> sk_at(v0, v1, t) <= sk_most(v0, v1);
  @ lemma sk_from_other_end: \forall integer v0, v1; \forall real t; sk_at(v0, v1, t) == sk_at(v1, v0, 1 - t);
  @ lemma sk_crosses_turned: \forall sk_point p, q; \forall real t; \forall integer iy, ix;
  @   sk_crosses(p, q, t, iy, ix) ==> sk_crosses(q, p, 1 - t, iy, ix);
  @ lemma sk_covers_turned{L}: \forall sk_height_map *m; \forall sk_point p, q; \forall integer now;
  @   sk_covers{L}(m, q, p, now) ==> sk_covers{L}(m, p, q, now);
  @ lemma sk_raises_turned{A, B}: \forall sk_height_map *m; \forall sk_point p, q; \forall integer now;
  @   sk_only_raises{A, B}(m, q, p, now) ==> sk_only_raises{A, B}(m, p, q, now);
  @ lemma sk_above_lower_end: \forall integer v0, v1; \forall real t; 0 <= t <= 1 ==> sk_at(v0, v1, t) >= sk_least(v0, v1);
  @ predicate sk_inside(integer i, integer v) = sk_cell_low(i) < v < sk_cell_low(i) + SK_CELL_MM;
  @ predicate sk_strictly_in(integer i, real v) = sk_cell_low(i) < v < sk_cell_low(i) + SK_CELL_MM;
  @ lemma sk_one_cell: \forall integer i, j; \forall real v; sk_strictly_in(i, v) && sk_cell_holds(j, v) ==> j == i;
  @ lemma sk_stays_inside: \forall integer i, v0, v1; \forall real t; 0 <= t <= 1 && sk_inside(i, v0) && sk_inside(i, v1) ==>
  @   sk_strictly_in(i, sk_at(v0, v1, t));
  @ lemma sk_only_cell: \forall integer i, j, v0, v1; \forall real t; 0 <= t <= 1 && sk_inside(i, v0) && sk_inside(i, v1) ==>
  @   sk_cell_holds(j, sk_at(v0, v1, t)) ==> j == i;
  @ // the cells over one coordinate: that which holds it, and the one below where it is a border
  @ predicate sk_first_or_last(integer i, integer v) = sk_cell_low(i) <= v <= sk_cell_low(i) + SK_CELL_MM;
  @
  @ predicate sk_coordinate_in_range(integer v) = -SK_COORD_MAX_MM <= v <= SK_COORD_MAX_MM;
  @ predicate sk_height_in_range(integer z) = -SK_HEIGHT_MAX_MM <= z <= SK_HEIGHT_MAX_MM;
  @ predicate sk_course_fits(sk_course s) = 0 < s.da && sk_coordinate_in_range(s.a0) && sk_coordinate_in_range(s.a0 + s.da) &&
  @   sk_coordinate_in_range(s.b0) && sk_coordinate_in_range(s.b0 + s.db) && sk_height_in_range(s.z0) && sk_height_in_range(s.z0 + s.dz);
  @ logic integer sk_column_of(integer along_x, integer iy, integer ix) = along_x != 0 ? ix : iy;
  @ logic integer sk_row_of(integer along_x, integer iy, integer ix) = along_x != 0 ? iy : ix;
  @ logic integer sk_along(integer along_x, sk_point p) = along_x != 0 ? p.x_mm : p.y_mm;
  @ logic integer sk_across(integer along_x, sk_point p) = along_x != 0 ? p.y_mm : p.x_mm;
  @ // the part of a course inside a column, measured from the course's start
  @ logic integer sk_entry(sk_course s, integer column) = sk_most(0, sk_cell_low(column) - s.a0);
  @ logic integer sk_exit(sk_course s, integer column) = sk_least(s.da, sk_cell_low(column) + SK_CELL_MM - s.a0);
  @ predicate sk_border_is(sk_course s, integer run, sk_border b) = sk_under_line(s.db, s.da, run, b.b_low) &&
  @   sk_over_line(s.db, s.da, run, b.b_high) && sk_over_line(s.dz, s.da, run, b.z_high);
  @ predicate sk_border_fits(sk_course s, sk_border b) = sk_least(0, s.db) <= b.b_low && b.b_high <= sk_most(0, s.db) &&
  @   b.b_low <= sk_most(0, s.db) && sk_least(0, s.db) <= b.b_high && sk_least(0, s.dz) <= b.z_high <= sk_most(0, s.dz);
  @ // the course's point (a, b, z), relative to its start, lies over a cell
  @ predicate sk_course_over(sk_course s, real a, real b, real z, integer column, integer row) = 0 <= a <= s.da &&
  @   sk_on_line(s.db, s.da, a, b) && sk_on_line(s.dz, s.da, a, z) && sk_cell_holds(column, s.a0 + a) && sk_cell_holds(row, s.b0 + b);
  @ // every cell in a column before the given one
  @ predicate sk_course_covers{L}(sk_height_map *m, sk_course s, integer column, integer now) = \forall real a, b, z; \forall integer iy, ix;
  @   sk_in_map(iy, ix) && sk_column_of(s.along_x, iy, ix) < column &&
  @   sk_course_over(s, a, b, z, sk_column_of(s.along_x, iy, ix), sk_row_of(s.along_x, iy, ix)) ==>
  @     \at(m->height_mm[iy][ix], L) >= s.z0 + z && \at(m->seen_us[iy][ix], L) == now;
  @ predicate sk_raised_over{A, B}(sk_height_map *m, integer iy, integer ix, integer now) =
  @   sk_cell_raised{A, B}(m, iy, ix, -SK_HEIGHT_MAX_MM, now);
  @ predicate sk_course_raises{A, B}(sk_height_map *m, sk_course s, integer column, integer now) = \forall integer iy, ix; sk_in_map(iy, ix) ==>
  @   sk_cell_kept{A, B}(m, iy, ix) || (sk_column_of(s.along_x, iy, ix) < column && sk_cell_meets(sk_column_of(s.along_x, iy, ix), s.a0, s.a0 + s.da) &&
  @     sk_cell_meets(sk_row_of(s.along_x, iy, ix), s.b0, s.b0 + s.db) && sk_raised_over{A, B}(m, iy, ix, now));
  @ predicate sk_in_column(integer along_x, integer iy, integer ix, integer column) = sk_in_map(iy, ix) && sk_column_of(along_x, iy, ix) == column;
  @*/

/*@ requires sk_course_fits(s) && 0 <= run <= s.da;
  @ assigns \nothing;
  @ ensures sk_border_is(s, run, \result);
  @ ensures sk_border_fits(s, \result);
  @*/
static sk_border sk_border_at(sk_course s, int32_t run)
{
  sk_scaled across = sk_scale(s.db, run, s.da);
  sk_scaled up = sk_scale(s.dz, run, s.da);
  sk_border b;
  b.b_low = across.low;
  b.b_high = across.high;
  b.z_high = up.high;
  return b;
}

/* At the course's start; at neither end is anything divided. */
/*@ requires sk_course_fits(s);
  @ assigns \nothing;
  @ ensures sk_border_is(s, 0, \result);
  @ ensures sk_border_fits(s, \result);
  @*/
static sk_border sk_border_first(sk_course s)
{
  sk_border b;
  (void)s;
  b.b_low = 0;
  b.b_high = 0;
  b.z_high = 0;
  return b;
}

/*@ requires sk_course_fits(s);
  @ assigns \nothing;
  @ ensures sk_border_is(s, s.da, \result);
  @ ensures sk_border_fits(s, \result);
  @*/
static sk_border sk_border_last(sk_course s)
{
  sk_border b;
  b.b_low = s.db;
  b.b_high = s.db;
  b.z_high = s.dz;
  return b;
}

/* Raises a cell where it is in the map, and says whether. */
/*@ requires \valid(m) && now_us >= 0 && generation_us > 0 && sk_height_in_range(z_mm);
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures accepts: \result == true <==> sk_in_map(iy, ix);
  @ ensures refused: \result == false ==> sk_map_kept{Pre, Post}(m);
  @ ensures others: sk_others_kept{Pre, Post}(m, iy, ix);
  @ ensures raised: \result == true ==> sk_cell_raised{Pre, Post}(m, iy, ix, z_mm, now_us);
  @*/
static bool sk_raise_at(sk_height_map *m, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us, int32_t generation_us)
{
  if (iy < 0 || iy >= SK_MAP_CELLS || ix < 0 || ix >= SK_MAP_CELLS) { return false; }
  sk_raise_cell(m, iy, ix, z_mm, now_us, generation_us);
  return true;
}

/* Raises the cells of one column that meet [b_low, b_high] across it. */
/*@ requires \valid(m) && now_us >= 0 && generation_us > 0;
  @ requires sk_coordinate_in_range(b_low) && sk_coordinate_in_range(b_high) && sk_height_in_range(z);
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures 0 <= \result <= 1000;
  @ ensures raised: \forall integer iy, ix; sk_in_column(along_x, iy, ix, column) && sk_cell_low(sk_row_of(along_x, iy, ix)) <= b_high &&
  @   b_low <= sk_cell_low(sk_row_of(along_x, iy, ix)) + SK_CELL_MM ==> sk_cell_raised{Pre, Post}(m, iy, ix, z, now_us);
  @ ensures kept: \forall integer iy, ix; sk_in_map(iy, ix) && !(sk_column_of(along_x, iy, ix) == column &&
  @   sk_cell_low(sk_row_of(along_x, iy, ix)) <= b_high && b_low <= sk_cell_low(sk_row_of(along_x, iy, ix)) + SK_CELL_MM) ==>
  @   sk_cell_kept{Pre, Post}(m, iy, ix);
  @*/
static int32_t sk_raise_span(sk_height_map *m, bool along_x, int32_t column, int32_t b_low, int32_t b_high, int32_t z, int64_t now_us,
                             int32_t generation_us)
{
  int32_t first = sk_cell_of(b_low - 1); /* a cell that ends at b_low is touched */
  int32_t last = sk_cell_of(b_high);
  int32_t count = 0;
  int32_t row;
  /*@ loop invariant first <= row && (row <= last + 1 || row == first);
    @ loop invariant 0 <= count <= row - first;
    @ loop invariant raised: \forall integer iy, ix; sk_in_column(along_x, iy, ix, column) && first <= sk_row_of(along_x, iy, ix) < row ==>
    @   sk_cell_raised{Pre, Here}(m, iy, ix, z, now_us);
    @ loop invariant kept: \forall integer iy, ix;
    @   sk_in_map(iy, ix) && !(sk_column_of(along_x, iy, ix) == column && first <= sk_row_of(along_x, iy, ix) < row) ==>
    @   sk_cell_kept{Pre, Here}(m, iy, ix);
    @ loop assigns row, count, m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
    @ loop variant last - row;
    @*/
  for (row = first; row <= last; row++) {
    int32_t iy = along_x ? row : column;
    int32_t ix = along_x ? column : row;
    if (sk_raise_at(m, iy, ix, z, now_us, generation_us)) { count = count + 1; }
  }
  return count;
}

/* Raises the cells of one column that the course crosses, between its borders. */
/*@ requires \valid(m) && now_us >= 0 && generation_us > 0 && sk_course_fits(s);
  @ requires sk_border_is(s, sk_entry(s, column), in) && sk_border_fits(s, in);
  @ requires sk_border_is(s, sk_exit(s, column), out) && sk_border_fits(s, out);
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures 0 <= \result <= 1000;
  @ ensures covers: \forall real a, b, z; \forall integer iy, ix; sk_in_column(s.along_x, iy, ix, column) &&
  @   sk_course_over(s, a, b, z, column, sk_row_of(s.along_x, iy, ix)) ==> m->height_mm[iy][ix] >= s.z0 + z && m->seen_us[iy][ix] == now_us;
  @ ensures others: \forall integer iy, ix; sk_in_map(iy, ix) && sk_column_of(s.along_x, iy, ix) != column ==> sk_cell_kept{Pre, Post}(m, iy, ix);
  @ ensures raises: \forall integer iy, ix; sk_in_column(s.along_x, iy, ix, column) ==> sk_cell_kept{Pre, Post}(m, iy, ix) ||
  @   (sk_cell_meets(sk_row_of(s.along_x, iy, ix), s.b0, s.b0 + s.db) && sk_raised_over{Pre, Post}(m, iy, ix, now_us));
  @*/
static int32_t sk_raise_column(sk_height_map *m, sk_course s, int32_t column, sk_border in, sk_border out, int64_t now_us, int32_t generation_us)
{
  int32_t b_low = (int32_t)sk_least_of(in.b_low, out.b_low);
  int32_t b_high = (int32_t)sk_most_of(in.b_high, out.b_high);
  int32_t z_high = (int32_t)sk_most_of(in.z_high, out.z_high);
  /*@ assert sk_under_line(s.db, s.da, sk_entry(s, column), b_low) && sk_under_line(s.db, s.da, sk_exit(s, column), b_low); */
  /*@ assert sk_over_line(s.db, s.da, sk_entry(s, column), b_high) && sk_over_line(s.db, s.da, sk_exit(s, column), b_high); */
  /*@ assert sk_over_line(s.dz, s.da, sk_entry(s, column), z_high) && sk_over_line(s.dz, s.da, sk_exit(s, column), z_high); */
  /*@ assert piece: \forall real a, b, z; \forall integer row; sk_course_over(s, a, b, z, column, row) ==>
    @   b_low <= b <= b_high && z <= z_high; */
  return sk_raise_span(m, s.along_x, column, s.b0 + b_low, s.b0 + b_high, s.z0 + z_high, now_us, generation_us);
}

/* Walks the columns from border to border. */
/*@ requires \valid(m) && now_us >= 0 && generation_us > 0 && sk_course_fits(s);
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures 0 <= \result <= 1000000;
  @ ensures covers: sk_course_covers(m, s, 1000, now_us);
  @ ensures raises: sk_course_raises{Pre, Post}(m, s, 1000, now_us);
  @*/
static int32_t sk_raise_course(sk_height_map *m, sk_course s, int64_t now_us, int32_t generation_us)
{
  int32_t first = sk_cell_of(s.a0 - 1);
  int32_t last = sk_cell_of(s.a0 + s.da);
  sk_border in = sk_border_first(s);
  sk_border out;
  int32_t count = 0;
  int32_t column;
  /*@ loop invariant first <= column <= last;
    @ loop invariant 0 <= count <= 1000 * (column - first);
    @ loop invariant sk_border_is(s, sk_entry(s, column), in) && sk_border_fits(s, in);
    @ loop invariant covers: sk_course_covers(m, s, column, now_us);
    @ loop invariant raises: sk_course_raises{Pre, Here}(m, s, column, now_us);
    @ loop assigns column, count, in, out, m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
    @ loop variant last - column;
    @*/
  for (column = first; column < last; column++) {
    out = sk_border_at(s, SK_CELL_MM * (column + 1) + SK_MAP_ORIGIN_MM - s.a0);
    count = count + sk_raise_column(m, s, column, in, out, now_us, generation_us);
    in = out;
  }
  out = sk_border_last(s);
  return count + sk_raise_column(m, s, last, in, out, now_us, generation_us);
}

/* Both ends over one point of the ground. */
/*@ requires \valid(m) && now_us >= 0 && generation_us > 0 && sk_point_fits(p) && sk_point_fits(q) && p.x_mm == q.x_mm && p.y_mm == q.y_mm;
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures 0 <= \result;
  @ ensures covers: sk_covers(m, p, q, now_us);
  @ ensures only: sk_only_raises{Pre, Post}(m, p, q, now_us);
  @*/
static int32_t sk_raise_point(sk_height_map *m, sk_point p, sk_point q, int64_t now_us, int32_t generation_us)
{
  int32_t z = (int32_t)sk_most_of(p.z_mm, q.z_mm);
  int32_t first = sk_cell_of(p.x_mm - 1);
  int32_t last = sk_cell_of(p.x_mm);
  int32_t count = sk_raise_span(m, true, first, p.y_mm, p.y_mm, z, now_us, generation_us);
  if (first < last) { count = count + sk_raise_span(m, true, last, p.y_mm, p.y_mm, z, now_us, generation_us); }
  /*@ assert two_columns: \forall integer i; sk_first_or_last(i, p.x_mm) ==> i == first || i == last; */
  /*@ assert cells: \forall integer iy, ix; sk_in_map(iy, ix) && sk_first_or_last(ix, p.x_mm) && sk_first_or_last(iy, p.y_mm) ==>
    @   m->height_mm[iy][ix] >= z && m->seen_us[iy][ix] == now_us; */
  /*@ assert over: \forall real t; \forall integer iy, ix; sk_crosses(p, q, t, iy, ix) ==>
    @   sk_first_or_last(ix, p.x_mm) && sk_first_or_last(iy, p.y_mm) && sk_at(p.z_mm, q.z_mm, t) <= z; */
  return count;
}

/*@ requires sk_point_fits(p) && sk_point_fits(q) && sk_along(along_x, p) < sk_along(along_x, q);
  @ assigns \nothing;
  @ ensures sk_course_fits(\result) && \result.along_x == along_x && \result.a0 == sk_along(along_x, p) && \result.b0 == sk_across(along_x, p);
  @ ensures \result.da == sk_along(along_x, q) - sk_along(along_x, p) && \result.db == sk_across(along_x, q) - sk_across(along_x, p);
  @ ensures \result.z0 == p.z_mm && \result.dz == q.z_mm - p.z_mm;
  @*/
static sk_course sk_course_of(bool along_x, sk_point p, sk_point q)
{
  sk_course s;
  s.along_x = along_x;
  s.a0 = along_x ? p.x_mm : p.y_mm;
  s.b0 = along_x ? p.y_mm : p.x_mm;
  s.z0 = p.z_mm;
  s.da = along_x ? q.x_mm - p.x_mm : q.y_mm - p.y_mm;
  s.db = along_x ? q.y_mm - p.y_mm : q.x_mm - p.x_mm;
  s.dz = q.z_mm - p.z_mm;
  return s;
}

/* What a course covers, its segment covers. */
/*@ requires \valid(m) && now_us >= 0 && generation_us > 0 && sk_point_fits(p) && sk_point_fits(q);
  @ requires sk_along(along_x, p) < sk_along(along_x, q);
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures 0 <= \result;
  @ ensures covers: sk_covers(m, p, q, now_us);
  @ ensures only: sk_only_raises{Pre, Post}(m, p, q, now_us);
  @*/
static int32_t sk_raise_along(sk_height_map *m, bool along_x, sk_point p, sk_point q, int64_t now_us, int32_t generation_us)
{
  sk_course s = sk_course_of(along_x, p, q);
  int32_t count = sk_raise_course(m, s, now_us, generation_us);
  /*@ assert within: \forall real t; 0 <= t <= 1 ==> 0 <= sk_times(t, s.da) <= s.da; */
  /*@ assert on: \forall real t; sk_on_line(s.db, s.da, sk_times(t, s.da), sk_times(t, s.db)) &&
    @   sk_on_line(s.dz, s.da, sk_times(t, s.da), sk_times(t, s.dz)); */
  /*@ assert same_a: \forall real t; sk_at(sk_along(along_x, p), sk_along(along_x, q), t) == s.a0 + sk_times(t, s.da); */
  /*@ assert same_b: \forall real t; sk_at(sk_across(along_x, p), sk_across(along_x, q), t) == s.b0 + sk_times(t, s.db); */
  /*@ assert same_z: \forall real t; sk_at(p.z_mm, q.z_mm, t) == s.z0 + sk_times(t, s.dz); */
  /*@ assert over: \forall real t; \forall integer iy, ix; sk_crosses(p, q, t, iy, ix) ==>
    @   sk_course_over(s, sk_times(t, s.da), sk_times(t, s.db), sk_times(t, s.dz), sk_column_of(along_x, iy, ix), sk_row_of(along_x, iy, ix)); */
  return count;
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_point_fits(p);
  @*/
static bool sk_point_ok(sk_point p)
{
  bool x_ok = -SK_COORD_MAX_MM <= p.x_mm && p.x_mm <= SK_COORD_MAX_MM;
  bool y_ok = -SK_COORD_MAX_MM <= p.y_mm && p.y_mm <= SK_COORD_MAX_MM;
  bool z_ok = -SK_HEIGHT_MAX_MM <= p.z_mm && p.z_mm <= SK_HEIGHT_MAX_MM;
  return x_ok && y_ok && z_ok;
}

/*@ requires sk_coordinate_in_range(a) && sk_coordinate_in_range(b);
  @ assigns \nothing;
  @ ensures 0 <= \result && (\result == 0 <==> a == b);
  @*/
static int32_t sk_distance(int32_t a, int32_t b)
{
  return a > b ? a - b : b - a;
}

/* Along the longer axis, so that few columns have many rows, from the lower end. */
/*@ requires \valid(m) && now_us >= 0 && generation_us > 0 && sk_point_fits(p) && sk_point_fits(q);
  @ requires apart: p.x_mm != q.x_mm || p.y_mm != q.y_mm;
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures 0 <= \result;
  @ ensures covers: sk_covers(m, p, q, now_us);
  @ ensures only: sk_only_raises{Pre, Post}(m, p, q, now_us);
  @*/
static int32_t sk_raise_ordered(sk_height_map *m, sk_point p, sk_point q, int64_t now_us, int32_t generation_us)
{
  bool along_x = sk_distance(p.x_mm, q.x_mm) >= sk_distance(p.y_mm, q.y_mm);
  bool forward = along_x ? p.x_mm < q.x_mm : p.y_mm < q.y_mm;
  sk_point from, to;
  int32_t count;
  if (forward) {
    from = p;
    to = q;
  } else {
    from = q;
    to = p;
  }
  /*@ assert either: (from == p && to == q) || (from == q && to == p); */
  count = sk_raise_along(m, along_x, from, to, now_us, generation_us);
  /*@ assert covers: sk_covers(m, p, q, now_us); */
  /*@ assert only: sk_only_raises{Pre, Here}(m, p, q, now_us); */
  return count;
}

/*@ requires -1000 <= i <= 1000 && sk_coordinate_in_range(v_mm);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_inside(i, v_mm);
  @*/
static bool sk_is_inside(int32_t i, int32_t v_mm)
{
  int32_t beyond_mm = v_mm - (SK_CELL_MM * i + SK_MAP_ORIGIN_MM);
  return 0 < beyond_mm && beyond_mm < SK_CELL_MM;
}

/* Both ends inside one cell, which is nearly always so where returns lie close together. */
/*@ requires \valid(m) && now_us >= 0 && generation_us > 0 && sk_point_fits(p) && sk_point_fits(q);
  @ requires sk_inside(ix, p.x_mm) && sk_inside(ix, q.x_mm) && sk_inside(iy, p.y_mm) && sk_inside(iy, q.y_mm);
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures 0 <= \result;
  @ ensures covers: sk_covers(m, p, q, now_us);
  @ ensures only: sk_only_raises{Pre, Post}(m, p, q, now_us);
  @*/
static int32_t sk_raise_inside(sk_height_map *m, sk_point p, sk_point q, int32_t iy, int32_t ix, int64_t now_us, int32_t generation_us)
{
  int32_t z = (int32_t)sk_most_of(p.z_mm, q.z_mm);
  bool raised = sk_raise_at(m, iy, ix, z, now_us, generation_us);
  /*@ assert cell: sk_in_map(iy, ix) ==> m->height_mm[iy][ix] >= z && m->seen_us[iy][ix] == now_us; */
  /*@ assert over: \forall real t; \forall integer j, i; sk_crosses(p, q, t, j, i) ==> j == iy && i == ix && sk_at(p.z_mm, q.z_mm, t) <= z; */
  /*@ assert bounds: sk_in_bounds(p, q, iy, ix); */
  return raised ? 1 : 0;
}

int32_t sk_raster_segment(sk_height_map *m, const sk_point *p, const sk_point *q, int64_t now_us, int32_t generation_us)
{
  sk_point from = *p;
  sk_point to = *q;
  int32_t iy, ix;
  if (!sk_point_ok(from) || !sk_point_ok(to) || now_us < 0 || generation_us <= 0) { return -1; }
  iy = sk_cell_of(from.y_mm);
  ix = sk_cell_of(from.x_mm);
  if (sk_is_inside(ix, from.x_mm) && sk_is_inside(ix, to.x_mm) && sk_is_inside(iy, from.y_mm) && sk_is_inside(iy, to.y_mm)) {
    return sk_raise_inside(m, from, to, iy, ix, now_us, generation_us);
  }
  if (from.x_mm == to.x_mm && from.y_mm == to.y_mm) { return sk_raise_point(m, from, to, now_us, generation_us); }
  return sk_raise_ordered(m, from, to, now_us, generation_us);
}
