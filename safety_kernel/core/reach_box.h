/* The reach box: for each joint the interval that holds every position it can take if a command is obeyed for one more cycle and a stop
 * is issued then, from measured angle and speed with their error bounds, largest acceleration, latencies and the braking table.
 *
 * In each direction, with T = state latency + cycle + command latency, s the largest speed now (measured + error) and c the largest speed
 * the joint takes on, whatever the time:
 *   speed  = min(s + acceleration T, c)
 *   travel = speed T - (speed - s)^2 / (2 acceleration)   the ramp from s to speed and on at speed; 0 if that is negative
 *   extent = travel + braking angle of speed              0 when speed <= 0: the joint never moves in this direction
 * each term rounded outward to the microradian. c = velocity_max in SK_REACH_ANY; in SK_REACH_COMMANDED the larger of s and the commands,
 * plus velocity_error, at most velocity_max.
 * Assumed: a joint is never faster than velocity_max, speeds up by no more than acceleration_max, and stops as the braking table says; between
 * two of the table's speeds its stop angle is at most on the chord (identified at the middle: fault_injection/identify/IDENTIFY.md). */
#ifndef SK_REACH_BOX_H
#define SK_REACH_BOX_H
#include "least_most.h"
#include "config/parameter_block.h"
SK_BEGIN

/* Ranges of what enters. */
#define SK_REACH_ANGLE_MAX_URAD 10000000
#define SK_REACH_SPEED_MAX_URAD_S 5000000
#define SK_REACH_ACCELERATION_MAX_URAD_S2 100000000
#define SK_REACH_ERROR_MAX 1000000 /* of an angle (urad) and of a speed (urad/s) */
#define SK_REACH_LATENCY_MAX_US 1000000
#define SK_BRAKE_ANGLE_MAX_URAD 100000000
#define SK_BRAKE_TIME_MAX_US 100000000

typedef struct sk_reach_box {
  int32_t low_urad[SK_JOINTS];
  int32_t high_urad[SK_JOINTS];
  int32_t speed_urad_s[SK_JOINTS]; /* bound of the joint's absolute speed until it stands */
} sk_reach_box;

/* How the next cycle's command enters. */
enum {
  SK_REACH_ANY = 0,      /* any command whatever may be obeyed */
  SK_REACH_COMMANDED = 1 /* only commands within command_low..command_high (all that are still under way and the next); for creep recovery */
};

