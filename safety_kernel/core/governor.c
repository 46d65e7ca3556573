#include "governor.h"

/*@ requires \valid_read(p) && 0 <= joint < SK_JOINTS && 0 <= row < BERM_BRAKE_REACHES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_brake_row_fits(p, joint, row);
  @*/
static bool sk_brakes_ok(const berm_parameters *p, int32_t joint, int32_t row)
{
  int32_t before = 0;
  int32_t k;
  /*@ loop invariant 0 <= k <= BERM_BRAKE_SPEEDS && before == (k > 0 ? p->brake_angle_urad[joint][row][k - 1] : 0);
    @ loop invariant \forall integer j; 0 <= j < k ==> 0 <= p->brake_angle_urad[joint][row][j] <= SK_BRAKE_ANGLE_MAX_URAD;
    @ loop invariant \forall integer j; 0 < j < k ==> p->brake_angle_urad[joint][row][j - 1] <= p->brake_angle_urad[joint][row][j];
    @ loop assigns k, before;
    @ loop variant BERM_BRAKE_SPEEDS - k;
    @*/
  for (k = 0; k < BERM_BRAKE_SPEEDS; k++) {
    int32_t angle = p->brake_angle_urad[joint][row][k];
    if (angle < before || angle > SK_BRAKE_ANGLE_MAX_URAD) { return false; }
    before = angle;
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

/*@ requires 0 <= velocity_max_urad_s <= SK_REACH_SPEED_MAX_URAD_S && 0 <= level < SK_GOVERNOR_LEVELS;
  @ assigns \nothing;
  @ ensures \result == sk_level_speed_of(velocity_max_urad_s, level);
  @ ensures 0 <= \result <= velocity_max_urad_s;
  @*/
static int32_t sk_level_speed(int32_t velocity_max_urad_s, int32_t level)
{
  int64_t product = (int64_t)velocity_max_urad_s * level;
  /*@ assert 0 <= velocity_max_urad_s * level <= velocity_max_urad_s * (SK_GOVERNOR_LEVELS - 1); */
  return (int32_t)(product / (SK_GOVERNOR_LEVELS - 1));
}

int64_t sk_governor_room(const berm_parameters *p, int32_t joint, int32_t row, int32_t level)
{
  int32_t next, speed, angle;
  int64_t time_us, room;
  if (level < 0 || level >= SK_GOVERNOR_LEVELS || !sk_governor_ok(p, joint, row)) { return -1; }
  next = level + 1 < SK_GOVERNOR_LEVELS ? level + 1 : SK_GOVERNOR_LEVELS - 1;
  speed = sk_level_speed(p->velocity_max_urad_s[joint], next);
  angle = sk_brake_angle(p, joint, row, speed);
  /*@ assert total: 0 <= angle; */
  time_us = (int64_t)p->state_latency_us + p->cycle_us + p->command_latency_us;
  /*@ assert time_us == sk_reach_time_of(p); */
  room = p->angle_error_urad[joint] + (int64_t)angle + sk_way_of(time_us, speed);
  /*@ assert entry: sk_brake_entry(p, joint, row, speed, angle); */
  /*@ assert sum: room == p->angle_error_urad[joint] + angle + sk_twice_way(sk_reach_time_of(p), speed); */
  /*@ assert room: sk_room_for(p, joint, row, speed, room); */
  return room;
}

int32_t sk_governor_level(const berm_parameters *p, int32_t joint, int32_t row, int64_t clear_urad)
{
  int32_t level;
  /*@ loop invariant 1 <= level <= SK_GOVERNOR_LEVELS;
    @ loop invariant \forall integer k; 1 <= k < level ==> sk_governor_fits(p, joint, row) && sk_level_clear(p, joint, row, k, clear_urad);
    @ loop assigns level;
    @ loop variant SK_GOVERNOR_LEVELS - level;
    @*/
  for (level = 1; level < SK_GOVERNOR_LEVELS; level++) {
    int64_t room = sk_governor_room(p, joint, row, level);
    if (room < 0 || room > clear_urad) { return level - 1; }
    /*@ assert room: sk_room_is(p, joint, row, level, room) && room <= clear_urad; */
    /*@ assert clear: sk_level_clear(p, joint, row, level, clear_urad); */
  }
  return SK_GOVERNOR_LEVELS - 1;
}

int32_t sk_governor_speed(const berm_parameters *p, int32_t joint, int32_t level)
{
  int32_t speed, creep;
  if (joint < 0 || joint >= SK_JOINTS || level < 0 || level >= SK_GOVERNOR_LEVELS || !sk_limits_ok(p, joint)) { return 0; }
  if (level == SK_GOVERNOR_LEVELS - 1) { return p->velocity_max_urad_s[joint]; }
  speed = sk_level_speed(p->velocity_max_urad_s[joint], level);
  creep = p->creep_velocity_urad_s[joint];
  return speed > creep ? speed : creep;
}

int64_t sk_governor_stop_time(const berm_parameters *p, int32_t joint, int32_t row, int32_t speed_urad_s)
{
  int32_t brake_us;
  if (!sk_times_ok(p)) { return -1; }
  brake_us = sk_brake_time(p, joint, row, speed_urad_s);
  if (brake_us < 0) { return -1; }
  return (int64_t)p->cycle_us + p->command_latency_us + brake_us;
}

int64_t sk_governor_level_time(const berm_parameters *p, int32_t joint, int32_t row, int32_t level)
{
  int32_t next;
  int64_t next_us, column_us;
  if (level < 0 || level >= SK_GOVERNOR_LEVELS || joint < 0 || joint >= SK_JOINTS || !sk_limits_ok(p, joint)) { return -1; }
  next = level + 1 < SK_GOVERNOR_LEVELS ? level + 1 : SK_GOVERNOR_LEVELS - 1;
  next_us = sk_governor_stop_time(p, joint, row, sk_level_speed(p->velocity_max_urad_s[joint], next));
  column_us = sk_governor_stop_time(p, joint, row, sk_level_speed(p->velocity_max_urad_s[joint], SK_GOVERNOR_COLUMN));
  if (next_us < 0 || column_us < 0) { return -1; }
  return next > SK_GOVERNOR_COLUMN ? next_us + column_us : next_us;
}

int32_t sk_governor_timed_level(const berm_parameters *p, int32_t joint, int32_t row, int64_t stop_us)
{
  int32_t level;
  /*@ loop invariant 1 <= level <= SK_GOVERNOR_LEVELS;
    @ loop invariant \forall integer k; 1 <= k < level ==> sk_level_in_time(p, joint, row, k, stop_us);
    @ loop assigns level;
    @ loop variant SK_GOVERNOR_LEVELS - level;
    @*/
  for (level = 1; level < SK_GOVERNOR_LEVELS; level++) {
    int64_t time_us = sk_governor_level_time(p, joint, row, level);
    if (time_us < 0 || time_us > stop_us) { return level - 1; }
    /*@ assert time: sk_level_time_is(p, joint, row, level, time_us) && time_us <= stop_us; */
    /*@ assert in_time: sk_level_in_time(p, joint, row, level, stop_us); */
  }
  return SK_GOVERNOR_LEVELS - 1;
}

int32_t sk_governor_timed_speed(const berm_parameters *p, int32_t joint, int32_t level)
{
  if (joint < 0 || joint >= SK_JOINTS || level < 0 || level >= SK_GOVERNOR_LEVELS || !sk_limits_ok(p, joint)) { return 0; }
  return sk_level_speed(p->velocity_max_urad_s[joint], level);
}

int32_t sk_governor_clamp(int32_t requested_urad_s, int32_t low_urad_s, int32_t high_urad_s)
{
  int32_t cut = requested_urad_s;
  if (low_urad_s > 0 || high_urad_s < 0) { return 0; }
  if (cut < low_urad_s) { cut = low_urad_s; }
  if (cut > high_urad_s) { cut = high_urad_s; }
  return cut / SK_COMMAND_STEP_URAD_S * SK_COMMAND_STEP_URAD_S;
}
