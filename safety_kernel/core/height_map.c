#include "height_map.h"
#include "map_cell.h"

/*@ requires \valid(m) && 0 <= iy < SK_MAP_CELLS;
  @ assigns m->height_mm[iy][0 .. SK_MAP_CELLS - 1], m->previous_mm[iy][0 .. SK_MAP_CELLS - 1],
  @   m->began_us[iy][0 .. SK_MAP_CELLS - 1], m->seen_us[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> sk_cell_cleared(m, iy, ix);
  @*/
static void sk_clear_row(sk_height_map *m, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant \forall integer i; 0 <= i < ix ==> m->seen_us[iy][i] == -1;
    @ loop invariant \forall integer i; 0 <= i < ix ==> m->height_mm[iy][i] == SK_HEIGHT_MAX_MM;
    @ loop invariant \forall integer i; 0 <= i < ix ==> m->previous_mm[iy][i] == SK_HEIGHT_MAX_MM;
    @ loop assigns ix, m->height_mm[iy][0 .. SK_MAP_CELLS - 1], m->previous_mm[iy][0 .. SK_MAP_CELLS - 1],
    @   m->began_us[iy][0 .. SK_MAP_CELLS - 1], m->seen_us[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    m->height_mm[iy][ix] = SK_HEIGHT_MAX_MM;
    m->previous_mm[iy][ix] = SK_HEIGHT_MAX_MM;
    m->began_us[iy][ix] = 0;
    m->seen_us[iy][ix] = -1;
  }
}

void sk_map_clear(sk_height_map *m)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> sk_cell_cleared(m, j, i);
    @ loop assigns iy, m->height_mm[0 .. SK_MAP_CELLS - 1][0 .. SK_MAP_CELLS - 1], m->previous_mm[0 .. SK_MAP_CELLS - 1][0 .. SK_MAP_CELLS - 1],
    @   m->began_us[0 .. SK_MAP_CELLS - 1][0 .. SK_MAP_CELLS - 1], m->seen_us[0 .. SK_MAP_CELLS - 1][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_clear_row(m, iy); }
}

int32_t sk_map_index(int32_t v_mm)
{
  int64_t offset = (int64_t)v_mm - SK_MAP_ORIGIN_MM;
  int64_t q = offset / SK_CELL_MM; /* towards zero */
  if (offset % SK_CELL_MM < 0) { q = q - 1; }
  return (int32_t)q;
}

/*@ assigns \nothing;
  @ ensures \result == sk_clamped(z_mm);
  @*/
static int32_t sk_clamp_height(int32_t z_mm)
{
  if (z_mm > SK_HEIGHT_MAX_MM) { return SK_HEIGHT_MAX_MM; }
  if (z_mm < -SK_HEIGHT_MAX_MM) { return -SK_HEIGHT_MAX_MM; }
  return z_mm;
}

bool sk_map_insert(sk_height_map *m, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us, int32_t generation_us)
{
  int32_t z = sk_clamp_height(z_mm);
  if (iy < 0 || iy >= SK_MAP_CELLS || ix < 0 || ix >= SK_MAP_CELLS) { return false; }
  if (now_us < 0 || generation_us <= 0) { return false; }
  sk_raise_cell(m, iy, ix, z, now_us, generation_us);
  return true;
}

bool sk_map_keep(sk_height_map *m, int32_t iy, int32_t ix)
{
  if (iy < 0 || iy >= SK_MAP_CELLS || ix < 0 || ix >= SK_MAP_CELLS) { return false; }
  if (m->seen_us[iy][ix] < 0) { return false; }
  if (m->height_mm[iy][ix] < m->previous_mm[iy][ix]) { m->height_mm[iy][ix] = m->previous_mm[iy][ix]; }
  return true;
}

int32_t sk_map_top(const sk_height_map *m, int32_t iy, int32_t ix)
{
  if (iy < 0 || iy >= SK_MAP_CELLS || ix < 0 || ix >= SK_MAP_CELLS) { return SK_HEIGHT_MAX_MM; }
  if (m->height_mm[iy][ix] >= m->previous_mm[iy][ix]) { return m->height_mm[iy][ix]; }
  return m->previous_mm[iy][ix];
}
