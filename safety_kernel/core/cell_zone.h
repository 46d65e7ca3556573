/* Whether a cell lies wholly in a rectangle or a dig zone: what permits something there. For the files of the core only. */
#ifndef SK_CELL_ZONE_H
#define SK_CELL_ZONE_H
#include "clearance_rules.h"
SK_BEGIN

/*@ requires sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_square_within(x_low_mm, y_low_mm, x_high_mm, y_high_mm, iy, ix);
  @*/
static inline bool sk_is_square_within(int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm, int32_t iy, int32_t ix)
{
  int32_t x = sk_cell_low_mm(ix);
  int32_t y = sk_cell_low_mm(iy);
  return x_low_mm <= x && x + SK_CELL_MM <= x_high_mm && y_low_mm <= y && y + SK_CELL_MM <= y_high_mm;
}

/*@ requires \valid_read(zone) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_cell_in_zone(zone, iy, ix);
  @*/
static inline bool sk_is_in_zone(const berm_dig_zone *zone, int32_t iy, int32_t ix)
{
  return sk_is_square_within(zone->x_low_mm, zone->y_low_mm, zone->x_high_mm, zone->y_high_mm, iy, ix);
}

SK_END
#endif
