/* MergeCell (leger-1998, Figures 7 and 8): what becomes of a cell of the accumulated map, by what CheckCell said of the temporary one. Where this differs
 * from the figures, and why: requirements/workspace_monitor.md. */
#ifndef SK_MONITOR_MERGE_H
#define SK_MONITOR_MERGE_H
#include "monitor_rules.h"
SK_BEGIN

/* In annotations: what cell (iy, ix) of m becomes from A to B. Spelled out, so that the provers find the cell by its values. */
#define SK_CELL_AT(A, iy, ix, d, c) \at(m->temporary_flag[iy][ix], A), sk_new_height{A}(m, iy, ix), \at(m->accumulated_flag[iy][ix], A), \
  \at(m->height_mm[iy][ix], A), \at(m->obstacle_height_mm[iy][ix], A), d, c
#define SK_TEMPORARY_MERGED(A, B, iy, ix) sk_merged_temporary(\at(m->temporary_flag[iy][ix], A), \at(m->temporary_flag[iy][ix], B))
#define SK_FLAG_MERGED(A, B, iy, ix, d, c) sk_merged_flag(SK_CELL_AT(A, iy, ix, d, c), \at(m->accumulated_flag[iy][ix], B))
#define SK_HEIGHT_MERGED(A, B, iy, ix, d, c) sk_merged_height(SK_CELL_AT(A, iy, ix, d, c), \at(m->height_mm[iy][ix], B))
#define SK_OBSTACLE_MERGED(A, B, iy, ix) sk_merged_obstacle(\at(m->temporary_flag[iy][ix], A), sk_new_height{A}(m, iy, ix), \
  \at(m->accumulated_flag[iy][ix], A), \at(m->obstacle_height_mm[iy][ix], A), \at(m->obstacle_height_mm[iy][ix], B))
#define SK_CELL_MERGED(A, B, iy, ix, d, c) (SK_TEMPORARY_MERGED(A, B, iy, ix) && SK_FLAG_MERGED(A, B, iy, ix, d, c) && \
  SK_HEIGHT_MERGED(A, B, iy, ix, d, c) && SK_OBSTACLE_MERGED(A, B, iy, ix))
#define SK_CELL_KEPT(A, B, iy, ix) (\at(m->temporary_flag[iy][ix], A) == \at(m->temporary_flag[iy][ix], B) && \
  \at(m->accumulated_flag[iy][ix], A) == \at(m->accumulated_flag[iy][ix], B) && \at(m->height_mm[iy][ix], A) == \at(m->height_mm[iy][ix], B) && \
  \at(m->obstacle_height_mm[iy][ix], A) == \at(m->obstacle_height_mm[iy][ix], B))

