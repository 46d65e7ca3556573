/* The height map: for each cell an upper bound of every point inserted in the newest two sweeps of that cell.
 * A sweep of a cell (a generation) begins with the first insertion after generation_us have passed since the last one began. */
#ifndef SK_HEIGHT_MAP_H
#define SK_HEIGHT_MAP_H
#include "sk_common.h"
SK_BEGIN

typedef struct sk_height_map {
  int32_t height_mm[SK_MAP_CELLS][SK_MAP_CELLS];    /* [iy][ix], this generation */
  int32_t previous_mm[SK_MAP_CELLS][SK_MAP_CELLS];  /* the generation before; equal to height_mm in a cell's first */
  int64_t began_us[SK_MAP_CELLS][SK_MAP_CELLS];     /* start of this generation */
  int64_t seen_us[SK_MAP_CELLS][SK_MAP_CELLS];      /* newest insertion; -1 never observed */
} sk_height_map;

/* Every cell unobserved. */
void sk_map_clear(sk_height_map *m);

/* Cell index of a coordinate: floor((v - SK_MAP_ORIGIN_MM) / SK_CELL_MM). May lie outside 0..SK_MAP_CELLS-1. v within +-SK_COORD_MAX_MM. */
int32_t sk_map_index(int32_t v_mm);

/* Raises cell (iy, ix) to at least z (clamped to +-SK_HEIGHT_MAX_MM; rotates the generation when due) and stamps it. Outside the map: nothing.
 * Returns whether the cell is in the map. now_us >= 0, generation_us > 0. */
bool sk_map_insert(sk_height_map *m, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us, int32_t generation_us);

/* The effective height: the larger of the two generations. */
int32_t sk_map_top(const sk_height_map *m, int32_t iy, int32_t ix);

SK_END
#endif
