#include "reach_box.h"

int32_t sk_brake_row(const berm_parameters *p, int32_t reach_mm)
{
  int32_t row;
  /*@ loop invariant 0 <= row <= BERM_BRAKE_REACHES;
    @ loop invariant \forall integer r; 0 <= r < row ==> p->brake_reach_mm[r] < reach_mm;
    @ loop assigns row;
    @ loop variant BERM_BRAKE_REACHES - row;
    @*/
  for (row = 0; row < BERM_BRAKE_REACHES; row++) {
    if (p->brake_reach_mm[row] >= reach_mm) { return row; }
  }
  return -1;
}

/* What is at or below this speed is covered by the column's entry. */
int32_t sk_column_speed(int32_t velocity_max_urad_s, int32_t column)
{
  int64_t product = (int64_t)velocity_max_urad_s * column;
  /*@ assert 0 <= velocity_max_urad_s * column <= velocity_max_urad_s * (BERM_BRAKE_SPEEDS - 1); */
  return (int32_t)(product / (BERM_BRAKE_SPEEDS - 1));
}

/*@ requires 0 <= velocity_max_urad_s;
  @ assigns \nothing;
  @ ensures -1 <= \result < BERM_BRAKE_SPEEDS;
  @ ensures \result >= 0 ==> sk_first_column(velocity_max_urad_s, speed_urad_s, \result) && speed_urad_s <= velocity_max_urad_s;
  @ ensures speed_urad_s <= velocity_max_urad_s ==> \result >= 0;
  @*/
static int32_t sk_brake_column(int32_t velocity_max_urad_s, int32_t speed_urad_s)
{
  int32_t column;
  /*@ loop invariant 0 <= column <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer j; 0 <= j < column ==> sk_column_speed_of(velocity_max_urad_s, j) < speed_urad_s;
    @ loop assigns column;
    @ loop variant BERM_BRAKE_SPEEDS - column;
    @*/
  for (column = 0; column < BERM_BRAKE_SPEEDS; column++) {
    if (sk_column_speed(velocity_max_urad_s, column) >= speed_urad_s) { return column; }
  }
  /*@ assert last: sk_column_speed_of(velocity_max_urad_s, BERM_BRAKE_SPEEDS - 1) == velocity_max_urad_s; */
  /*@ assert slower: sk_column_speed_of(velocity_max_urad_s, BERM_BRAKE_SPEEDS - 1) < speed_urad_s; */
  return -1;
}

/*@ requires 0 <= rise <= SK_BRAKE_ANGLE_MAX_URAD && 0 <= way <= width <= 2147483647;
  @ assigns \nothing;
  @ ensures \result == sk_share_of(rise, way, width);
  @ ensures 0 <= \result <= rise;
  @*/
static int64_t sk_share(int64_t rise, int64_t way, int64_t width)
{
  int64_t share;
  if (width <= 0) { return rise; }
  /*@ assert 0 <= rise * way <= SK_BRAKE_ANGLE_MAX_URAD * width; */
  share = (rise * way + width - 1) / width;
  return sk_least_of(share, rise);
}

int32_t sk_brake_angle(const berm_parameters *p, int32_t joint, int32_t row, int32_t speed_urad_s)
{
  int32_t column, before, low, high, from, to;
  if (joint < 0 || joint >= SK_JOINTS || row < 0 || row >= BERM_BRAKE_REACHES) { return -1; }
  if (p->velocity_max_urad_s[joint] < 0) { return -1; }
  column = sk_brake_column(p->velocity_max_urad_s[joint], speed_urad_s);
  if (column < 0) { return -1; }
  before = column > 0 ? column - 1 : 0;
  low = p->brake_angle_urad[joint][row][before];
  high = p->brake_angle_urad[joint][row][column];
  /*@ assert rising: sk_brake_row_fits(p, joint, row) ==> p->brake_angle_urad[joint][row][before] <= p->brake_angle_urad[joint][row][column]; */
  if (low < 0 || low > high || high > SK_BRAKE_ANGLE_MAX_URAD) { return -1; }
  from = sk_column_speed(p->velocity_max_urad_s[joint], before);
  to = sk_column_speed(p->velocity_max_urad_s[joint], column);
  if (column == 0) { return high; } /* at rest, or moving the other way */
  /*@ assert from < speed_urad_s <= to; */
  return (int32_t)(low + sk_share(high - low, (int64_t)speed_urad_s - from, (int64_t)to - from));
}

