#include "governor.h"

/*@ requires \valid_read(p) && 0 <= joint < SK_JOINTS && 0 <= row < BERM_BRAKE_REACHES;
  @ assigns \nothing;
  @ ensures \result == true <==>
  @   (\forall integer k; 0 <= k < BERM_BRAKE_SPEEDS ==> 0 <= p->brake_angle_urad[joint][row][k] <= SK_BRAKE_ANGLE_MAX_URAD);
  @*/
static bool sk_brakes_ok(const berm_parameters *p, int32_t joint, int32_t row)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer j; 0 <= j < k ==> 0 <= p->brake_angle_urad[joint][row][j] <= SK_BRAKE_ANGLE_MAX_URAD;
    @ loop assigns k;
    @ loop variant BERM_BRAKE_SPEEDS - k;
    @*/
  for (k = 0; k < BERM_BRAKE_SPEEDS; k++) {
    if (p->brake_angle_urad[joint][row][k] < 0 || p->brake_angle_urad[joint][row][k] > SK_BRAKE_ANGLE_MAX_URAD) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_governor_fits(p, joint, row);
  @*/
static bool sk_governor_ok(const berm_parameters *p, int32_t joint, int32_t row)
{
  if (joint < 0 || joint >= SK_JOINTS || row < 0 || row >= BERM_BRAKE_REACHES) { return false; }
  return sk_times_ok(p) && sk_limits_ok(p, joint) && sk_brakes_ok(p, joint, row);
}

/*@ requires 0 <= time_us <= 3 * SK_REACH_LATENCY_MAX_US && 0 <= speed_urad_s <= SK_REACH_SPEED_MAX_URAD_S;
  @ assigns \nothing;
  @ ensures \result == sk_twice_way(time_us, speed_urad_s) && 0 <= \result <= 30000000;
  @*/
static int64_t sk_way_of(int64_t time_us, int64_t speed_urad_s)
{
  /*@ assert 0 <= time_us * speed_urad_s <= 3 * SK_REACH_LATENCY_MAX_US * SK_REACH_SPEED_MAX_URAD_S; */
  return (2 * time_us * speed_urad_s + 999999) / 1000000;
}

int64_t sk_governor_room(const berm_parameters *p, int32_t joint, int32_t row, int32_t level)
{
  int32_t column, speed;
  int64_t time_us;
  if (level < 0 || level >= SK_GOVERNOR_LEVELS || !sk_governor_ok(p, joint, row)) { return -1; }
  column = level + 1 < BERM_BRAKE_SPEEDS ? level + 1 : BERM_BRAKE_SPEEDS - 1;
  speed = sk_column_speed(p->velocity_max_urad_s[joint], column);
  time_us = (int64_t)p->state_latency_us + p->cycle_us + p->command_latency_us;
  /*@ assert time_us == sk_reach_time_of(p); */
  return sk_way_of(time_us, speed) + p->brake_angle_urad[joint][row][column] + p->angle_error_urad[joint];
}

int32_t sk_governor_level(const berm_parameters *p, int32_t joint, int32_t row, int64_t clear_urad)
{
  int32_t level;
  /*@ loop invariant 1 <= level <= SK_GOVERNOR_LEVELS;
    @ loop invariant \forall integer k; 1 <= k < level ==> sk_governor_fits(p, joint, row) && sk_room_of(p, joint, row, k) <= clear_urad;
    @ loop assigns level;
    @ loop variant SK_GOVERNOR_LEVELS - level;
    @*/
  for (level = 1; level < SK_GOVERNOR_LEVELS; level++) {
    int64_t room = sk_governor_room(p, joint, row, level);
    if (room < 0 || room > clear_urad) { return level - 1; }
  }
  return SK_GOVERNOR_LEVELS - 1;
}

int32_t sk_governor_speed(const berm_parameters *p, int32_t joint, int32_t level)
{
  int32_t speed, creep;
  if (joint < 0 || joint >= SK_JOINTS || level < 0 || level >= SK_GOVERNOR_LEVELS || !sk_limits_ok(p, joint)) { return 0; }
  if (level == SK_GOVERNOR_LEVELS - 1) { return p->velocity_max_urad_s[joint]; }
  speed = sk_column_speed(p->velocity_max_urad_s[joint], level) - 3 * p->velocity_error_urad_s[joint];
  creep = p->creep_velocity_urad_s[joint] > 0 ? p->creep_velocity_urad_s[joint] : 0;
  return speed > creep ? speed : creep;
}

int32_t sk_governor_clamp(int32_t requested_urad_s, int32_t low_urad_s, int32_t high_urad_s)
{
  int32_t cut = requested_urad_s;
  if (low_urad_s > 0 || high_urad_s < 0) { return 0; }
  if (cut < low_urad_s) { cut = low_urad_s; }
  if (cut > high_urad_s) { cut = high_urad_s; }
  return cut / SK_COMMAND_STEP_URAD_S * SK_COMMAND_STEP_URAD_S;
}
