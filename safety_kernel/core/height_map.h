/* The height map: for each cell an upper bound of every point inserted in the newest two sweeps of that cell.
 * A sweep of a cell (a generation) begins with the first insertion after generation_us have passed since the last one began. */
#ifndef SK_HEIGHT_MAP_H
#define SK_HEIGHT_MAP_H
#include "sk_common.h"
SK_BEGIN

typedef struct sk_height_map {
  int32_t height_mm[SK_MAP_CELLS][SK_MAP_CELLS];    /* [iy][ix], this generation */
  int32_t previous_mm[SK_MAP_CELLS][SK_MAP_CELLS];  /* the generation before; in a cell's first, the height of its first insertion */
  int64_t began_us[SK_MAP_CELLS][SK_MAP_CELLS];     /* start of this generation */
  int64_t seen_us[SK_MAP_CELLS][SK_MAP_CELLS];      /* newest insertion; -1 never observed */
} sk_height_map;

/*@ predicate sk_in_map(integer iy, integer ix) = 0 <= iy < SK_MAP_CELLS && 0 <= ix < SK_MAP_CELLS;
  @ // low edge of a cell; the cell is the closed interval from its low edge to SK_CELL_MM above
  @ logic integer sk_cell_low(integer i) = SK_CELL_MM * i + SK_MAP_ORIGIN_MM;
  @ logic integer sk_clamped(integer z) =
  @   z > SK_HEIGHT_MAX_MM ? SK_HEIGHT_MAX_MM : (z < -SK_HEIGHT_MAX_MM ? -SK_HEIGHT_MAX_MM : z);
  @ logic integer sk_top{L}(sk_height_map *m, integer iy, integer ix) =
  @   \at(m->height_mm[iy][ix], L) >= \at(m->previous_mm[iy][ix], L) ? \at(m->height_mm[iy][ix], L) : \at(m->previous_mm[iy][ix], L);
  @ predicate sk_cell_kept{A, B}(sk_height_map *m, integer iy, integer ix) =
  @   \at(m->height_mm[iy][ix], A) == \at(m->height_mm[iy][ix], B) &&
  @   \at(m->previous_mm[iy][ix], A) == \at(m->previous_mm[iy][ix], B) &&
  @   \at(m->began_us[iy][ix], A) == \at(m->began_us[iy][ix], B) && \at(m->seen_us[iy][ix], A) == \at(m->seen_us[iy][ix], B);
  @ // every cell but one
  @ predicate sk_others_kept{A, B}(sk_height_map *m, integer iy, integer ix) =
  @   \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_cell_kept{A, B}(m, j, i);
  @ predicate sk_map_kept{A, B}(sk_height_map *m) = \forall integer j, i; sk_in_map(j, i) ==> sk_cell_kept{A, B}(m, j, i);
  @ // the cell was stamped and is now an upper bound of z and of the generation that was current
  @ predicate sk_cell_raised{A, B}(sk_height_map *m, integer iy, integer ix, integer z, integer now) =
  @   \at(m->height_mm[iy][ix], B) >= sk_clamped(z) && \at(m->seen_us[iy][ix], B) == now &&
  @   (\at(m->seen_us[iy][ix], A) >= 0 ==> sk_top{B}(m, iy, ix) >= \at(m->height_mm[iy][ix], A));
  @ predicate sk_cell_cleared{L}(sk_height_map *m, integer iy, integer ix) =
  @   \at(m->seen_us[iy][ix], L) == -1 && \at(m->height_mm[iy][ix], L) == SK_HEIGHT_MAX_MM && \at(m->previous_mm[iy][ix], L) == SK_HEIGHT_MAX_MM;
  @ predicate sk_generation_due{A}(sk_height_map *m, integer iy, integer ix, integer now, integer generation) =
  @   \at(m->seen_us[iy][ix], A) >= 0 && \at(m->began_us[iy][ix], A) <= now - generation;
  @*/

/* Every cell unobserved, its height as high as can be. */
/*@ requires \valid(m);
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures \forall integer iy, ix; sk_in_map(iy, ix) ==> sk_cell_cleared(m, iy, ix);
  @*/