/*@ // speed of a column of the braking table, rounded down
  @ logic integer sk_column_speed_of(integer velocity_max, integer column) = velocity_max * column / (BERM_BRAKE_SPEEDS - 1);
  @ predicate sk_first_column(integer velocity_max, integer speed, integer column) =
  @   0 <= column < BERM_BRAKE_SPEEDS && speed <= sk_column_speed_of(velocity_max, column) &&
  @   \forall integer j; 0 <= j < column ==> sk_column_speed_of(velocity_max, j) < speed;
  @ logic integer sk_column_before(integer column) = column > 0 ? column - 1 : 0;
  @ // what of the rise between two columns belongs to way of width, rounded up
  @ logic integer sk_share_of(integer rise, integer way, integer width) = width > 0 ? sk_least((rise * way + width - 1) / width, rise) : rise;
  @ logic integer sk_chord_of(integer low, integer high, integer before, integer speed, integer at) =
  @   low + sk_share_of(high - low, speed - before, at - before);
  @ predicate sk_brake_entry{L}(berm_parameters *p, integer joint, integer row, integer speed, integer angle) =
  @   \exists integer column; sk_first_column(\at(p->velocity_max_urad_s[joint], L), speed, column) &&
  @     angle == sk_chord_of(\at(p->brake_angle_urad[joint][row][sk_column_before(column)], L), \at(p->brake_angle_urad[joint][row][column], L),
  @       sk_column_speed_of(\at(p->velocity_max_urad_s[joint], L), sk_column_before(column)), speed,
  @       sk_column_speed_of(\at(p->velocity_max_urad_s[joint], L), column));
  @ predicate sk_brake_row_fits{L}(berm_parameters *p, integer joint, integer row) =
  @   (\forall integer k; 0 <= k < BERM_BRAKE_SPEEDS ==> 0 <= \at(p->brake_angle_urad[joint][row][k], L) <= SK_BRAKE_ANGLE_MAX_URAD) &&
  @   (\forall integer k; 0 < k < BERM_BRAKE_SPEEDS ==>
  @     \at(p->brake_angle_urad[joint][row][k - 1], L) <= \at(p->brake_angle_urad[joint][row][k], L));
  @ predicate sk_brake_time_entry{L}(berm_parameters *p, integer joint, integer row, integer speed, integer time) =
  @   \exists integer column; sk_first_column(\at(p->velocity_max_urad_s[joint], L), speed, column) &&
  @     time == \at(p->brake_time_us[joint][row][column], L);
  @ predicate sk_brake_times_fit{L}(berm_parameters *p, integer joint, integer row) =
  @   \forall integer k; 0 <= k < BERM_BRAKE_SPEEDS ==> 0 <= \at(p->brake_time_us[joint][row][k], L) <= SK_BRAKE_TIME_MAX_US;
  @ // a faster joint never has the shorter stop angle
  @ lemma sk_column_monotone: \forall integer velocity_max, slow, fast, i, j;
  @   slow <= fast && sk_first_column(velocity_max, slow, i) && sk_first_column(velocity_max, fast, j) ==> i <= j;
  @
  @ logic integer sk_reach_time_of{L}(berm_parameters *p) =
  @   \at(p->state_latency_us, L) + \at(p->cycle_us, L) + \at(p->command_latency_us, L);
  @ predicate sk_times_fit{L}(berm_parameters *p) =
  @   0 <= \at(p->state_latency_us, L) <= SK_REACH_LATENCY_MAX_US && 0 <= \at(p->cycle_us, L) <= SK_REACH_LATENCY_MAX_US &&
  @   0 <= \at(p->command_latency_us, L) <= SK_REACH_LATENCY_MAX_US;
  @ predicate sk_limits_fit{L}(berm_parameters *p, integer joint) =
  @   0 <= \at(p->velocity_max_urad_s[joint], L) <= SK_REACH_SPEED_MAX_URAD_S &&
  @   0 < \at(p->acceleration_max_urad_s2[joint], L) <= SK_REACH_ACCELERATION_MAX_URAD_S2 &&
  @   0 <= \at(p->angle_error_urad[joint], L) <= SK_REACH_ERROR_MAX && 0 <= \at(p->velocity_error_urad_s[joint], L) <= SK_REACH_ERROR_MAX;
  @ predicate sk_commands_fit(integer mode, integer low, integer high) =
  @   mode == SK_REACH_ANY || (mode == SK_REACH_COMMANDED && -SK_REACH_SPEED_MAX_URAD_S <= low <= high <= SK_REACH_SPEED_MAX_URAD_S);
  @ predicate sk_measurement_fits(integer angle, integer velocity, integer fastest) =
  @   -SK_REACH_ANGLE_MAX_URAD <= angle <= SK_REACH_ANGLE_MAX_URAD && -SK_REACH_SPEED_MAX_URAD_S <= velocity <= SK_REACH_SPEED_MAX_URAD_S &&
  @   -fastest <= velocity <= fastest;
  @
  @ logic integer sk_per_million(integer n) = (n + 999999) / 1000000; // rounded up, n >= 0
  @ // the formulas above, in the direction in which velocity and command count positive
  @ logic integer sk_cap_of(integer mode, integer velocity, integer command, integer error, integer velocity_max) =
  @   mode == SK_REACH_ANY ? velocity_max : sk_least(sk_most(velocity + error, command) + error, velocity_max);
  @ logic integer sk_speed_of(integer start, integer cap, integer acceleration, integer time_us) =
  @   sk_least(start + sk_per_million(acceleration * time_us), cap);
  @ logic integer sk_gain_of(integer start, integer speed, integer acceleration, integer time_us) =
  @   sk_least(speed - start, acceleration * time_us / 1000000);
  @ logic integer sk_travel_of(integer speed, integer gain, integer acceleration, integer time_us) =
  @   sk_most(sk_per_million(speed * time_us) - gain * gain / (2 * acceleration), 0);
  @ predicate sk_extent_is{L}(berm_parameters *p, integer joint, integer row, integer start, integer speed, integer extent) =
  @   (speed <= 0 ==> extent == 0) &&
  @   (speed > 0 ==> \exists integer angle; 0 <= angle && sk_brake_entry{L}(p, joint, row, speed, angle) &&
  @     extent == angle + sk_travel_of(speed, sk_gain_of(start, speed, \at(p->acceleration_max_urad_s2[joint], L), sk_reach_time_of{L}(p)),
  @       \at(p->acceleration_max_urad_s2[joint], L), sk_reach_time_of{L}(p)));
  @ logic integer sk_side_cap{L}(berm_parameters *p, integer joint, integer mode, integer velocity, integer command) =
  @   sk_cap_of(mode, velocity, command, \at(p->velocity_error_urad_s[joint], L), \at(p->velocity_max_urad_s[joint], L));
  @ logic integer sk_side_start{L}(berm_parameters *p, integer joint, integer mode, integer velocity, integer command) =
  @   sk_least(velocity + \at(p->velocity_error_urad_s[joint], L), sk_side_cap{L}(p, joint, mode, velocity, command));
  @ logic integer sk_side_speed{L}(berm_parameters *p, integer joint, integer mode, integer velocity, integer command) =
  @   sk_speed_of(sk_side_start{L}(p, joint, mode, velocity, command), sk_side_cap{L}(p, joint, mode, velocity, command),
  @     \at(p->acceleration_max_urad_s2[joint], L), sk_reach_time_of{L}(p));
  @ predicate sk_side_extent_is{L}(berm_parameters *p, integer joint, integer row, integer mode, integer velocity, integer command,
  @     integer extent) =
  @   sk_extent_is{L}(p, joint, row, sk_side_start{L}(p, joint, mode, velocity, command), sk_side_speed{L}(p, joint, mode, velocity, command),
  @     extent);
  @
  @ predicate sk_joint_kept{A, B}(sk_reach_box *out, integer j) =
  @   \at(out->low_urad[j], A) == \at(out->low_urad[j], B) && \at(out->high_urad[j], A) == \at(out->high_urad[j], B) &&
  @   \at(out->speed_urad_s[j], A) == \at(out->speed_urad_s[j], B);
  @*/

