#include "columns.h"

/*@ predicate sk_level_cells{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, sk_rectangle cells, integer iy_low, integer iy_high,
  @   integer ix_low, integer ix_high) = \forall integer iy, ix; cells.iy_low <= iy <= cells.iy_high && cells.ix_low <= ix <= cells.ix_high &&
  @   iy_low <= iy < iy_high && ix_low <= ix < ix_high ==> sk_cell_level{L}(m, s, r, iy, ix);
  @ predicate sk_level_asked{L}(sk_height_map *m, sk_columns *c, sk_slice *s, sk_clearance_rules *r, sk_footprint f) =
  @   sk_counts_fit{L}(s) && sk_rules_fit{L}(r) && sk_range_in_map(f.cells) && sk_is_lowest{L}(s, 2, f.z_low_mm) &&
  @   f.z_low_mm <= SK_COORD_MAX_MM && sk_columns_right{L}(c, m, r) && (\at(s->link, L) <= 1 || \at(r->own_body_radius_mm, L) == 0);
  @*/

/* A cell that is not lower than the slice passes only as the own body's, under tail or boom. */
/*@ requires \valid_read(m) && \valid_read(c) && \valid_read(s) && \valid_read(r) && sk_level_asked(m, c, s, r, f) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true ==> sk_cell_level(m, s, r, iy, ix);
  @*/
static bool sk_cell_is_level(const sk_height_map *m, const sk_columns *c, const sk_slice *s, const sk_clearance_rules *r, sk_footprint f, int32_t iy,
                             int32_t ix)
{
  (void)m;
  /*@ assert sk_column_right(c, m, r, iy, ix); */
  /*@ assert nobody: r->own_body_radius_mm == 0 ==> !sk_own_body(r, iy, ix); */
  if (c->top_mm[iy][ix] < f.z_low_mm) { return true; }
  return s->link <= 1 && sk_is_own_body(r, iy, ix);
}

/* The cells of one row. */
/*@ requires \valid_read(m) && \valid_read(c) && \valid_read(s) && \valid_read(r) && sk_level_asked(m, c, s, r, f);
  @ requires 0 <= iy < SK_MAP_CELLS && 0 <= from <= to <= SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures \result == true ==> \forall integer ix; from <= ix < to ==> sk_cell_level(m, s, r, iy, ix);
  @*/
static bool sk_row_is_level(const sk_height_map *m, const sk_columns *c, const sk_slice *s, const sk_clearance_rules *r, sk_footprint f, int32_t iy,
                            int32_t from, int32_t to)
{
  int32_t ix;
  /*@ loop invariant from <= ix <= to;
    @ loop invariant \forall integer i; from <= i < ix ==> sk_cell_level(m, s, r, iy, i);
    @ loop assigns ix;
    @ loop variant to - ix;
    @*/
  for (ix = from; ix < to; ix++) {
    if (!sk_cell_is_level(m, c, s, r, f, iy, ix)) { return false; }
  }
  return true;
}

/*@ assigns \nothing;
  @ ensures \result == sk_least(a, b);
  @*/
static int32_t sk_lesser(int32_t a, int32_t b)
{
  return a <= b ? a : b;
}

/*@ assigns \nothing;
  @ ensures \result == sk_most(a, b);
  @*/
static int32_t sk_greater(int32_t a, int32_t b)
{
  return a >= b ? a : b;
}

/* The cells of one block that belong to the slice. */
/*@ requires \valid_read(m) && \valid_read(c) && \valid_read(s) && \valid_read(r) && sk_level_asked(m, c, s, r, f);
  @ requires 0 <= by < SK_MAP_BLOCKS && 0 <= bx < SK_MAP_BLOCKS;
  @ assigns \nothing;
  @ ensures \result == true ==> sk_level_cells(m, s, r, f.cells, SK_BLOCK_CELLS * by, SK_BLOCK_CELLS * by + SK_BLOCK_CELLS,
  @   SK_BLOCK_CELLS * bx, SK_BLOCK_CELLS * bx + SK_BLOCK_CELLS);
  @*/
static bool sk_cells_are_level(const sk_height_map *m, const sk_columns *c, const sk_slice *s, const sk_clearance_rules *r, sk_footprint f, int32_t by,
                               int32_t bx)
{
  int32_t x_from = sk_greater(f.cells.ix_low, SK_BLOCK_CELLS * bx);
  int32_t x_to = sk_lesser(f.cells.ix_high + 1, SK_BLOCK_CELLS * bx + SK_BLOCK_CELLS);
  int32_t y_from = sk_greater(f.cells.iy_low, SK_BLOCK_CELLS * by);
  int32_t y_to = sk_lesser(f.cells.iy_high + 1, SK_BLOCK_CELLS * by + SK_BLOCK_CELLS);
  int32_t iy;
  if (x_to < x_from) { return true; }
  /*@ loop invariant y_from <= iy && (iy <= y_to || iy == y_from);
    @ loop invariant \forall integer j, i; y_from <= j < iy && x_from <= i < x_to ==> sk_cell_level(m, s, r, j, i);
    @ loop assigns iy;
    @ loop variant y_to - iy;
    @*/
  for (iy = y_from; iy < y_to; iy++) {
    if (!sk_row_is_level(m, c, s, r, f, iy, x_from, x_to)) { return false; }
  }
  return true;
}

