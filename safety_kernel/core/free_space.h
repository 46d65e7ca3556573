/* Free space: which voxels rays have passed through, and in which of them something stands now. Beside a truck or a wall heights cannot tell a person
 * from the structure (leger-1998, section 3.3: found 1 m beside a truck); that he stands where rays have passed can. Three states are of the place:
 * UNKNOWN, FREE (a ray has passed), SOLID (a return came from it before any ray had passed, or while it was learned). The fourth is of now: FOREIGN, a
 * return came from free space, with free space all round: a surface that is seen for the first time may lie in a voxel that rays have grazed, but
 * behind it none ever passed. A ray that passes makes it free again. */
#ifndef SK_FREE_SPACE_H
#define SK_FREE_SPACE_H
#include "monitor_region.h"
SK_BEGIN

#define SK_VOXEL_MM (SK_CELL_MM / 2)
#define SK_VOXELS (2 * SK_MAP_CELLS)
#define SK_VOXEL_LEVELS 64
#define SK_VOXEL_FLOOR_MM (-5100) /* low side of the lowest level; higher and lower points are of no voxel */

/* Any two differ in four bits. What is none of them is like SOLID. */
enum { SK_VOXEL_UNKNOWN = 0x0F, SK_VOXEL_FREE = 0x33, SK_VOXEL_SOLID = 0x55, SK_VOXEL_FOREIGN = 0x69 };

typedef struct sk_free_space {
  uint8_t voxel[SK_VOXEL_LEVELS][SK_VOXELS][SK_VOXELS]; /* [level][jy][jx] */
  uint16_t foreign[SK_MAP_CELLS][SK_MAP_CELLS];         /* [iy][ix]: FOREIGN voxels of the cell's columns */
} sk_free_space;

typedef struct sk_voxel { int32_t level, jy, jx; } sk_voxel;

/*@ predicate sk_in_space(integer k, integer j, integer i) = 0 <= k < SK_VOXEL_LEVELS && 0 <= j < SK_VOXELS && 0 <= i < SK_VOXELS;
  @ predicate sk_voxel_in_space(sk_voxel v) = sk_in_space(v.level, v.jy, v.jx);
  @ predicate sk_unknown_at{L}(sk_free_space *s, integer k, integer j, integer i) = sk_in_space(k, j, i) && \at(s->voxel[k][j][i], L) == SK_VOXEL_UNKNOWN;
  @ predicate sk_leaves_free(integer flag) = flag == SK_VOXEL_UNKNOWN || flag == SK_VOXEL_FREE || flag == SK_VOXEL_FOREIGN;
  @ predicate sk_open_at{L}(sk_free_space *s, integer k, integer j, integer i) = sk_in_space(k, j, i) &&
  @   (\at(s->voxel[k][j][i], L) == SK_VOXEL_FREE || \at(s->voxel[k][j][i], L) == SK_VOXEL_FOREIGN);
  @ predicate sk_open_in_row{L}(sk_free_space *s, integer k, integer j, integer i) =
  @   sk_open_at{L}(s, k, j, i - 1) && sk_open_at{L}(s, k, j, i) && sk_open_at{L}(s, k, j, i + 1);
  @ predicate sk_open_in_layer{L}(sk_free_space *s, integer k, integer j, integer i) =
  @   sk_open_in_row{L}(s, k, j - 1, i) && sk_open_in_row{L}(s, k, j, i) && sk_open_in_row{L}(s, k, j + 1, i);
  @ // rays have passed through the voxel and all 26 that touch it
  @ predicate sk_open_around{L}(sk_free_space *s, integer k, integer j, integer i) =
  @   sk_open_in_layer{L}(s, k - 1, j, i) && sk_open_in_layer{L}(s, k, j, i) && sk_open_in_layer{L}(s, k + 1, j, i);
  @ predicate sk_space_kept{A, B}(sk_free_space *s) =
  @   (\forall integer k, j, i; sk_in_space(k, j, i) ==> \at(s->voxel[k][j][i], A) == \at(s->voxel[k][j][i], B)) &&
  @   (\forall integer iy, ix; sk_in_map(iy, ix) ==> \at(s->foreign[iy][ix], A) == \at(s->foreign[iy][ix], B));
  @ // all but voxel (k, j, i) and the count of its cell
  @ predicate sk_space_others_kept{A, B}(sk_free_space *s, integer k, integer j, integer i) =
  @   (\forall integer l, n, m; sk_in_space(l, n, m) && !(l == k && n == j && m == i) ==> \at(s->voxel[l][n][m], A) == \at(s->voxel[l][n][m], B)) &&
  @   (\forall integer iy, ix; sk_in_map(iy, ix) && !(iy == j / 2 && ix == i / 2) ==> \at(s->foreign[iy][ix], A) == \at(s->foreign[iy][ix], B));
  @ predicate sk_returned(integer flag, integer learning, integer foreign, integer flag2) =
  @   (flag == SK_VOXEL_UNKNOWN ==> flag2 == SK_VOXEL_SOLID) && (learning != 0 && sk_leaves_free(flag) ==> flag2 == SK_VOXEL_SOLID) && (learning != 0 && !sk_leaves_free(flag) ==> flag2 == flag) &&
  @   (learning == 0 && flag == SK_VOXEL_FREE && foreign != 0 ==> flag2 == SK_VOXEL_FOREIGN) &&
  @   (learning == 0 && flag == SK_VOXEL_FREE && foreign == 0 ==> flag2 == SK_VOXEL_FREE) &&
  @   (learning == 0 && flag != SK_VOXEL_UNKNOWN && flag != SK_VOXEL_FREE ==> flag2 == flag);
  @ predicate sk_passed(integer flag, integer flag2) = (sk_leaves_free(flag) ==> flag2 == SK_VOXEL_FREE) && (!sk_leaves_free(flag) ==> flag2 == flag);
  @ logic integer sk_one_more(integer n) = n < 65535 ? n + 1 : n;
  @ logic integer sk_one_less(integer n) = n > 0 ? n - 1 : n;
  @ predicate sk_foreign_in_region{L}(sk_free_space *s, sk_monitor_rules *r, integer least, integer iy, integer ix) =
  @   \at(s->foreign[iy][ix], L) >= least && \at(r->watched[iy][ix], L) != 0;
  @*/