/* Shared with the governor. */
/*@ requires 0 <= velocity_max_urad_s && 0 <= column < BERM_BRAKE_SPEEDS;
  @ assigns \nothing;
  @ ensures \result == sk_column_speed_of(velocity_max_urad_s, column);
  @ ensures \result <= velocity_max_urad_s;
  @*/
int32_t sk_column_speed(int32_t velocity_max_urad_s, int32_t column);

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_times_fit(p);
  @*/
bool sk_times_ok(const berm_parameters *p);

/*@ requires \valid_read(p) && 0 <= joint < SK_JOINTS;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_limits_fit(p, joint);
  @*/
bool sk_limits_ok(const berm_parameters *p, int32_t joint);

/* Row of the braking table for a reach: the first with brake_reach_mm[row] >= reach_mm, or -1 when there is none. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures range: -1 <= \result < BERM_BRAKE_REACHES;
  @ ensures covers: \result >= 0 ==> p->brake_reach_mm[\result] >= reach_mm;
  @ ensures first: \forall integer r; 0 <= r < BERM_BRAKE_REACHES && (\result < 0 || r < \result) ==> p->brake_reach_mm[r] < reach_mm;
  @*/
int32_t sk_brake_row(const berm_parameters *p, int32_t reach_mm);

/* Worst-case stop angle of joint for |speed|, row: on the chord from the column below the speed to the first at or above it, rounded up; -1 when the
 * speed is above the table, joint or row out of range, or the two entries out of range or falling. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures range: -1 <= \result <= SK_BRAKE_ANGLE_MAX_URAD;
  @ ensures total: 0 <= joint < SK_JOINTS && 0 <= row < BERM_BRAKE_REACHES && sk_brake_row_fits(p, joint, row) &&
  @   0 <= speed_urad_s <= p->velocity_max_urad_s[joint] ==> 0 <= \result;
  @ ensures entry: \result >= 0 ==> 0 <= joint < SK_JOINTS && 0 <= row < BERM_BRAKE_REACHES && sk_brake_entry(p, joint, row, speed_urad_s, \result);
  @ ensures within: \result >= 0 ==> speed_urad_s <= p->velocity_max_urad_s[joint];
  @*/
