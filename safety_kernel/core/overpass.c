#include "overpass.h"
#include "cell_zone.h"

/*@ requires \valid_read(z) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_meets_ground_zone(z, iy, ix);
  @*/
static bool sk_meets_ground(const berm_ground_zone *z, int32_t iy, int32_t ix)
{
  int32_t x = sk_cell_low_mm(ix);
  int32_t y = sk_cell_low_mm(iy);
  return z->x_low_mm <= x + SK_CELL_MM && x <= z->x_high_mm && z->y_low_mm <= y + SK_CELL_MM && y <= z->y_high_mm;
}

/*@ requires \valid_read(z) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_in_truck_zone(z, iy, ix);
  @*/
static bool sk_within_truck(const berm_truck_zone *z, int32_t iy, int32_t ix)
{
  return sk_is_square_within(z->x_low_mm, z->y_low_mm, z->x_high_mm, z->y_high_mm, iy, ix);
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_dig_ceilings_fit(p);
  @*/
static bool sk_dig_ceilings_ok(const berm_parameters *p)
{
  int32_t i;
  if (p->dig_zones < 0 || p->dig_zones > BERM_DIG_ZONES) { return false; }
  /*@ loop invariant 0 <= i <= p->dig_zones;
    @ loop invariant \forall integer k; 0 <= k < i ==> sk_height_ok(p->dig_zone[k].ceiling_mm);
    @ loop assigns i;
    @ loop variant p->dig_zones - i;
    @*/
  for (i = 0; i < p->dig_zones; i++) {
    if (p->dig_zone[i].ceiling_mm < -SK_HEIGHT_MAX_MM || p->dig_zone[i].ceiling_mm > SK_HEIGHT_MAX_MM) { return false; }
  }
  return true;
}

/* The lowest limit of the site and of the lower grounds that the cell meets. */
/*@ requires \valid_read(p) && sk_overpass_ok(p) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures height: sk_height_ok(\result);
  @ ensures passes: sk_ground_passes(p, iy, ix, p->ground_zones, \result);
  @ ensures reached: \result == p->pass_over_mm ||
  @   \exists integer k; 0 <= k < p->ground_zones && sk_meets_ground_zone(&p->ground_zone[k], iy, ix) && \result == p->ground_zone[k].pass_over_mm;
  @*/
static int32_t sk_ground_limit(const berm_parameters *p, int32_t iy, int32_t ix)
{
  int32_t limit_mm = p->pass_over_mm;
  int32_t i;
  /*@ loop invariant 0 <= i <= p->ground_zones;
    @ loop invariant sk_height_ok(limit_mm);
    @ loop invariant sk_ground_passes(p, iy, ix, i, limit_mm);
    @ loop invariant limit_mm == p->pass_over_mm ||
    @   \exists integer k; 0 <= k < i && sk_meets_ground_zone(&p->ground_zone[k], iy, ix) && limit_mm == p->ground_zone[k].pass_over_mm;
    @ loop assigns i, limit_mm;
    @ loop variant p->ground_zones - i;
    @*/
  for (i = 0; i < p->ground_zones; i++) {
    if (sk_meets_ground(&p->ground_zone[i], iy, ix) && p->ground_zone[i].pass_over_mm < limit_mm) { limit_mm = p->ground_zone[i].pass_over_mm; }
  }
  return limit_mm;
}

/* A limit raised to the ceilings of the truck zones that hold the cell. */
/*@ requires \valid_read(p) && sk_overpass_ok(p) && sk_in_map(iy, ix) && sk_height_ok(from_mm);
  @ assigns \nothing;
  @ ensures height: sk_height_ok(\result);
  @ ensures no_lower: from_mm <= \result;
  @ ensures every: \forall integer k; 0 <= k < p->truck_zones && sk_in_truck_zone(&p->truck_zone[k], iy, ix) ==> p->truck_zone[k].ceiling_mm <= \result;
  @ ensures reached: \result == from_mm || sk_truck_passes(p, iy, ix, p->truck_zones, \result);
  @*/
static int32_t sk_raised_by_trucks(const berm_parameters *p, int32_t iy, int32_t ix, int32_t from_mm)
{
  int32_t limit_mm = from_mm;
  int32_t i;
  /*@ loop invariant 0 <= i <= p->truck_zones;
    @ loop invariant sk_height_ok(limit_mm) && from_mm <= limit_mm;
    @ loop invariant \forall integer k; 0 <= k < i && sk_in_truck_zone(&p->truck_zone[k], iy, ix) ==> p->truck_zone[k].ceiling_mm <= limit_mm;
    @ loop invariant limit_mm == from_mm || sk_truck_passes(p, iy, ix, i, limit_mm);
    @ loop assigns i, limit_mm;
    @ loop variant p->truck_zones - i;
    @*/
  for (i = 0; i < p->truck_zones; i++) {
    if (sk_within_truck(&p->truck_zone[i], iy, ix) && p->truck_zone[i].ceiling_mm > limit_mm) { limit_mm = p->truck_zone[i].ceiling_mm; }
  }
  return limit_mm;
}

/* A limit raised to the ceilings of the dig zones that hold the cell. */
/*@ requires \valid_read(p) && sk_dig_ceilings_fit(p) && sk_in_map(iy, ix) && sk_height_ok(from_mm);
  @ assigns \nothing;
  @ ensures height: sk_height_ok(\result);
  @ ensures no_lower: from_mm <= \result;
  @ ensures every: \forall integer k; 0 <= k < p->dig_zones && sk_cell_in_zone(&p->dig_zone[k], iy, ix) ==> p->dig_zone[k].ceiling_mm <= \result;
  @ ensures reached: \result == from_mm || sk_dig_passes(p, iy, ix, p->dig_zones, \result);
  @*/
static int32_t sk_raised_by_digging(const berm_parameters *p, int32_t iy, int32_t ix, int32_t from_mm)
{
  int32_t limit_mm = from_mm;
  int32_t i;
  /*@ loop invariant 0 <= i <= p->dig_zones;
    @ loop invariant sk_height_ok(limit_mm) && from_mm <= limit_mm;
    @ loop invariant \forall integer k; 0 <= k < i && sk_cell_in_zone(&p->dig_zone[k], iy, ix) ==> p->dig_zone[k].ceiling_mm <= limit_mm;
    @ loop invariant limit_mm == from_mm || sk_dig_passes(p, iy, ix, i, limit_mm);
    @ loop assigns i, limit_mm;
    @ loop variant p->dig_zones - i;
    @*/
  for (i = 0; i < p->dig_zones; i++) {
    if (sk_is_in_zone(&p->dig_zone[i], iy, ix) && p->dig_zone[i].ceiling_mm > limit_mm) { limit_mm = p->dig_zone[i].ceiling_mm; }
  }
  return limit_mm;
}

/*@ requires \valid_read(p) && sk_overpass_ok(p) && sk_dig_ceilings_fit(p) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures sk_pass_limit(p, truck_admitted, iy, ix, \result);
  @*/
static int16_t sk_pass_limit_at(const berm_parameters *p, bool truck_admitted, int32_t iy, int32_t ix)
{
  int32_t limit_mm = sk_ground_limit(p, iy, ix);
  if (truck_admitted) { limit_mm = sk_raised_by_trucks(p, iy, ix, limit_mm); }
  return (int16_t)sk_raised_by_digging(p, iy, ix, limit_mm);
}

/*@ requires \valid_read(p) && sk_overpass_ok(p) && sk_dig_ceilings_fit(p) && \valid(out) && \separated(p, out) && 0 <= iy < SK_MAP_CELLS;
  @ assigns out->pass_mm[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> sk_pass_limit(p, truck_admitted, iy, ix, out->pass_mm[iy][ix]);
  @*/
static void sk_pass_row(const berm_parameters *p, bool truck_admitted, sk_clearance_rules *out, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant \forall integer i; 0 <= i < ix ==> sk_pass_limit(p, truck_admitted, iy, i, out->pass_mm[iy][i]);
    @ loop assigns ix, out->pass_mm[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) { out->pass_mm[iy][ix] = sk_pass_limit_at(p, truck_admitted, iy, ix); }
}

bool sk_pass_limits(const berm_parameters *p, bool truck_admitted, sk_clearance_rules *out)
{
  int32_t iy;
  if (sk_check_overpass(p) != SK_RULE_NONE || !sk_dig_ceilings_ok(p)) { return false; }
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> sk_pass_limit(p, truck_admitted, j, i, out->pass_mm[j][i]);
    @ loop assigns iy, out->pass_mm[..][..];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_pass_row(p, truck_admitted, out, iy); }
  return true;
}