int32_t sk_brake_time(const berm_parameters *p, int32_t joint, int32_t row, int32_t speed_urad_s)
{
  int32_t column, time;
  if (joint < 0 || joint >= SK_JOINTS || row < 0 || row >= BERM_BRAKE_REACHES) { return -1; }
  if (p->velocity_max_urad_s[joint] < 0) { return -1; }
  column = sk_brake_column(p->velocity_max_urad_s[joint], speed_urad_s);
  if (column < 0) { return -1; }
  time = p->brake_time_us[joint][row][column];
  if (time < 0 || time > SK_BRAKE_TIME_MAX_US) { return -1; }
  return time;
}

bool sk_times_ok(const berm_parameters *p)
{
  return p->state_latency_us >= 0 && p->state_latency_us <= SK_REACH_LATENCY_MAX_US && p->cycle_us >= 0 &&
         p->cycle_us <= SK_REACH_LATENCY_MAX_US && p->command_latency_us >= 0 && p->command_latency_us <= SK_REACH_LATENCY_MAX_US;
}

bool sk_limits_ok(const berm_parameters *p, int32_t joint)
{
  return p->velocity_max_urad_s[joint] >= 0 && p->velocity_max_urad_s[joint] <= SK_REACH_SPEED_MAX_URAD_S &&
         p->acceleration_max_urad_s2[joint] > 0 && p->acceleration_max_urad_s2[joint] <= SK_REACH_ACCELERATION_MAX_URAD_S2 &&
         p->angle_error_urad[joint] >= 0 && p->angle_error_urad[joint] <= SK_REACH_ERROR_MAX && p->velocity_error_urad_s[joint] >= 0 &&
         p->velocity_error_urad_s[joint] <= SK_REACH_ERROR_MAX;
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_commands_fit(mode, low_urad_s, high_urad_s);
  @*/
static bool sk_commands_ok(int32_t mode, int32_t low_urad_s, int32_t high_urad_s)
{
  if (mode == SK_REACH_ANY) { return true; }
  if (mode != SK_REACH_COMMANDED) { return false; }
  return -SK_REACH_SPEED_MAX_URAD_S <= low_urad_s && low_urad_s <= high_urad_s && high_urad_s <= SK_REACH_SPEED_MAX_URAD_S;
}

/*@ requires 0 <= fastest_urad_s <= SK_REACH_SPEED_MAX_URAD_S + SK_REACH_ERROR_MAX;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_measurement_fits(angle_urad, velocity_urad_s, fastest_urad_s);
  @*/
static bool sk_measurement_ok(int32_t angle_urad, int32_t velocity_urad_s, int64_t fastest_urad_s)
{
  return -SK_REACH_ANGLE_MAX_URAD <= angle_urad && angle_urad <= SK_REACH_ANGLE_MAX_URAD && -SK_REACH_SPEED_MAX_URAD_S <= velocity_urad_s &&
         velocity_urad_s <= SK_REACH_SPEED_MAX_URAD_S && -fastest_urad_s <= velocity_urad_s && velocity_urad_s <= fastest_urad_s;
}

/*@ predicate sk_pair_fits(integer acceleration, integer time_us) =
  @   0 < acceleration <= SK_REACH_ACCELERATION_MAX_URAD_S2 && 0 <= time_us <= 3 * SK_REACH_LATENCY_MAX_US;
  @*/

/*@ requires sk_pair_fits(acceleration, time_us) && -10000000 <= start <= 10000000;
  @ requires -10000000 <= cap <= SK_REACH_SPEED_MAX_URAD_S;
  @ assigns \nothing;
  @ ensures \result == sk_speed_of(start, cap, acceleration, time_us);
  @ ensures \result <= cap;
  @ ensures start <= cap ==> start <= \result;
  @*/
static int64_t sk_speed(int64_t start, int64_t cap, int64_t acceleration, int64_t time_us)
{
  int64_t gain = (acceleration * time_us + 999999) / 1000000;
  return sk_least_of(start + gain, cap);
}

/* The gain is rounded down, so that the travel is rounded up. */
/*@ requires sk_pair_fits(acceleration, time_us) && 0 < speed <= SK_REACH_SPEED_MAX_URAD_S && -10000000 <= start <= speed;
  @ assigns \nothing;
  @ ensures \result == sk_travel_of(speed, sk_gain_of(start, speed, acceleration, time_us), acceleration, time_us);
  @ ensures 0 <= \result <= 3 * SK_REACH_SPEED_MAX_URAD_S;
  @*/
static int64_t sk_travel(int64_t start, int64_t speed, int64_t acceleration, int64_t time_us)
{
  int64_t gain = sk_least_of(speed - start, acceleration * time_us / 1000000);
  int64_t steady = (speed * time_us + 999999) / 1000000;
  int64_t saved = gain * gain / (2 * acceleration);
  return sk_most_of(steady - saved, 0);
}

/* How far the joint gets beyond angle + error in one direction; -1 when the braking table refuses. */
/*@ requires \valid_read(p) && 0 <= joint < SK_JOINTS && sk_times_fit(p) && sk_limits_fit(p, joint);
  @ requires -10000000 <= start <= speed <= SK_REACH_SPEED_MAX_URAD_S;
  @ assigns \nothing;
  @ ensures -1 <= \result <= SK_BRAKE_ANGLE_MAX_URAD + 3 * SK_REACH_SPEED_MAX_URAD_S;
  @ ensures \result >= 0 ==> sk_extent_is(p, joint, row, start, speed, \result);
  @*/
static int64_t sk_extent(const berm_parameters *p, int32_t joint, int32_t row, int64_t start, int64_t speed)
{
  int64_t time_us = (int64_t)p->state_latency_us + p->cycle_us + p->command_latency_us;
  int32_t brake;
  if (speed <= 0) { return 0; }
  brake = sk_brake_angle(p, joint, row, (int32_t)speed);
  if (brake < 0) { return -1; }
  return sk_travel(start, speed, p->acceleration_max_urad_s2[joint], time_us) + brake;
}

/* c of the header. */
/*@ requires -SK_REACH_SPEED_MAX_URAD_S <= velocity <= SK_REACH_SPEED_MAX_URAD_S;
  @ requires mode != SK_REACH_ANY ==> -SK_REACH_SPEED_MAX_URAD_S <= command <= SK_REACH_SPEED_MAX_URAD_S;
  @ requires 0 <= error <= SK_REACH_ERROR_MAX && 0 <= velocity_max <= SK_REACH_SPEED_MAX_URAD_S;
  @ assigns \nothing;
  @ ensures \result == sk_cap_of(mode, velocity, command, error, velocity_max);
  @ ensures -SK_REACH_SPEED_MAX_URAD_S <= \result <= velocity_max;
  @*/
static int64_t sk_cap(int32_t mode, int64_t velocity, int64_t command, int64_t error, int64_t velocity_max)
{
  if (mode == SK_REACH_ANY) { return velocity_max; }
  return sk_least_of(sk_most_of(velocity + error, command) + error, velocity_max);
}

/* One direction of one joint, in which velocity and command count positive: the largest speed, and the extent or -1. */
/*@ requires \valid_read(p) && \valid(speed) && \separated(p, speed) && 0 <= joint < SK_JOINTS && sk_times_fit(p) && sk_limits_fit(p, joint);
  @ requires -SK_REACH_SPEED_MAX_URAD_S <= velocity <= SK_REACH_SPEED_MAX_URAD_S;
  @ requires mode != SK_REACH_ANY ==> -SK_REACH_SPEED_MAX_URAD_S <= command <= SK_REACH_SPEED_MAX_URAD_S;
  @ assigns *speed;
  @ ensures *speed == sk_side_speed(p, joint, mode, velocity, command);
  @ ensures *speed <= p->velocity_max_urad_s[joint];
  @ ensures -1 <= \result <= SK_BRAKE_ANGLE_MAX_URAD + 3 * SK_REACH_SPEED_MAX_URAD_S;
  @ ensures \result >= 0 ==> sk_side_extent_is(p, joint, row, mode, velocity, command, \result);
  @*/
static int64_t sk_side(const berm_parameters *p, int32_t joint, int32_t row, int32_t mode, int64_t velocity, int64_t command, int64_t *speed)
{
  int64_t time_us = (int64_t)p->state_latency_us + p->cycle_us + p->command_latency_us;
  int64_t error = p->velocity_error_urad_s[joint];
  int64_t cap = sk_cap(mode, velocity, command, error, p->velocity_max_urad_s[joint]);
  int64_t start = sk_least_of(velocity + error, cap);
  *speed = sk_speed(start, cap, p->acceleration_max_urad_s2[joint], time_us);
  return sk_extent(p, joint, row, start, *speed);
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> 0 <= joint < SK_JOINTS && sk_times_fit(p) && sk_limits_fit(p, joint) && sk_commands_fit(mode, low, high) &&
  @   sk_measurement_fits(angle_urad, velocity_urad_s, p->velocity_max_urad_s[joint] + p->velocity_error_urad_s[joint]);
  @*/
static bool sk_inputs_ok(const berm_parameters *p, int32_t joint, int32_t angle_urad, int32_t velocity_urad_s, int32_t mode, int32_t low, int32_t high)
{
  if (joint < 0 || joint >= SK_JOINTS) { return false; }
  if (!sk_times_ok(p) || !sk_limits_ok(p, joint) || !sk_commands_ok(mode, low, high)) { return false; }
  return sk_measurement_ok(angle_urad, velocity_urad_s, (int64_t)p->velocity_max_urad_s[joint] + p->velocity_error_urad_s[joint]);
}

bool sk_reach_joint(const berm_parameters *p, int32_t joint, int32_t row, int32_t angle_urad, int32_t velocity_urad_s, int32_t mode,
                    int32_t command_low_urad_s, int32_t command_high_urad_s, sk_reach_box *out)
{
  int64_t speed_up, speed_down, up, down;
  if (!sk_inputs_ok(p, joint, angle_urad, velocity_urad_s, mode, command_low_urad_s, command_high_urad_s)) { return false; }
  up = sk_side(p, joint, row, mode, velocity_urad_s, command_high_urad_s, &speed_up);
  /*@ assert up_now: up >= 0 ==> sk_side_extent_is{Pre}(p, joint, row, mode, velocity_urad_s, command_high_urad_s, up); */
  down = sk_side(p, joint, row, mode, -(int64_t)velocity_urad_s, -(int64_t)command_low_urad_s, &speed_down);
  /*@ assert down_now: down >= 0 ==> sk_side_extent_is{Pre}(p, joint, row, mode, -velocity_urad_s, -command_low_urad_s, down); */
  if (up < 0 || down < 0) { return false; }
  out->low_urad[joint] = (int32_t)(angle_urad - p->angle_error_urad[joint] - down);
  out->high_urad[joint] = (int32_t)(angle_urad + p->angle_error_urad[joint] + up);
  out->speed_urad_s[joint] = (int32_t)sk_most_of(sk_most_of(speed_up, speed_down), 0);
  /*@ assert angle_urad - p->angle_error_urad[joint] - out->low_urad[joint] == down; */
  /*@ assert out->high_urad[joint] - angle_urad - p->angle_error_urad[joint] == up; */
  return true;
}