int32_t sk_brake_angle(const berm_parameters *p, int32_t joint, int32_t row, int32_t speed_urad_s);

/* The same of the time from obeying the stop to standstill, in us. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures range: -1 <= \result <= SK_BRAKE_TIME_MAX_US;
  @ ensures total: 0 <= joint < SK_JOINTS && 0 <= row < BERM_BRAKE_REACHES && sk_brake_times_fit(p, joint, row) &&
  @   0 <= speed_urad_s <= p->velocity_max_urad_s[joint] ==> 0 <= \result;
  @ ensures entry: \result >= 0 ==>
  @   0 <= joint < SK_JOINTS && 0 <= row < BERM_BRAKE_REACHES && sk_brake_time_entry(p, joint, row, speed_urad_s, \result);
  @ ensures within: \result >= 0 ==> speed_urad_s <= p->velocity_max_urad_s[joint];
  @*/
int32_t sk_brake_time(const berm_parameters *p, int32_t joint, int32_t row, int32_t speed_urad_s);

/* Interval of one joint into out->low/high/speed[joint]. Returns false, and changes nothing, when the speed is certainly above velocity_max (the
 * end of the braking table) or an input is out of its range (|angle| <= 10 rad, |velocity| and |commands| <= 5 rad/s, command_low <= command_high
 * in SK_REACH_COMMANDED; in SK_REACH_ANY the commands are not read). */
/*@ requires \valid_read(p) && \valid(out) && \separated(p, out);
  @ assigns out->low_urad[0 .. SK_JOINTS - 1], out->high_urad[0 .. SK_JOINTS - 1], out->speed_urad_s[0 .. SK_JOINTS - 1];
  @ ensures kept: \forall integer j; 0 <= j < SK_JOINTS && (\result == false || j != joint) ==> sk_joint_kept{Pre, Post}(out, j);
  @ ensures fits: \result == true ==> 0 <= joint < SK_JOINTS && sk_times_fit(p) && sk_limits_fit(p, joint) &&
  @   sk_commands_fit(mode, command_low_urad_s, command_high_urad_s) &&
  @   sk_measurement_fits(angle_urad, velocity_urad_s, p->velocity_max_urad_s[joint] + p->velocity_error_urad_s[joint]);
  @ ensures low: \result == true ==> sk_side_extent_is{Pre}(p, joint, row, mode, -velocity_urad_s, -command_low_urad_s,
  @   angle_urad - p->angle_error_urad[joint] - out->low_urad[joint]);
  @ ensures high: \result == true ==> sk_side_extent_is{Pre}(p, joint, row, mode, velocity_urad_s, command_high_urad_s,
  @   out->high_urad[joint] - angle_urad - p->angle_error_urad[joint]);
  @ ensures contains: \result == true ==>
  @   out->low_urad[joint] <= angle_urad - p->angle_error_urad[joint] && angle_urad + p->angle_error_urad[joint] <= out->high_urad[joint];
  @ ensures speed: \result == true ==> 0 <= out->speed_urad_s[joint] <= p->velocity_max_urad_s[joint] &&
  @   sk_side_speed(p, joint, mode, velocity_urad_s, command_high_urad_s) <= out->speed_urad_s[joint] &&
  @   sk_side_speed(p, joint, mode, -velocity_urad_s, -command_low_urad_s) <= out->speed_urad_s[joint];
  @*/
bool sk_reach_joint(const berm_parameters *p, int32_t joint, int32_t row, int32_t angle_urad, int32_t velocity_urad_s, int32_t mode,
                    int32_t command_low_urad_s, int32_t command_high_urad_s, sk_reach_box *out);

SK_END
#endif