/*@ // By value: t the cell's flag in the temporary map, z its height there; f, h, o its flag, height and obstacle height in the accumulated map before,
  @ // f2, h2, o2 after; d the height threshold; c not 0 in the continuous version.
  @ predicate sk_quiet(integer t) = t == SK_FLAG_NOT_VISITED || t == SK_FLAG_INTERPOLATED_NOT_VISITED;
  @ predicate sk_put_off(integer t) = t == SK_FLAG_EMPTY || t == SK_FLAG_SET || t == SK_FLAG_INTERPOLATED;
  @ // OBSTACLE, or a flag that is none
  @ predicate sk_reports(integer t) = !sk_put_off(t) && !sk_quiet(t) && t != SK_FLAG_CHANGED;
  @
  @ // an obstacle has left: the height condition of Figure 7, and nothing rises any more over what was there before; that of Figure 8
  @ predicate sk_left(integer z, integer h, integer o, integer d, integer c) =
  @   (c != 0 ==> z < o - d && z - h <= d) && (c == 0 ==> 2 * (z - h) < d);
  @ // of a CHANGED cell, whose height in the continuous version is what is there now
  @ predicate sk_sank(integer z, integer h, integer d, integer c) = (c != 0 ==> z < h - d) && (c == 0 ==> 2 * (z - h) < d);
  @ // a mark goes
  @ predicate sk_clears(integer t, integer z, integer f, integer h, integer o, integer d, integer c) = sk_quiet(t) &&
  @   ((sk_is_obstacle(f) && sk_left(z, h, o, d, c)) || (f == SK_FLAG_CHANGED && sk_sank(z, h, d, c)));
  @ // the cell's first height, or its first that is no interpolated one
  @ predicate sk_fills(integer t, integer f) = sk_quiet(t) &&
  @   (f == SK_FLAG_EMPTY || (f == SK_FLAG_INTERPOLATED && t == SK_FLAG_NOT_VISITED));
  @ // a measured height replaces, in the continuous version; an interpolated one, or what clears, only lowers
  @ predicate sk_follows(integer t, integer z, integer f, integer h, integer o, integer d, integer c) =
  @   (sk_is_obstacle(f) ==> sk_left(z, h, o, d, c)) &&
  @   ((c != 0 && t == SK_FLAG_NOT_VISITED) || ((c != 0 || sk_clears(t, z, f, h, o, d, c)) && z < h));
  @ predicate sk_takes(integer t, integer z, integer f, integer h, integer o, integer d, integer c) = sk_fills(t, f) ||
  @   (sk_quiet(t) && sk_follows(t, z, f, h, o, d, c)) || (t == SK_FLAG_CHANGED && !sk_is_obstacle(f) && c != 0);
  @ // an obstacle that was one already keeps its greatest height
  @ predicate sk_marks(integer t, integer z, integer f, integer o) = (t == SK_FLAG_CHANGED || sk_reports(t)) && !(sk_is_obstacle(f) && o > z);
  @
  @ predicate sk_merged_temporary(integer t, integer t2) =
  @   (t == SK_FLAG_SET ==> t2 == SK_FLAG_NOT_VISITED) && (t == SK_FLAG_INTERPOLATED ==> t2 == SK_FLAG_INTERPOLATED_NOT_VISITED) &&
  @   (t != SK_FLAG_SET && t != SK_FLAG_INTERPOLATED ==> t2 == SK_FLAG_EMPTY);
  @ predicate sk_merged_flag(integer t, integer z, integer f, integer h, integer o, integer d, integer c, integer f2) =
  @   (sk_reports(t) ==> f2 == SK_FLAG_OBSTACLE) && (t == SK_FLAG_CHANGED && !sk_is_obstacle(f) ==> f2 == SK_FLAG_CHANGED) &&
  @   (sk_clears(t, z, f, h, o, d, c) ==> f2 == SK_FLAG_SET) && (sk_fills(t, f) && t == SK_FLAG_NOT_VISITED ==> f2 == SK_FLAG_SET) &&
  @   (sk_fills(t, f) && t != SK_FLAG_NOT_VISITED ==> f2 == SK_FLAG_INTERPOLATED) &&
  @   (!sk_reports(t) && !(t == SK_FLAG_CHANGED && !sk_is_obstacle(f)) && !sk_clears(t, z, f, h, o, d, c) && !sk_fills(t, f) ==> f2 == f);
  @ predicate sk_merged_height(integer t, integer z, integer f, integer h, integer o, integer d, integer c, integer h2) =
  @   (sk_takes(t, z, f, h, o, d, c) ==> h2 == z) && (!sk_takes(t, z, f, h, o, d, c) ==> h2 == h);
  @ predicate sk_merged_obstacle(integer t, integer z, integer f, integer o, integer o2) =
  @   (sk_marks(t, z, f, o) ==> o2 == z) && (!sk_marks(t, z, f, o) ==> o2 == o);
  @ predicate sk_has_left{L}(sk_monitor *m, sk_monitor_rules *r, integer iy, integer ix) = sk_left(sk_new_height{L}(m, iy, ix),
  @   \at(m->height_mm[iy][ix], L), \at(m->obstacle_height_mm[iy][ix], L), \at(r->height_threshold_mm, L), \at(r->continuous, L));
  @*/

/* Merges one cell, whatever it, the temporary map and the rules hold. False, and nothing changed, outside the map. */
/*@ requires \valid(m) && \valid_read(r) && \separated(m, r);
  @ assigns m->temporary_flag[..][..], m->accumulated_flag[..][..], m->height_mm[..][..], m->obstacle_height_mm[..][..];
  @ ensures accepts: \result == true <==> sk_in_map(iy, ix);
  @ ensures refused: \result == false ==> \forall integer j, i; sk_in_map(j, i) ==> SK_CELL_KEPT(Pre, Post, j, i);
  @ ensures merged: \result == true ==> SK_CELL_MERGED(Pre, Post, iy, ix, \old(r->height_threshold_mm), \old(r->continuous));
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> SK_CELL_KEPT(Pre, Post, j, i);
  @ ensures stays: \result == true && sk_holds_obstacle{Pre}(m, iy, ix) ==> sk_holds_obstacle{Post}(m, iy, ix) || sk_has_left{Pre}(m, r, iy, ix);
  @ ensures marks: \result == true && \old(m->temporary_flag[iy][ix]) == SK_FLAG_OBSTACLE ==> m->accumulated_flag[iy][ix] == SK_FLAG_OBSTACLE;
  @*/
bool sk_merge_cell(sk_monitor *m, const sk_monitor_rules *r, int32_t iy, int32_t ix);

/* Merges every modified cell, puts off those in the middle of being scanned, and leaves only these in the list. */
/*@ requires \valid(m) && \valid_read(r) && \separated(m, r) && sk_monitor_valid(m);
  @ assigns m->temporary_flag[..][..], m->accumulated_flag[..][..], m->height_mm[..][..], m->obstacle_height_mm[..][..],
  @   m->modified_iy[..], m->modified_ix[..], m->place[..][..], m->modified, m->overflowed;
  @ ensures valid: sk_monitor_valid(m);
  @ ensures temporary: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_TEMPORARY_MERGED(Pre, Post, iy, ix);
  @ ensures flag: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_FLAG_MERGED(Pre, Post, iy, ix, \old(r->height_threshold_mm), \old(r->continuous));
  @ ensures height: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_HEIGHT_MERGED(Pre, Post, iy, ix, \old(r->height_threshold_mm), \old(r->continuous));
  @ ensures obstacle: \forall integer iy, ix; sk_in_map(iy, ix) ==> SK_OBSTACLE_MERGED(Pre, Post, iy, ix);
  @*/
void sk_merge_modified(sk_monitor *m, const sk_monitor_rules *r);

SK_END
#endif