void sk_map_clear(sk_height_map *m);

/* Cell index of a coordinate: floor((v - SK_MAP_ORIGIN_MM) / SK_CELL_MM). May lie outside 0..SK_MAP_CELLS-1. */
/*@ assigns \nothing;
  @ ensures floor: sk_cell_low(\result) <= v_mm < sk_cell_low(\result) + SK_CELL_MM;
  @*/
int32_t sk_map_index(int32_t v_mm);

/* Raises cell (iy, ix) to at least z (clamped to +-SK_HEIGHT_MAX_MM; rotates the generation when due) and stamps it. Returns whether it did:
 * outside the map, with now_us < 0 or generation_us <= 0 nothing changes and the result is false. */
/*@ requires \valid(m);
  @ assigns m->height_mm[..][..], m->previous_mm[..][..], m->began_us[..][..], m->seen_us[..][..];
  @ ensures accepts: \result == true <==> sk_in_map(iy, ix) && now_us >= 0 && generation_us > 0;
  @ ensures refused: \result == false ==> sk_map_kept{Pre, Post}(m);
  @ ensures others: sk_others_kept{Pre, Post}(m, iy, ix);
  @ ensures raised: \result == true ==> sk_cell_raised{Pre, Post}(m, iy, ix, z_mm, now_us);
  @ ensures rotated: \result == true && sk_generation_due{Pre}(m, iy, ix, now_us, generation_us) ==>
  @   m->previous_mm[iy][ix] == \old(m->height_mm[iy][ix]) && m->height_mm[iy][ix] == sk_clamped(z_mm) && m->began_us[iy][ix] == now_us;
  @ ensures same: \result == true && \old(m->seen_us[iy][ix]) >= 0 && !sk_generation_due{Pre}(m, iy, ix, now_us, generation_us) ==>
  @   m->previous_mm[iy][ix] == \old(m->previous_mm[iy][ix]) && m->began_us[iy][ix] == \old(m->began_us[iy][ix]) &&
  @   (m->height_mm[iy][ix] == \old(m->height_mm[iy][ix]) || m->height_mm[iy][ix] == sk_clamped(z_mm)) &&
  @   m->height_mm[iy][ix] >= \old(m->height_mm[iy][ix]);
  @ ensures first: \result == true && \old(m->seen_us[iy][ix]) < 0 ==>
  @   m->height_mm[iy][ix] == sk_clamped(z_mm) && m->previous_mm[iy][ix] == sk_clamped(z_mm) && m->began_us[iy][ix] == now_us;
  @*/
bool sk_map_insert(sk_height_map *m, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us, int32_t generation_us);

/* Carries the cell's effective height into this generation, so that the next rotation does not forget it; the effective height stays, and so does
 * when the cell was seen. For what the machine itself hides. False, and nothing changes, for a cell outside the map or never observed. */
/*@ requires \valid(m);
  @ assigns m->height_mm[..][..];
  @ ensures accepts: \result == true <==> sk_in_map(iy, ix) && \old(m->seen_us[iy][ix]) >= 0;
  @ ensures refused: \result == false ==> sk_map_kept{Pre, Post}(m);
  @ ensures others: sk_others_kept{Pre, Post}(m, iy, ix);
  @ ensures top: \result == true ==> sk_top{Post}(m, iy, ix) == sk_top{Pre}(m, iy, ix);
  @ ensures carried: \result == true ==> m->height_mm[iy][ix] == sk_top{Pre}(m, iy, ix);
  @*/
bool sk_map_keep(sk_height_map *m, int32_t iy, int32_t ix);

/* The effective height: the larger of the two generations. Outside the map: SK_HEIGHT_MAX_MM. */
/*@ requires \valid_read(m);
  @ assigns \nothing;
  @ ensures inside: sk_in_map(iy, ix) ==> \result == sk_top(m, iy, ix);
  @ ensures outside: !sk_in_map(iy, ix) ==> \result == SK_HEIGHT_MAX_MM;
  @*/
int32_t sk_map_top(const sk_height_map *m, int32_t iy, int32_t ix);

SK_END
#endif
