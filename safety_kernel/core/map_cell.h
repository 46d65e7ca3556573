/* The cell that holds a coordinate, and what an insertion does to it. For the files of the core only. */
#ifndef SK_MAP_CELL_H
#define SK_MAP_CELL_H
#include "height_map.h"
SK_BEGIN

/* The cell that holds a coordinate in range, or one just below; int32 suffices, and no border is on the far side of zero. */
/*@ requires -SK_COORD_MAX_MM - 1 <= v_mm <= SK_COORD_MAX_MM;
  @ assigns \nothing;
  @ ensures sk_cell_low(\result) <= v_mm < sk_cell_low(\result) + SK_CELL_MM;
  @ ensures -1000 <= \result <= 1000;
  @*/
static inline int32_t sk_cell_of(int32_t v_mm)
{
  uint32_t offset_mm = (uint32_t)(v_mm - SK_MAP_ORIGIN_MM + 1000 * SK_CELL_MM);
  return (int32_t)(offset_mm / SK_CELL_MM) - 1000;
}

/* Raises the cell to at least z, rotates the generation when due, and stamps it. */
/*@ requires \valid(m) && sk_in_map(iy, ix) && now_us >= 0 && generation_us > 0 && -SK_HEIGHT_MAX_MM <= z_mm <= SK_HEIGHT_MAX_MM;
  @ assigns m->height_mm[iy][ix], m->previous_mm[iy][ix], m->began_us[iy][ix], m->seen_us[iy][ix];
  @ ensures raised: sk_cell_raised{Pre, Post}(m, iy, ix, z_mm, now_us);
  @ ensures rotated: sk_generation_due{Pre}(m, iy, ix, now_us, generation_us) ==>
  @   m->previous_mm[iy][ix] == \old(m->height_mm[iy][ix]) && m->height_mm[iy][ix] == z_mm && m->began_us[iy][ix] == now_us;
  @ ensures same: \old(m->seen_us[iy][ix]) >= 0 && !sk_generation_due{Pre}(m, iy, ix, now_us, generation_us) ==>
  @   m->previous_mm[iy][ix] == \old(m->previous_mm[iy][ix]) && m->began_us[iy][ix] == \old(m->began_us[iy][ix]) &&
  @   (m->height_mm[iy][ix] == \old(m->height_mm[iy][ix]) || m->height_mm[iy][ix] == z_mm) &&
  @   m->height_mm[iy][ix] >= \old(m->height_mm[iy][ix]);
  @ ensures first: \old(m->seen_us[iy][ix]) < 0 ==>
  @   m->height_mm[iy][ix] == z_mm && m->previous_mm[iy][ix] == z_mm && m->began_us[iy][ix] == now_us;
  @*/
static inline void sk_raise_cell(sk_height_map *m, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us, int32_t generation_us)
{
  if (m->seen_us[iy][ix] < 0) {
    m->height_mm[iy][ix] = z_mm;
    m->previous_mm[iy][ix] = z_mm;
    m->began_us[iy][ix] = now_us;
  } else if (m->began_us[iy][ix] <= now_us - generation_us) {
    m->previous_mm[iy][ix] = m->height_mm[iy][ix];
    m->height_mm[iy][ix] = z_mm;
    m->began_us[iy][ix] = now_us;
  } else if (m->height_mm[iy][ix] < z_mm) {
    m->height_mm[iy][ix] = z_mm;
  }
  m->seen_us[iy][ix] = now_us;
}

SK_END
#endif
