/* The map as the clearance check wants it at one time: of each cell the top of its column, and of each block of cells a bound of them. Made once a
 * cycle; a slice above a block's bound is settled for all its cells at one comparison. */
#ifndef SK_COLUMNS_H
#define SK_COLUMNS_H
#include "clearance.h"
SK_BEGIN

#define SK_BLOCK_CELLS 4 /* along one side */
#define SK_MAP_BLOCKS ((SK_MAP_CELLS + SK_BLOCK_CELLS - 1) / SK_BLOCK_CELLS)
#define SK_NO_TOP 2147483647 /* of a cell never observed, stale, or too high to be passed over: above every slice */

typedef struct sk_columns {
  int32_t top_mm[SK_MAP_CELLS][SK_MAP_CELLS];     /* effective height plus margin of a current cell that may be passed over; of any other SK_NO_TOP */
  int32_t block_mm[SK_MAP_BLOCKS][SK_MAP_BLOCKS]; /* no less than the top of any of its cells */
} sk_columns;

/*@ predicate sk_has_top{L}(sk_height_map *m, sk_clearance_rules *r, integer iy, integer ix) =
  @   sk_passable{L}(m, r, iy, ix) && sk_column_top{L}(m, r, iy, ix) < SK_NO_TOP;
  @ predicate sk_column_right{L}(sk_columns *c, sk_height_map *m, sk_clearance_rules *r, integer iy, integer ix) =
  @   (sk_has_top{L}(m, r, iy, ix) ==> \at(c->top_mm[iy][ix], L) == sk_column_top{L}(m, r, iy, ix)) &&
  @   (!sk_has_top{L}(m, r, iy, ix) ==> \at(c->top_mm[iy][ix], L) == SK_NO_TOP);
  @ predicate sk_columns_right{L}(sk_columns *c, sk_height_map *m, sk_clearance_rules *r) =
  @   \forall integer iy, ix; sk_in_map(iy, ix) ==> sk_column_right{L}(c, m, r, iy, ix);
  @ predicate sk_in_block(integer by, integer bx, integer iy, integer ix) = sk_in_map(iy, ix) &&
  @   SK_BLOCK_CELLS * by <= iy < SK_BLOCK_CELLS * by + SK_BLOCK_CELLS && SK_BLOCK_CELLS * bx <= ix < SK_BLOCK_CELLS * bx + SK_BLOCK_CELLS;
  @ predicate sk_block_bounds{L}(sk_columns *c, integer by, integer bx, integer v) =
  @   \forall integer iy, ix; sk_in_block(by, bx, iy, ix) ==> \at(c->top_mm[iy][ix], L) <= v;
  @ predicate sk_blocks_bound{L}(sk_columns *c) = \forall integer by, bx; 0 <= by < SK_MAP_BLOCKS && 0 <= bx < SK_MAP_BLOCKS ==>
  @   sk_block_bounds{L}(c, by, bx, \at(c->block_mm[by][bx], L));
  @ // lower than the whole slice: the level plane just below its lowest vertex separates it
  @ predicate sk_level{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, integer iy, integer ix) = sk_passable{L}(m, r, iy, ix) &&
  @   \forall integer i; 0 <= i < \at(s->vertices, L) ==> \at(s->xyz_mm[2][i], L) > sk_column_top{L}(m, r, iy, ix);
  @ // what a cell under a level slice must be: the own body's under tail or boom, or one that may be passed over, and lower than every vertex
  @ predicate sk_cell_level{L}(sk_height_map *m, sk_slice *s, sk_clearance_rules *r, integer iy, integer ix) =
  @   (sk_own_body{L}(r, iy, ix) ==> \at(s->link, L) <= 1) &&
  @   (!sk_own_body{L}(r, iy, ix) ==> sk_level{L}(m, s, r, iy, ix));
  @*/

/* The columns at rules->now_us. False, and *out unchanged, when the rules are malformed. */
/*@ requires \valid_read(m) && \valid_read(rules) && \valid(out) && \separated(out, m, rules);
  @ assigns out->top_mm[..][..], out->block_mm[..][..];
  @ ensures accepts: \result == true <==> sk_rules_fit{Pre}(rules);
  @ ensures columns: \result == true ==> sk_columns_right(out, m, rules);
  @ ensures blocks: \result == true ==> sk_blocks_bound(out);
  @*/
bool sk_columns_of(const sk_height_map *m, const sk_clearance_rules *rules, sk_columns *out);

/* Whether the slice is clear by its own height alone: every cell under it is in the map and is the own body's under tail or boom, or may be passed over and is, with the
 * margin, lower than every vertex. So a level plane separates the slice from all of them: with plane (0, 0, 1, lowest z - 1) chosen everywhere sk_clear_slice would say CLEAR. False says only that this
 * is not so simple. The columns must be those of this map and these rules. */
/*@ requires \valid_read(m) && \valid_read(c) && \valid_read(s) && \valid_read(rules);
  @ requires sk_columns_right(c, m, rules) && sk_blocks_bound(c);
  @ assigns \nothing;
  @ ensures fits: \result == true ==> sk_counts_fit(s) && sk_vertices_fit(s) && sk_rules_fit(rules);
  @ ensures clear: \result == true ==> \forall integer iy, ix; sk_under_slice(s, iy, ix) ==> sk_in_map(iy, ix) && sk_cell_level(m, s, rules, iy, ix);
  @*/
bool sk_clear_level(const sk_height_map *m, const sk_columns *c, const sk_slice *s, const sk_clearance_rules *rules);

SK_END
#endif
