#include "columns.h"

/*@ requires \valid_read(m) && \valid_read(r) && sk_rules_fit(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures top: sk_has_top(m, r, iy, ix) ==> \result == sk_column_top(m, r, iy, ix);
  @ ensures none: !sk_has_top(m, r, iy, ix) ==> \result == SK_NO_TOP;
  @*/
static int32_t sk_column_at(const sk_height_map *m, const sk_clearance_rules *r, int32_t iy, int32_t ix)
{
  int64_t top_mm = sk_column_top_mm(m, r, iy, ix);
  if (!sk_is_passable(m, r, iy, ix) || top_mm > SK_NO_TOP) { return SK_NO_TOP; }
  return (int32_t)top_mm;
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_rules_fit(r) && \valid(c) && \separated(c, m, r) && 0 <= iy < SK_MAP_CELLS;
  @ assigns c->top_mm[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures right: \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> sk_column_right(c, m, r, iy, ix);
  @*/
static void sk_columns_row(const sk_height_map *m, const sk_clearance_rules *r, sk_columns *c, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant \forall integer i; 0 <= i < ix ==> sk_column_right(c, m, r, iy, i);
    @ loop assigns ix, c->top_mm[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) { c->top_mm[iy][ix] = sk_column_at(m, r, iy, ix); }
}

/* One row more, which changes nothing that those before rest on. */
/*@ requires \valid_read(m) && \valid_read(r) && sk_rules_fit(r) && \valid(c) && \separated(c, m, r) && 0 <= iy < SK_MAP_CELLS;
  @ requires \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> sk_column_right(c, m, r, j, i);
  @ assigns c->top_mm[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures \forall integer j, i; 0 <= j <= iy && 0 <= i < SK_MAP_CELLS ==> sk_column_right(c, m, r, j, i);
  @*/
static void sk_add_row(const sk_height_map *m, const sk_clearance_rules *r, sk_columns *c, int32_t iy)
{
  sk_columns_row(m, r, c, iy);
  /*@ assert tops: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> c->top_mm[j][i] == \at(c->top_mm[j][i], Pre); */
  /*@ assert heights: \forall integer j, i; sk_in_map(j, i) ==> m->height_mm[j][i] == \at(m->height_mm[j][i], Pre); */
  /*@ assert previous: \forall integer j, i; sk_in_map(j, i) ==> m->previous_mm[j][i] == \at(m->previous_mm[j][i], Pre); */
  /*@ assert rules: r->now_us == \at(r->now_us, Pre) && r->fresh_us == \at(r->fresh_us, Pre) && r->margin_mm == \at(r->margin_mm, Pre); */
  /*@ assert same: \forall integer j, i; sk_in_map(j, i) ==> (sk_has_top{Here}(m, r, j, i) <==> sk_has_top{Pre}(m, r, j, i)) &&
    @   sk_column_top{Here}(m, r, j, i) == sk_column_top{Pre}(m, r, j, i); */
  /*@ assert before: \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> sk_column_right(c, m, r, j, i); */
}

/* The first cell beyond a block along one axis. */
/*@ requires 0 <= block < SK_MAP_BLOCKS;
  @ assigns \nothing;
  @ ensures SK_BLOCK_CELLS * block < \result <= SK_MAP_CELLS;
  @ ensures \result == SK_BLOCK_CELLS * block + SK_BLOCK_CELLS || (\result == SK_MAP_CELLS && SK_MAP_CELLS < SK_BLOCK_CELLS * block + SK_BLOCK_CELLS);
  @*/
static int32_t sk_block_end(int32_t block)
{
  int32_t end = SK_BLOCK_CELLS * block + SK_BLOCK_CELLS;
  if (end > SK_MAP_CELLS) { return SK_MAP_CELLS; }
  return end;
}

/*@ requires \valid_read(c) && 0 <= iy < SK_MAP_CELLS && 0 <= from < to <= SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures \forall integer ix; from <= ix < to ==> c->top_mm[iy][ix] <= \result;
  @*/
static int32_t sk_row_most(const sk_columns *c, int32_t iy, int32_t from, int32_t to)
{
  int32_t most = c->top_mm[iy][from];
  int32_t ix;
  /*@ loop invariant from < ix <= to;
    @ loop invariant \forall integer i; from <= i < ix ==> c->top_mm[iy][i] <= most;
    @ loop assigns ix, most;
    @ loop variant to - ix;
    @*/
  for (ix = from + 1; ix < to; ix++) { most = c->top_mm[iy][ix] > most ? c->top_mm[iy][ix] : most; }
  return most;
}

/*@ requires \valid_read(c) && 0 <= by < SK_MAP_BLOCKS && 0 <= bx < SK_MAP_BLOCKS;
  @ assigns \nothing;
  @ ensures sk_block_bounds(c, by, bx, \result);
  @*/
static int32_t sk_block_most(const sk_columns *c, int32_t by, int32_t bx)
{
  int32_t x_from = SK_BLOCK_CELLS * bx;
  int32_t x_to = sk_block_end(bx);
  int32_t y_from = SK_BLOCK_CELLS * by;
  int32_t y_to = sk_block_end(by);
  int32_t most = sk_row_most(c, y_from, x_from, x_to);
  int32_t iy;
  /*@ loop invariant y_from < iy <= y_to;
    @ loop invariant \forall integer j, i; y_from <= j < iy && x_from <= i < x_to ==> c->top_mm[j][i] <= most;
    @ loop assigns iy, most;
    @ loop variant y_to - iy;
    @*/
  for (iy = y_from + 1; iy < y_to; iy++) {
    int32_t row = sk_row_most(c, iy, x_from, x_to);
    most = row > most ? row : most;
  }
  return most;
}

/*@ requires \valid(c) && 0 <= by < SK_MAP_BLOCKS;
  @ assigns c->block_mm[by][0 .. SK_MAP_BLOCKS - 1];
  @ ensures \forall integer bx; 0 <= bx < SK_MAP_BLOCKS ==> sk_block_bounds(c, by, bx, c->block_mm[by][bx]);
  @*/
static void sk_blocks_row(sk_columns *c, int32_t by)
{
  int32_t bx;
  /*@ loop invariant 0 <= bx <= SK_MAP_BLOCKS;
    @ loop invariant \forall integer b; 0 <= b < bx ==> sk_block_bounds(c, by, b, c->block_mm[by][b]);
    @ loop assigns bx, c->block_mm[by][0 .. SK_MAP_BLOCKS - 1];
    @ loop variant SK_MAP_BLOCKS - bx;
    @*/
  for (bx = 0; bx < SK_MAP_BLOCKS; bx++) { c->block_mm[by][bx] = sk_block_most(c, by, bx); }
}

/*@ requires \valid(c);
  @ assigns c->block_mm[0 .. SK_MAP_BLOCKS - 1][0 .. SK_MAP_BLOCKS - 1];
  @ ensures sk_blocks_bound(c);
  @*/
static void sk_blocks_of(sk_columns *c)
{
  int32_t by;
  /*@ loop invariant 0 <= by <= SK_MAP_BLOCKS;
    @ loop invariant \forall integer j, i; 0 <= j < by && 0 <= i < SK_MAP_BLOCKS ==> sk_block_bounds(c, j, i, c->block_mm[j][i]);
    @ loop assigns by, c->block_mm[0 .. SK_MAP_BLOCKS - 1][0 .. SK_MAP_BLOCKS - 1];
    @ loop variant SK_MAP_BLOCKS - by;
    @*/
  for (by = 0; by < SK_MAP_BLOCKS; by++) { sk_blocks_row(c, by); }
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_rules_fit(r) && \valid(c) && \separated(c, m, r);
  @ assigns c->top_mm[..][..];
  @ ensures sk_columns_right(c, m, r);
  @*/
static void sk_tops_of(const sk_height_map *m, const sk_clearance_rules *r, sk_columns *c)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant sk_rules_fit(r);
    @ loop invariant \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> sk_column_right(c, m, r, j, i);
    @ loop assigns iy, c->top_mm[..][..];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_add_row(m, r, c, iy); }
}

/* The blocks change nothing that the tops rest on. */
/*@ requires \valid_read(m) && \valid_read(r) && \valid(c) && \separated(c, m, r) && sk_columns_right(c, m, r);
  @ assigns c->block_mm[0 .. SK_MAP_BLOCKS - 1][0 .. SK_MAP_BLOCKS - 1];
  @ ensures sk_columns_right(c, m, r) && sk_blocks_bound(c);
  @*/
static void sk_add_blocks(const sk_height_map *m, const sk_clearance_rules *r, sk_columns *c)
{
  (void)m;
  (void)r;
  sk_blocks_of(c);
  /*@ assert tops: \forall integer iy, ix; sk_in_map(iy, ix) ==> c->top_mm[iy][ix] == \at(c->top_mm[iy][ix], Pre); */
  /*@ assert heights: \forall integer iy, ix; sk_in_map(iy, ix) ==> m->height_mm[iy][ix] == \at(m->height_mm[iy][ix], Pre); */
  /*@ assert previous: \forall integer iy, ix; sk_in_map(iy, ix) ==> m->previous_mm[iy][ix] == \at(m->previous_mm[iy][ix], Pre); */
  /*@ assert seen: \forall integer iy, ix; sk_in_map(iy, ix) ==> m->seen_us[iy][ix] == \at(m->seen_us[iy][ix], Pre); */
  /*@ assert rules: r->now_us == \at(r->now_us, Pre) && r->fresh_us == \at(r->fresh_us, Pre) && r->margin_mm == \at(r->margin_mm, Pre); */
  /*@ assert pass: \forall integer iy, ix; sk_in_map(iy, ix) ==> r->pass_mm[iy][ix] == \at(r->pass_mm[iy][ix], Pre); */
  /*@ assert same: \forall integer iy, ix; sk_in_map(iy, ix) ==> (sk_has_top{Here}(m, r, iy, ix) <==> sk_has_top{Pre}(m, r, iy, ix)) &&
    @   sk_column_top{Here}(m, r, iy, ix) == sk_column_top{Pre}(m, r, iy, ix); */
}

bool sk_columns_of(const sk_height_map *m, const sk_clearance_rules *rules, sk_columns *out)
{
  if (!sk_rules_ok(rules)) { return false; }
  sk_tops_of(m, rules, out);
  sk_add_blocks(m, rules, out);
  return true;
}
