/* Governor: the speed that a joint may be commanded, from the room that is clear ahead of it. It only ever lowers a command; that motion is
 * permitted at all is decided by the clearance of the reach box. */
#ifndef SK_GOVERNOR_H
#define SK_GOVERNOR_H
#include "reach_box.h"
SK_BEGIN

#define SK_GOVERNOR_LEVELS (4 * (BERM_BRAKE_SPEEDS - 1) + 1) /* four to a column of the braking table; the last is unlimited */
#define SK_GOVERNOR_COLUMN 4                 /* levels to a column */
#define SK_COMMAND_STEP_URAD_S 500           /* commands on the bus have this step */

/*@ logic integer sk_next_level(integer level) = level + 1 < SK_GOVERNOR_LEVELS ? level + 1 : SK_GOVERNOR_LEVELS - 1;
  @ logic integer sk_level_speed_of(integer velocity_max, integer level) = velocity_max * level / (SK_GOVERNOR_LEVELS - 1); // rounded down
  @ logic integer sk_twice_way(integer time_us, integer speed) = sk_per_million(2 * time_us * speed);
  @ // room that a level needs ahead: twice the latency's way and the stop angle, of the next faster level
  @ predicate sk_room_for{L}(berm_parameters *p, integer joint, integer row, integer speed, integer room) =
  @   \exists integer angle; 0 <= angle && sk_brake_entry{L}(p, joint, row, speed, angle) &&
  @     room == \at(p->angle_error_urad[joint], L) + angle + sk_twice_way(sk_reach_time_of{L}(p), speed);
  @ predicate sk_room_is{L}(berm_parameters *p, integer joint, integer row, integer level, integer room) =
  @   sk_room_for{L}(p, joint, row, sk_level_speed_of(\at(p->velocity_max_urad_s[joint], L), sk_next_level(level)), room);
  @ predicate sk_level_clear{L}(berm_parameters *p, integer joint, integer row, integer level, integer clear) =
  @   \exists integer room; sk_room_is{L}(p, joint, row, level, room) && room <= clear;
  @ predicate sk_governor_fits{L}(berm_parameters *p, integer joint, integer row) = 0 <= joint < SK_JOINTS && 0 <= row < BERM_BRAKE_REACHES &&
  @   sk_times_fit{L}(p) && sk_limits_fit{L}(p, joint) && sk_brake_row_fits{L}(p, joint, row);
  @
  @ // from the next cycle's order to standstill
  @ predicate sk_stops_in{L}(berm_parameters *p, integer joint, integer row, integer speed, integer time) =
  @   \exists integer brake; sk_brake_time_entry{L}(p, joint, row, speed, brake) &&
  @     time == \at(p->cycle_us, L) + \at(p->command_latency_us, L) + brake;
  @ // a level's stopping time: that of the next faster one; beyond the first column, that of a column more, in which the joint can be slowed down
  @ predicate sk_level_time_is{L}(berm_parameters *p, integer joint, integer row, integer level, integer time) =
  @   \exists integer next, column;
  @     sk_stops_in{L}(p, joint, row, sk_level_speed_of(\at(p->velocity_max_urad_s[joint], L), sk_next_level(level)), next) &&
  @     sk_stops_in{L}(p, joint, row, sk_level_speed_of(\at(p->velocity_max_urad_s[joint], L), SK_GOVERNOR_COLUMN), column) &&
  @     time == next + (sk_next_level(level) > SK_GOVERNOR_COLUMN ? column : 0);
  @ predicate sk_time_fits{L}(berm_parameters *p, integer joint, integer row) = 0 <= joint < SK_JOINTS && 0 <= row < BERM_BRAKE_REACHES &&
  @   sk_times_fit{L}(p) && sk_limits_fit{L}(p, joint) && sk_brake_times_fit{L}(p, joint, row);
  @ predicate sk_level_in_time{L}(berm_parameters *p, integer joint, integer row, integer level, integer stop) =
  @   \exists integer time; sk_level_time_is{L}(p, joint, row, level, time) && time <= stop;
  @*/

/* Room (urad, from the measured angle) that the level needs, so that a joint told to slow down when its room falls below it need not be
 * stopped: the reach box of the next level and one latency more. -1 where an argument or parameter is out of its range. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures invalid: \result == -1 <==> !(0 <= level < SK_GOVERNOR_LEVELS && sk_governor_fits(p, joint, row));
  @ ensures room: \result != -1 ==> sk_room_is(p, joint, row, level, \result) && 0 <= \result;
  @*/
int64_t sk_governor_room(const berm_parameters *p, int32_t joint, int32_t row, int32_t level);

/* The highest level all of whose lower levels, and itself, find their room; 0 needs none. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures range: 0 <= \result < SK_GOVERNOR_LEVELS;
  @ ensures found: \forall integer k; 1 <= k <= \result ==> sk_governor_fits(p, joint, row) && sk_level_clear(p, joint, row, k, clear_urad);
  @ ensures highest: \result + 1 < SK_GOVERNOR_LEVELS && sk_governor_fits(p, joint, row) ==>
  @   \exists integer room; sk_room_is(p, joint, row, \result + 1, room) && room > clear_urad;
  @*/
