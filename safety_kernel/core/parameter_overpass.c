#include "parameter_overpass.h"
#include "parameter_range.h"
#include "parameter_rectangle.h"

/*@ requires \valid_read(z);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_ground_bounds_ok(z);
  @*/
static bool ground_ok(const berm_ground_zone *z)
{
  return sk_is_rectangle(z->x_low_mm, z->y_low_mm, z->x_high_mm, z->y_high_mm);
}

/*@ requires \valid_read(z);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_truck_bounds_ok(z);
  @*/
static bool truck_ok(const berm_truck_zone *z)
{
  return sk_is_rectangle(z->x_low_mm, z->y_low_mm, z->x_high_mm, z->y_high_mm);
}

/*@ requires \valid_read(p) && 0 <= p->ground_zones <= BERM_GROUND_ZONES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_ground_zone_bounds(p);
  @*/
static bool ground_bounds_ok(const berm_parameters *p)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= p->ground_zones;
    @ loop invariant \forall integer k; 0 <= k < i ==> sk_ground_bounds_ok(&p->ground_zone[k]);
    @ loop assigns i;
    @ loop variant p->ground_zones - i;
    @*/
  for (i = 0; i < p->ground_zones; i++) {
    if (!ground_ok(&p->ground_zone[i])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= p->ground_zones <= BERM_GROUND_ZONES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_ground_zone_limit(p);
  @*/
static bool ground_limits_ok(const berm_parameters *p)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= p->ground_zones;
    @ loop invariant \forall integer k; 0 <= k < i ==> sk_height_ok(p->ground_zone[k].pass_over_mm);
    @ loop assigns i;
    @ loop variant p->ground_zones - i;
    @*/
  for (i = 0; i < p->ground_zones; i++) {
    if (!sk_is_within(p->ground_zone[i].pass_over_mm, -SK_HEIGHT_MAX_MM, SK_HEIGHT_MAX_MM)) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= p->truck_zones <= BERM_TRUCK_ZONES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_truck_zone_bounds(p);
  @*/
static bool truck_bounds_ok(const berm_parameters *p)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= p->truck_zones;
    @ loop invariant \forall integer k; 0 <= k < i ==> sk_truck_bounds_ok(&p->truck_zone[k]);
    @ loop assigns i;
    @ loop variant p->truck_zones - i;
    @*/
  for (i = 0; i < p->truck_zones; i++) {
    if (!truck_ok(&p->truck_zone[i])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= p->truck_zones <= BERM_TRUCK_ZONES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_truck_zone_ceiling(p);
  @*/
static bool truck_ceilings_ok(const berm_parameters *p)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= p->truck_zones;
    @ loop invariant \forall integer k; 0 <= k < i ==> sk_height_ok(p->truck_zone[k].ceiling_mm);
    @ loop assigns i;
    @ loop variant p->truck_zones - i;
    @*/
  for (i = 0; i < p->truck_zones; i++) {
    if (!sk_is_within(p->truck_zone[i].ceiling_mm, -SK_HEIGHT_MAX_MM, SK_HEIGHT_MAX_MM)) { return false; }
  }
  return true;
}

int32_t sk_check_overpass(const berm_parameters *p)
{
  if (!sk_is_within(p->pass_over_mm, -SK_HEIGHT_MAX_MM, SK_HEIGHT_MAX_MM)) { return SK_RULE_PASS_OVER; }
  if (!sk_is_within(p->ground_zones, 0, BERM_GROUND_ZONES)) { return SK_RULE_GROUND_ZONE_COUNT; }
  if (!ground_bounds_ok(p)) { return SK_RULE_GROUND_ZONE_BOUNDS; }
  if (!ground_limits_ok(p)) { return SK_RULE_GROUND_ZONE_LIMIT; }
  if (!sk_is_within(p->truck_zones, 0, BERM_TRUCK_ZONES)) { return SK_RULE_TRUCK_ZONE_COUNT; }
  if (!truck_bounds_ok(p)) { return SK_RULE_TRUCK_ZONE_BOUNDS; }
  if (!truck_ceilings_ok(p)) { return SK_RULE_TRUCK_ZONE_CEILING; }
  return SK_RULE_NONE;
}
