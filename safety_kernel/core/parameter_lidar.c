#include "parameter_lidar.h"
#include "parameter_range.h"

/*@ requires \valid_read(m);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_lidar_position_ok(m);
  @*/
static bool position_ok(const berm_lidar_mount *m)
{
  return sk_is_within(m->x_mm, -5000, 5000) && sk_is_within(m->y_mm, -5000, 5000) && sk_is_within(m->z_mm, 0, 8000);
}

/*@ requires \valid_read(m);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_lidar_angles_ok(m);
  @*/
static bool angles_ok(const berm_lidar_mount *m)
{
  return sk_is_within(m->roll_urad, -3141593, 3141593) && sk_is_within(m->pitch_urad, -3141593, 3141593) && sk_is_within(m->yaw_urad, -3141593, 3141593);
}

/*@ requires \valid_read(p) && 0 <= p->lidars <= BERM_LIDARS;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_lidar_position(p);
  @*/
static bool positions_ok(const berm_parameters *p)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= p->lidars;
    @ loop invariant \forall integer k; 0 <= k < i ==> sk_lidar_position_ok(&p->lidar[k]);
    @ loop assigns i;
    @ loop variant p->lidars - i;
    @*/
  for (i = 0; i < p->lidars; i++) {
    if (!position_ok(&p->lidar[i])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= p->lidars <= BERM_LIDARS;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_lidar_angles(p);
  @*/
static bool all_angles_ok(const berm_parameters *p)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= p->lidars;
    @ loop invariant \forall integer k; 0 <= k < i ==> sk_lidar_angles_ok(&p->lidar[k]);
    @ loop assigns i;
    @ loop variant p->lidars - i;
    @*/
  for (i = 0; i < p->lidars; i++) {
    if (!angles_ok(&p->lidar[i])) { return false; }
  }
  return true;
}

int32_t sk_check_lidars(const berm_parameters *p)
{
  if (!sk_is_within(p->lidars, 0, BERM_LIDARS)) { return SK_RULE_LIDAR_COUNT; }
  if (!positions_ok(p)) { return SK_RULE_LIDAR_POSITION; }
  if (!all_angles_ok(p)) { return SK_RULE_LIDAR_ANGLES; }
  return SK_RULE_NONE;
}