int32_t sk_governor_level(const berm_parameters *p, int32_t joint, int32_t row, int64_t clear_urad);

/* Speed (urad/s) that a level permits: its share of velocity_max, never less than the creep velocity. 0 where level, joint or parameters are out
 * of range. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures range: 0 <= \result;
  @ ensures last: 0 <= joint < SK_JOINTS && level == SK_GOVERNOR_LEVELS - 1 && sk_limits_fit(p, joint) ==> \result == p->velocity_max_urad_s[joint];
  @ ensures share: 0 <= joint < SK_JOINTS && 0 <= level < SK_GOVERNOR_LEVELS - 1 && sk_limits_fit(p, joint) ==> \result == sk_most(
  @   sk_level_speed_of(p->velocity_max_urad_s[joint], level), p->creep_velocity_urad_s[joint]);
  @ ensures invalid: !(0 <= joint < SK_JOINTS && 0 <= level < SK_GOVERNOR_LEVELS) || !sk_limits_fit(p, joint) ==> \result == 0;
  @*/
int32_t sk_governor_speed(const berm_parameters *p, int32_t joint, int32_t level);

/* Time (us) in which the joint stands, from any speed up to this, when a stop is ordered in the next cycle; -1 where speed, joint, row, latencies or
 * the braking table's entry are out of range. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures range: -1 <= \result <= SK_BRAKE_TIME_MAX_US + 2 * SK_REACH_LATENCY_MAX_US;
  @ ensures total: sk_time_fits(p, joint, row) && 0 <= speed_urad_s <= p->velocity_max_urad_s[joint] ==> 0 <= \result;
  @ ensures time: 0 <= \result ==> 0 <= joint < SK_JOINTS && 0 <= row < BERM_BRAKE_REACHES && sk_times_fit(p) &&
  @   sk_stops_in(p, joint, row, speed_urad_s, \result);
  @*/
int64_t sk_governor_stop_time(const berm_parameters *p, int32_t joint, int32_t row, int32_t speed_urad_s);

/* Stopping time (us) that a level needs to be permitted; -1 where an argument or parameter is out of its range. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures range: -1 <= \result;
  @ ensures total: sk_time_fits(p, joint, row) && 0 <= level < SK_GOVERNOR_LEVELS ==> 0 <= \result;
  @ ensures time: 0 <= \result ==> 0 <= level < SK_GOVERNOR_LEVELS && 0 <= joint < SK_JOINTS && 0 <= row < BERM_BRAKE_REACHES &&
  @   sk_level_time_is(p, joint, row, level, \result);
  @*/
int64_t sk_governor_level_time(const berm_parameters *p, int32_t joint, int32_t row, int32_t level);

/* The highest level for which, and for all below it, the stopping time is enough; 0, at which the joint may not move, needs none. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures range: 0 <= \result < SK_GOVERNOR_LEVELS;
  @ ensures in_time: \forall integer k; 1 <= k <= \result ==> sk_level_in_time(p, joint, row, k, stop_us);
  @ ensures highest: \result + 1 < SK_GOVERNOR_LEVELS && sk_time_fits(p, joint, row) ==>
  @   \exists integer time; sk_level_time_is(p, joint, row, \result + 1, time) && time > stop_us;
  @*/
int32_t sk_governor_timed_level(const berm_parameters *p, int32_t joint, int32_t row, int64_t stop_us);

/* Speed (urad/s) that a level permits by time: its share of velocity_max; 0 where level, joint or parameters are out of range. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures share: 0 <= joint < SK_JOINTS && 0 <= level < SK_GOVERNOR_LEVELS && sk_limits_fit(p, joint) ==>
  @   \result == sk_level_speed_of(p->velocity_max_urad_s[joint], level);
  @ ensures range: 0 <= \result;
  @ ensures invalid: !(0 <= joint < SK_JOINTS && 0 <= level < SK_GOVERNOR_LEVELS) || !sk_limits_fit(p, joint) ==> \result == 0;
  @*/
int32_t sk_governor_timed_speed(const berm_parameters *p, int32_t joint, int32_t level);

/* The request cut to low..high (low <= 0 <= high, else 0) and to the bus's step towards zero: what is sent is never more than was checked. */
/*@ assigns \nothing;
  @ ensures never_more: sk_least(0, requested_urad_s) <= \result <= sk_most(0, requested_urad_s);
  @ ensures within: low_urad_s <= 0 <= high_urad_s ==> low_urad_s <= \result <= high_urad_s;
  @ ensures nothing: !(low_urad_s <= 0 <= high_urad_s) ==> \result == 0;
  @ ensures step: \exists integer k; \result == SK_COMMAND_STEP_URAD_S * k;
  @ ensures whole: low_urad_s <= requested_urad_s <= high_urad_s && low_urad_s <= 0 <= high_urad_s ==>
  @   requested_urad_s - SK_COMMAND_STEP_URAD_S < \result < requested_urad_s + SK_COMMAND_STEP_URAD_S;
  @*/
int32_t sk_governor_clamp(int32_t requested_urad_s, int32_t low_urad_s, int32_t high_urad_s);

SK_END
#endif
