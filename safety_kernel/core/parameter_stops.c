#include "parameter_stops.h"

/* Of a column's speed, times 7, and of its square. */
/*@ requires 0 <= a <= 28000000 && 0 <= b <= 28000000;
  @ assigns \nothing;
  @ ensures \result == a * b && 0 <= \result <= 784000000000000;
  @*/
static int64_t product(int64_t a, int64_t b)
{
  return a * b;
}

/* Of an acceleration and an angle or a time. */
/*@ requires 0 <= a <= 50000000 && 0 <= b <= 30000000;
  @ assigns \nothing;
  @ ensures \result == a * b && 0 <= \result <= 1500000000000000;
  @*/
static int64_t wide_product(int64_t a, int64_t b)
{
  return a * b;
}

/*@ requires 0 <= k < BERM_BRAKE_SPEEDS && sk_within(velocity, 1000, 4000000) && sk_within(acceleration, 1000, 50000000) && sk_within(angle, 0, 6283186);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_way_possible(k, velocity, acceleration, angle);
  @*/
static bool way_possible(int32_t k, int32_t velocity, int32_t acceleration, int32_t angle)
{
  int64_t speed = (int64_t)k * (int64_t)velocity;
  /*@ assert 0 <= speed <= 28000000; */
  return product(speed, speed) <= 98 * SK_BRAKE_SHARE * wide_product(acceleration, angle);
}

/*@ requires 0 <= k < BERM_BRAKE_SPEEDS && sk_within(velocity, 1000, 4000000) && sk_within(acceleration, 1000, 50000000) && sk_within(time, 0, 30000000);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_time_possible(k, velocity, acceleration, time);
  @*/
static bool time_possible(int32_t k, int32_t velocity, int32_t acceleration, int32_t time)
{
  int64_t speed = (int64_t)k * (int64_t)velocity;
  /*@ assert 0 <= speed <= 28000000; */
  return 1000000 * speed <= 7 * SK_BRAKE_SHARE * wide_product(acceleration, time);
}

/*@ requires \valid_read(row + (0 .. BERM_BRAKE_SPEEDS - 1)) && sk_row_within(row, 6283186);
  @ requires sk_within(velocity, 1000, 4000000) && sk_within(acceleration, 1000, 50000000);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_row_ways(row, velocity, acceleration);
  @*/
static bool row_ways(const int32_t *row, int32_t velocity, int32_t acceleration)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer c; 0 <= c < k ==> sk_way_possible(c, velocity, acceleration, row[c]);
    @ loop assigns k;
    @ loop variant BERM_BRAKE_SPEEDS - k;
    @*/
  for (k = 0; k < BERM_BRAKE_SPEEDS; k++) {
    if (!way_possible(k, velocity, acceleration, row[k])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(row + (0 .. BERM_BRAKE_SPEEDS - 1)) && sk_row_within(row, 30000000);
  @ requires sk_within(velocity, 1000, 4000000) && sk_within(acceleration, 1000, 50000000);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_row_times(row, velocity, acceleration);
  @*/
static bool row_times(const int32_t *row, int32_t velocity, int32_t acceleration)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer c; 0 <= c < k ==> sk_time_possible(c, velocity, acceleration, row[c]);
    @ loop assigns k;
    @ loop variant BERM_BRAKE_SPEEDS - k;
    @*/
  for (k = 0; k < BERM_BRAKE_SPEEDS; k++) {
    if (!time_possible(k, velocity, acceleration, row[k])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= j < SK_JOINTS && sk_joint_angle_range(p, j);
  @ requires sk_within(p->velocity_max_urad_s[j], 1000, 4000000) && sk_within(p->acceleration_max_urad_s2[j], 1000, 50000000);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_joint_ways(p, j);
  @*/
static bool joint_ways(const berm_parameters *p, int32_t j)
{
  int32_t r;
  /*@ loop invariant 0 <= r <= BERM_BRAKE_REACHES;
    @ loop invariant \forall integer m; 0 <= m < r ==>
    @   sk_row_ways(&p->brake_angle_urad[j][m][0], p->velocity_max_urad_s[j], p->acceleration_max_urad_s2[j]);
    @ loop assigns r;
    @ loop variant BERM_BRAKE_REACHES - r;
    @*/
  for (r = 0; r < BERM_BRAKE_REACHES; r++) {
    if (!row_ways(p->brake_angle_urad[j][r], p->velocity_max_urad_s[j], p->acceleration_max_urad_s2[j])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= j < SK_JOINTS && sk_joint_time_range(p, j);
  @ requires sk_within(p->velocity_max_urad_s[j], 1000, 4000000) && sk_within(p->acceleration_max_urad_s2[j], 1000, 50000000);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_joint_times(p, j);
  @*/
static bool joint_times(const berm_parameters *p, int32_t j)
{
  int32_t r;
  /*@ loop invariant 0 <= r <= BERM_BRAKE_REACHES;
    @ loop invariant \forall integer m; 0 <= m < r ==>
    @   sk_row_times(&p->brake_time_us[j][m][0], p->velocity_max_urad_s[j], p->acceleration_max_urad_s2[j]);
    @ loop assigns r;
    @ loop variant BERM_BRAKE_REACHES - r;
    @*/
  for (r = 0; r < BERM_BRAKE_REACHES; r++) {
    if (!row_times(p->brake_time_us[j][r], p->velocity_max_urad_s[j], p->acceleration_max_urad_s2[j])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && sk_rule_velocity_max(p) && sk_rule_acceleration_max(p) && sk_rule_brake_angle_range(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_stop_angle(p);
  @*/
static bool ways_possible(const berm_parameters *p)
{
  int32_t j;
  /*@ loop invariant 0 <= j <= SK_JOINTS;
    @ loop invariant \forall integer i; 0 <= i < j ==> sk_joint_ways(p, i);
    @ loop assigns j;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    if (!joint_ways(p, j)) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && sk_rule_velocity_max(p) && sk_rule_acceleration_max(p) && sk_rule_brake_time_range(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_stop_time(p);
  @*/
static bool times_possible(const berm_parameters *p)
{
  int32_t j;
  /*@ loop invariant 0 <= j <= SK_JOINTS;
    @ loop invariant \forall integer i; 0 <= i < j ==> sk_joint_times(p, i);
    @ loop assigns j;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    if (!joint_times(p, j)) { return false; }
  }
  return true;
}

int32_t sk_check_stops(const berm_parameters *p)
{
  if (!ways_possible(p)) { return SK_RULE_STOP_ANGLE; }
  if (!times_possible(p)) { return SK_RULE_STOP_TIME; }
  return SK_RULE_NONE;
}
