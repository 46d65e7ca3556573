/* The rules of the clearance check, and what they say of a cell by itself. For the files of the core only, but for the rules. */
#ifndef SK_CLEARANCE_RULES_H
#define SK_CLEARANCE_RULES_H
#include "height_map.h"
#include "least_most.h"
#include "config/parameter_block.h"
SK_BEGIN

typedef struct sk_clearance_rules {
  int64_t now_us;
  int32_t fresh_us;
  int32_t margin_mm;
  int32_t own_body_radius_mm;  /* cells wholly nearer the origin are the machine's own: nothing to check for tail and boom, blocked for stick and bucket */
  bool dig_allowed;            /* swing speed bound is under the dig limit (decided by the caller from the reach box) */
  int32_t dig_zones;
  berm_dig_zone dig_zone[BERM_DIG_ZONES];
  bool dig_stale;              /* the dig-zone rule takes stale cells as they were last seen: for creeping out of a pit that the bucket hides */
  int16_t pass_mm[SK_MAP_CELLS][SK_MAP_CELLS]; /* overpass rule: a cell that is higher (margin not counted) may be passed beside, never over; see overpass.h */
} sk_clearance_rules;

/*@ predicate sk_rules_fit{L}(sk_clearance_rules *r) =
  @   0 <= \at(r->now_us, L) && 0 <= \at(r->fresh_us, L) && 0 <= \at(r->margin_mm, L) <= SK_COORD_MAX_MM &&
  @   0 <= \at(r->own_body_radius_mm, L) <= SK_COORD_MAX_MM && 0 <= \at(r->dig_zones, L) <= BERM_DIG_ZONES;
  @
  @ predicate sk_current{L}(sk_height_map *m, sk_clearance_rules *r, integer iy, integer ix) =
  @   0 <= \at(m->seen_us[iy][ix], L) && \at(r->now_us, L) - \at(r->fresh_us, L) <= \at(m->seen_us[iy][ix], L) <= \at(r->now_us, L);
  @ // observed, fresh, and no higher than may be passed over; any other cell is a column without a top
  @ predicate sk_passable{L}(sk_height_map *m, sk_clearance_rules *r, integer iy, integer ix) =
  @   sk_current{L}(m, r, iy, ix) && sk_top{L}(m, iy, ix) <= \at(r->pass_mm[iy][ix], L);
  @ predicate sk_square_within(integer x_low, integer y_low, integer x_high, integer y_high, integer iy, integer ix) =
  @   x_low <= sk_cell_low(ix) && sk_cell_low(ix) + SK_CELL_MM <= x_high && y_low <= sk_cell_low(iy) && sk_cell_low(iy) + SK_CELL_MM <= y_high;
  @ predicate sk_cell_in_zone{L}(berm_dig_zone *zone, integer iy, integer ix) =
  @   sk_square_within(\at(zone->x_low_mm, L), \at(zone->y_low_mm, L), \at(zone->x_high_mm, L), \at(zone->y_high_mm, L), iy, ix);
  @ predicate sk_in_circle(integer x, integer y, integer radius) = x * x + y * y <= radius * radius;
  @ predicate sk_own_body{L}(sk_clearance_rules *r, integer iy, integer ix) =
  @   sk_in_circle(sk_cell_low(ix), sk_cell_low(iy), \at(r->own_body_radius_mm, L)) &&
  @   sk_in_circle(sk_cell_low(ix) + SK_CELL_MM, sk_cell_low(iy), \at(r->own_body_radius_mm, L)) &&
  @   sk_in_circle(sk_cell_low(ix), sk_cell_low(iy) + SK_CELL_MM, \at(r->own_body_radius_mm, L)) &&
  @   sk_in_circle(sk_cell_low(ix) + SK_CELL_MM, sk_cell_low(iy) + SK_CELL_MM, \at(r->own_body_radius_mm, L));
  @ lemma sk_square_positive: \forall integer x; x * x >= 0;
  @ lemma sk_square_grows: \forall integer x; x != 0 ==> x * x > 0;
  @ lemma sk_body_of_nothing: \forall integer x, y; sk_in_circle(x, y, 0) ==> x == 0;
  @ logic integer sk_column_top{L}(sk_height_map *m, sk_clearance_rules *r, integer iy, integer ix) =
  @   sk_top{L}(m, iy, ix) + \at(r->margin_mm, L);
  @*/

/*@ requires \valid_read(r);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rules_fit(r);
  @*/
static inline bool sk_rules_ok(const sk_clearance_rules *r)
{
  return r->now_us >= 0 && r->fresh_us >= 0 && r->margin_mm >= 0 && r->margin_mm <= SK_COORD_MAX_MM && r->own_body_radius_mm >= 0 &&
         r->own_body_radius_mm <= SK_COORD_MAX_MM && r->dig_zones >= 0 && r->dig_zones <= BERM_DIG_ZONES;
}

/*@ requires 0 <= i < SK_MAP_CELLS;
  @ assigns \nothing;
  @ ensures \result == sk_cell_low(i);
  @*/
static inline int32_t sk_cell_low_mm(int32_t i)
{
  return SK_CELL_MM * i + SK_MAP_ORIGIN_MM;
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_rules_fit(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_current(m, r, iy, ix);
  @*/
static inline bool sk_is_current(const sk_height_map *m, const sk_clearance_rules *r, int32_t iy, int32_t ix)
{
  int64_t seen_us = m->seen_us[iy][ix];
  return seen_us >= 0 && seen_us <= r->now_us && seen_us >= r->now_us - r->fresh_us;
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_rules_fit(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == sk_column_top(m, r, iy, ix);
  @ ensures -4294967296 <= \result <= 4294967296;
  @*/
static inline int64_t sk_column_top_mm(const sk_height_map *m, const sk_clearance_rules *r, int32_t iy, int32_t ix)
{
  int32_t height_mm = m->height_mm[iy][ix];
  int32_t previous_mm = m->previous_mm[iy][ix];
  return (int64_t)(height_mm >= previous_mm ? height_mm : previous_mm) + r->margin_mm;
}

/*@ requires \valid_read(m) && \valid_read(r) && sk_rules_fit(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_passable(m, r, iy, ix);
  @*/
static inline bool sk_is_passable(const sk_height_map *m, const sk_clearance_rules *r, int32_t iy, int32_t ix)
{
  int32_t pass_mm = r->pass_mm[iy][ix];
  return sk_is_current(m, r, iy, ix) && m->height_mm[iy][ix] <= pass_mm && m->previous_mm[iy][ix] <= pass_mm;
}

/*@ requires -SK_COORD_MAX_MM <= low_mm <= SK_COORD_MAX_MM;
  @ assigns \nothing;
  @ ensures \result == sk_most(low_mm * low_mm, (low_mm + SK_CELL_MM) * (low_mm + SK_CELL_MM));
  @*/
static inline int64_t sk_far_square(int64_t low_mm)
{
  int64_t high_mm = low_mm + SK_CELL_MM;
  return sk_most_of(low_mm * low_mm, high_mm * high_mm);
}

/* Whether all four corners are within the own body's radius. */
/*@ requires \valid_read(r) && sk_rules_fit(r) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_own_body(r, iy, ix);
  @*/
static inline bool sk_is_own_body(const sk_clearance_rules *r, int32_t iy, int32_t ix)
{
  int64_t radius = r->own_body_radius_mm;
  if (radius == 0) { return false; }
  return sk_far_square(sk_cell_low_mm(ix)) + sk_far_square(sk_cell_low_mm(iy)) <= radius * radius;
}

SK_END
#endif