/* The voxel of a point, base frame; its level, row or column may lie outside. */
/*@ assigns \nothing;
  @ ensures x: SK_VOXEL_MM * \result.jx + SK_MAP_ORIGIN_MM <= x_mm < SK_VOXEL_MM * (\result.jx + 1) + SK_MAP_ORIGIN_MM;
  @ ensures y: SK_VOXEL_MM * \result.jy + SK_MAP_ORIGIN_MM <= y_mm < SK_VOXEL_MM * (\result.jy + 1) + SK_MAP_ORIGIN_MM;
  @ ensures z: SK_VOXEL_MM * \result.level + SK_VOXEL_FLOOR_MM <= z_mm < SK_VOXEL_MM * (\result.level + 1) + SK_VOXEL_FLOOR_MM;
  @*/
sk_voxel sk_voxel_of(int32_t x_mm, int32_t y_mm, int32_t z_mm);

/* Every voxel UNKNOWN, none FOREIGN. */
/*@ requires \valid(s);
  @ assigns s->voxel[..][..][..], s->foreign[..][..];
  @ ensures unknown: \forall integer k, j, i; sk_in_space(k, j, i) ==> sk_unknown_at(s, k, j, i);
  @ ensures nobody: \forall integer iy, ix; sk_in_map(iy, ix) ==> s->foreign[iy][ix] == 0;
  @*/
void sk_space_begin(sk_free_space *s);

/* A return from the voxel. learning: what is there now belongs there. Returns whether it made the voxel FOREIGN. */
/*@ requires \valid(s);
  @ assigns s->voxel[..][..][..], s->foreign[..][..];
  @ ensures outside: !sk_voxel_in_space(v) ==> \result == false && sk_space_kept{Pre, Post}(s);
  @ ensures foreign: sk_voxel_in_space(v) && \old(s->voxel[v.level][v.jy][v.jx]) == SK_VOXEL_FREE && learning == 0 &&
  @   sk_open_around{Pre}(s, v.level, v.jy, v.jx) ==> \result == true;
  @ ensures only: \result == true ==> sk_voxel_in_space(v) && \old(s->voxel[v.level][v.jy][v.jx]) == SK_VOXEL_FREE && learning == 0 &&
  @   sk_open_around{Pre}(s, v.level, v.jy, v.jx);
  @ ensures becomes: sk_voxel_in_space(v) ==> sk_returned(\old(s->voxel[v.level][v.jy][v.jx]), learning, \result, s->voxel[v.level][v.jy][v.jx]);
  @ ensures counted: \result == true ==> s->foreign[v.jy / 2][v.jx / 2] == sk_one_more(\old(s->foreign[v.jy / 2][v.jx / 2]));
  @ ensures learned: sk_voxel_in_space(v) && \old(s->voxel[v.level][v.jy][v.jx]) == SK_VOXEL_FOREIGN && learning != 0 ==>
  @   s->foreign[v.jy / 2][v.jx / 2] == sk_one_less(\old(s->foreign[v.jy / 2][v.jx / 2]));
  @ ensures uncounted: sk_voxel_in_space(v) && \result == false && !(\old(s->voxel[v.level][v.jy][v.jx]) == SK_VOXEL_FOREIGN && learning != 0) ==>
  @   s->foreign[v.jy / 2][v.jx / 2] == \old(s->foreign[v.jy / 2][v.jx / 2]);
  @ ensures others: sk_voxel_in_space(v) ==> sk_space_others_kept{Pre, Post}(s, v.level, v.jy, v.jx);
  @*/