/* A block below the slice is settled; the cells of another are looked at one by one. */
/*@ requires \valid_read(m) && \valid_read(c) && \valid_read(s) && \valid_read(r) && sk_level_asked(m, c, s, r, f) && sk_blocks_bound(c);
  @ requires block: 0 <= by < SK_MAP_BLOCKS && 0 <= bx < SK_MAP_BLOCKS;
  @ assigns \nothing;
  @ ensures \result == true ==> sk_level_cells(m, s, r, f.cells, SK_BLOCK_CELLS * by, SK_BLOCK_CELLS * by + SK_BLOCK_CELLS,
  @   SK_BLOCK_CELLS * bx, SK_BLOCK_CELLS * bx + SK_BLOCK_CELLS);
  @*/
static bool sk_block_is_level(const sk_height_map *m, const sk_columns *c, const sk_slice *s, const sk_clearance_rules *r, sk_footprint f, int32_t by,
                              int32_t bx)
{
  if (c->block_mm[by][bx] < f.z_low_mm) {
    /*@ assert sk_block_bounds(c, by, bx, c->block_mm[by][bx]); */
    /*@ assert nobody: r->own_body_radius_mm == 0 ==> \forall integer iy, ix; sk_in_map(iy, ix) ==> !sk_own_body(r, iy, ix); */
    /*@ assert below: \forall integer iy, ix; sk_in_block(by, bx, iy, ix) ==> c->top_mm[iy][ix] < f.z_low_mm; */
    /*@ assert level: \forall integer iy, ix; sk_in_block(by, bx, iy, ix) ==> sk_cell_level(m, s, r, iy, ix); */
    return true;
  }
  return sk_cells_are_level(m, c, s, r, f, by, bx);
}

/*@ requires \valid_read(m) && \valid_read(c) && \valid_read(s) && \valid_read(r) && sk_level_asked(m, c, s, r, f) && sk_blocks_bound(c);
  @ requires 0 <= by < SK_MAP_BLOCKS;
  @ assigns \nothing;
  @ ensures \result == true ==> sk_level_cells(m, s, r, f.cells, SK_BLOCK_CELLS * by, SK_BLOCK_CELLS * by + SK_BLOCK_CELLS, 0, SK_MAP_CELLS);
  @*/
static bool sk_block_row_is_level(const sk_height_map *m, const sk_columns *c, const sk_slice *s, const sk_clearance_rules *r, sk_footprint f, int32_t by)
{
  int32_t first = f.cells.ix_low / SK_BLOCK_CELLS;
  int32_t last = f.cells.ix_high / SK_BLOCK_CELLS;
  int32_t bx;
  /*@ loop invariant first <= bx <= last + 1;
    @ loop invariant sk_level_cells(m, s, r, f.cells, SK_BLOCK_CELLS * by, SK_BLOCK_CELLS * by + SK_BLOCK_CELLS, 0, SK_BLOCK_CELLS * bx);
    @ loop assigns bx;
    @ loop variant last - bx;
    @*/
  for (bx = first; bx <= last; bx++) {
    if (!sk_block_is_level(m, c, s, r, f, by, bx)) { return false; }
  }
  return true;
}

bool sk_clear_level(const sk_height_map *m, const sk_columns *c, const sk_slice *s, const sk_clearance_rules *rules)
{
  sk_footprint f;
  int32_t first, last, by;
  f.z_low_mm = 0;
  if (!sk_rules_ok(rules) || !sk_slice_footprint(s, &f)) { return false; }
  if (s->link > 1 && rules->own_body_radius_mm != 0) { return false; } /* the own body's cells are to be looked for */
  first = f.cells.iy_low / SK_BLOCK_CELLS;
  last = f.cells.iy_high / SK_BLOCK_CELLS;
  /*@ loop invariant first <= by <= last + 1;
    @ loop invariant sk_level_cells(m, s, rules, f.cells, 0, SK_BLOCK_CELLS * by, 0, SK_MAP_CELLS);
    @ loop assigns by;
    @ loop variant last - by;
    @*/
  for (by = first; by <= last; by++) {
    if (!sk_block_row_is_level(m, c, s, rules, f, by)) { return false; }
  }
  return true;
}