bool sk_space_return(sk_free_space *s, sk_voxel v, bool learning);

/* A ray has passed through the voxel: UNKNOWN and FOREIGN become FREE. */
/*@ requires \valid(s);
  @ assigns s->voxel[..][..][..], s->foreign[..][..];
  @ ensures outside: !sk_voxel_in_space(v) ==> sk_space_kept{Pre, Post}(s);
  @ ensures becomes: sk_voxel_in_space(v) ==> sk_passed(\old(s->voxel[v.level][v.jy][v.jx]), s->voxel[v.level][v.jy][v.jx]);
  @ ensures left: sk_voxel_in_space(v) && \old(s->voxel[v.level][v.jy][v.jx]) == SK_VOXEL_FOREIGN ==>
  @   s->foreign[v.jy / 2][v.jx / 2] == sk_one_less(\old(s->foreign[v.jy / 2][v.jx / 2]));
  @ ensures uncounted: sk_voxel_in_space(v) && \old(s->voxel[v.level][v.jy][v.jx]) != SK_VOXEL_FOREIGN ==>
  @   s->foreign[v.jy / 2][v.jx / 2] == \old(s->foreign[v.jy / 2][v.jx / 2]);
  @ ensures others: sk_voxel_in_space(v) ==> sk_space_others_kept{Pre, Post}(s, v.level, v.jy, v.jx);
  @*/
void sk_space_pass(sk_free_space *s, sk_voxel v);

/* Cell (iy, ix) of the map: its columns' voxels are UNKNOWN, none FOREIGN; nothing else changes. Outside the map nothing does. */
/*@ requires \valid(s);
  @ assigns s->voxel[..][..][..], s->foreign[..][..];
  @ ensures outside: !sk_in_map(iy, ix) ==> sk_space_kept{Pre, Post}(s);
  @ ensures unknown: \forall integer k, j, i; sk_in_map(iy, ix) && sk_in_space(k, j, i) && 2 * iy <= j <= 2 * iy + 1 && 2 * ix <= i <= 2 * ix + 1 ==>
  @   s->voxel[k][j][i] == SK_VOXEL_UNKNOWN;
  @ ensures nobody: sk_in_map(iy, ix) ==> s->foreign[iy][ix] == 0;
  @ ensures others: \forall integer k, j, i; sk_in_space(k, j, i) && !(2 * iy <= j <= 2 * iy + 1 && 2 * ix <= i <= 2 * ix + 1) ==>
  @   s->voxel[k][j][i] == \old(s->voxel[k][j][i]);
  @ ensures other_cells: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> s->foreign[j][i] == \old(s->foreign[j][i]);
  @*/
void sk_space_forget(sk_free_space *s, int32_t iy, int32_t ix);

/* Whether a cell of the region has `least` FOREIGN voxels or more; the first such into *where, or -1, -1. */
/*@ requires \valid_read(s) && \valid_read(r) && \valid(where) && \separated(where, s) && \separated(where, r);
  @ assigns *where;
  @ ensures found: \result == true <==> \exists integer iy, ix; sk_in_map(iy, ix) && sk_foreign_in_region{Pre}(s, r, least, iy, ix);
  @ ensures where: \result == true ==> sk_in_map(where->iy, where->ix) && sk_foreign_in_region{Pre}(s, r, least, where->iy, where->ix);
  @ ensures nowhere: \result == false ==> where->iy == -1 && where->ix == -1;
  @*/
bool sk_space_find(const sk_free_space *s, const sk_monitor_rules *r, int32_t least, sk_monitor_cell *where);

SK_END
#endif
