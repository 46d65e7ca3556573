/* Motion supervision: whether a joint does what it was told. The reach box assumes (1) that a joint's speed leaves the range of its measured
 * speed and of the commands by no more than the speed's error, and (2) that a joint that is told to stop does so as the braking table says;
 * here both are watched, for each joint and direction, at every new reading of its angle and speed.
 *
 * In a direction, with e the speed's error and c the largest command that may be in force when the reading was taken, or zero (the commands
 * under way reach back by the state latency too, so nothing is allowed for it once more):
 *   ceiling: a joint may be faster than c + 2 e (obeyed with error e, read with error e) only while it loses an earlier speed: then no reading
 *     is above an earlier one since by more than 3 e (both read with error e, the assumption's e once). Above: UNCOMMANDED.
 *   bound: while c is zero, every reading (angle, speed) since says where and when the joint stands at the latest: angle + 2 angle errors +
 *     braking angle (speed + e); time of the reading + state latency + braking time (speed + e), both of the row of the farthest reach since.
 *     The least of them holds. Beyond the angle, or beyond the time and faster than standstill (2 e, if that is more): BRAKING.
 * The time is the table's own, and runs, like the angle, from the moment from which the stop is obeyed to standstill. When c is zero every
 * other command was replaced at the joint before the reading was taken: the stop is being obeyed, and no latency's way is added.
 *
 * Not watched: how fast a joint comes down to a lower command that is not zero. The table measures stops alone and says nothing of that; the
 * reach box needs nothing of it, as it takes the measured speed. */
#ifndef SK_MOTION_SUPERVISION_H
#define SK_MOTION_SUPERVISION_H
#include "contract/berm_contract.h"
#include "reach_box.h"
SK_BEGIN

#define SK_MOTION_NOW_MAX_US 1000000000000000000 /* 30,000 years */
#define SK_MOTION_NO_CEILING SK_REACH_SPEED_MAX_URAD_S

/* One direction of one joint. */
typedef struct sk_motion_side {
  int64_t limit_urad;     /* with bound: farthest angle, counted positive in this direction */
  int64_t deadline_us;    /* with bound: the joint stands after this */
  int32_t ceiling_urad_s; /* most that the next reading may be, unless a command allows more */
  int32_t row;            /* with bound: of the farthest reach since */
  bool bound;             /* no command asks for this direction, and limit and deadline are set */
} sk_motion_side;

typedef struct sk_motion_joint {
  sk_motion_side up, down;
} sk_motion_joint;

/* A reading of one joint; of a direction of it, with angle, velocity and command counted positive in that direction. */
typedef struct sk_motion_reading {
  int64_t now_us;
  int32_t joint;
  int32_t row; /* of the braking table, for the farthest reach under the commands */
  int32_t angle_urad, velocity_urad_s;
  int32_t command_urad_s; /* the largest that may be in force; not positive: none asks for this direction */
} sk_motion_reading;

/*@ logic integer sk_motion_follow{L}(berm_parameters *p, integer joint, integer command) =
  @   sk_most(command, 0) + 2 * \at(p->velocity_error_urad_s[joint], L);
  @ logic integer sk_motion_rest{L}(berm_parameters *p, integer joint) =
  @   sk_most(\at(p->standstill_urad_s, L), 2 * \at(p->velocity_error_urad_s[joint], L));
  @ // the speed from which the joint brakes
  @ logic integer sk_motion_speed{L}(berm_parameters *p, integer joint, integer velocity) =
  @   sk_least(velocity + \at(p->velocity_error_urad_s[joint], L), \at(p->velocity_max_urad_s[joint], L));
  @ logic integer sk_motion_ceiling{L}(berm_parameters *p, integer joint, integer velocity, integer command, integer before) =
  @   sk_most(sk_motion_follow{L}(p, joint, command), sk_least(before, velocity + 3 * \at(p->velocity_error_urad_s[joint], L)));
  @ predicate sk_motion_fits{L}(berm_parameters *p, sk_motion_reading r) =
  @   0 <= r.joint < SK_JOINTS && 0 <= r.row < BERM_BRAKE_REACHES && sk_times_fit{L}(p) && sk_limits_fit{L}(p, r.joint) &&
  @   0 <= \at(p->standstill_urad_s, L) <= SK_REACH_SPEED_MAX_URAD_S &&
  @   -SK_REACH_ANGLE_MAX_URAD <= r.angle_urad <= SK_REACH_ANGLE_MAX_URAD &&
  @   -SK_REACH_SPEED_MAX_URAD_S <= r.velocity_urad_s <= SK_REACH_SPEED_MAX_URAD_S &&
  @   -SK_REACH_SPEED_MAX_URAD_S <= r.command_urad_s <= SK_REACH_SPEED_MAX_URAD_S && 0 <= r.now_us <= SK_MOTION_NOW_MAX_US;
  @ predicate sk_motion_limit_is{L}(berm_parameters *p, integer joint, integer row, integer angle, integer velocity, integer limit) =
  @   \exists integer stop; sk_brake_entry{L}(p, joint, row, sk_motion_speed{L}(p, joint, velocity), stop) &&
  @     limit == angle + 2 * \at(p->angle_error_urad[joint], L) + stop;
  @ predicate sk_motion_deadline_is{L}(berm_parameters *p, integer joint, integer row, integer now, integer velocity, integer deadline) =
  @   \exists integer time; sk_brake_time_entry{L}(p, joint, row, sk_motion_speed{L}(p, joint, velocity), time) &&
  @     deadline == now + \at(p->state_latency_us, L) + time;
  @
  @ // faster than told, and not from an earlier speed
  @ predicate sk_motion_uncommanded{L}(sk_motion_side *s, berm_parameters *p, integer joint, integer velocity, integer command) =
  @   velocity > sk_most(sk_motion_follow{L}(p, joint, command), \at(s->ceiling_urad_s, L));
  @ predicate sk_motion_goes_on{L}(sk_motion_side *s, integer row, integer command) =
  @   command <= 0 && \at(s->bound, L) == true && row <= \at(s->row, L);
  @ // beyond where, or moving beyond when, it stands by the table
  @ predicate sk_motion_overrun{L}(sk_motion_side *s, berm_parameters *p, integer joint, integer row, integer angle, integer velocity,
  @     integer command, integer now) = sk_motion_goes_on{L}(s, row, command) &&
  @   (angle > \at(s->limit_urad, L) || (now > \at(s->deadline_us, L) && velocity > sk_motion_rest{L}(p, joint)));
  @ predicate sk_motion_wrong{L}(sk_motion_side *s, berm_parameters *p, integer joint, integer row, integer angle, integer velocity,
  @     integer command, integer now) =
  @   sk_motion_uncommanded{L}(s, p, joint, velocity, command) || sk_motion_overrun{L}(s, p, joint, row, angle, velocity, command, now);
  @ predicate sk_motion_side_kept{A, B}(sk_motion_side *s) =
  @   \at(s->limit_urad, A) == \at(s->limit_urad, B) && \at(s->deadline_us, A) == \at(s->deadline_us, B) &&
  @   \at(s->ceiling_urad_s, A) == \at(s->ceiling_urad_s, B) && \at(s->row, A) == \at(s->row, B) && \at(s->bound, A) == \at(s->bound, B);
  @*/

/* Nothing is known of how the joint moved: supervision begins with the next reading. */
/*@ requires \valid(s);
  @ assigns *s;
  @ ensures s->up.bound == false && s->down.bound == false;
  @ ensures s->up.ceiling_urad_s == SK_MOTION_NO_CEILING && s->down.ceiling_urad_s == SK_MOTION_NO_CEILING;
  @*/
void sk_motion_begin(sk_motion_joint *s);

/* One direction: BERM_STOP_NONE, BERM_STOP_UNCOMMANDED, BERM_STOP_BRAKING; BERM_STOP_INTERNAL, and nothing changed, where reading, parameters or
 * the table's entry are out of their range. After BRAKING the bound begins anew, so that a joint that then stands can be reset. */
/*@ requires \valid(s) && \valid_read(p) && \separated(s, p);
  @ assigns *s;
  @ ensures results: \result == BERM_STOP_NONE || \result == BERM_STOP_UNCOMMANDED || \result == BERM_STOP_BRAKING || \result == BERM_STOP_INTERNAL;
  @ ensures fits: \result != BERM_STOP_INTERNAL ==> sk_motion_fits(p, r);
  @ ensures kept: \result == BERM_STOP_INTERNAL ==> sk_motion_side_kept{Pre, Post}(s);
  @ ensures uncommanded: \result != BERM_STOP_INTERNAL ==>
  @   (\result == BERM_STOP_UNCOMMANDED <==> sk_motion_uncommanded{Pre}(s, p, r.joint, r.velocity_urad_s, r.command_urad_s));
  @ ensures braking: \result != BERM_STOP_INTERNAL && \result != BERM_STOP_UNCOMMANDED ==> (\result == BERM_STOP_BRAKING <==>
  @   sk_motion_overrun{Pre}(s, p, r.joint, r.row, r.angle_urad, r.velocity_urad_s, r.command_urad_s, r.now_us));
  @ ensures ceiling: \result != BERM_STOP_INTERNAL ==>
  @   s->ceiling_urad_s == sk_motion_ceiling(p, r.joint, r.velocity_urad_s, r.command_urad_s, \old(s->ceiling_urad_s));
  @ ensures bound: \result != BERM_STOP_INTERNAL ==> (s->bound == true <==> r.command_urad_s <= 0);
  @ ensures row: \result != BERM_STOP_INTERNAL && s->bound == true ==>
  @   s->row == (\old(s->bound) == true && r.row <= \old(s->row) ? \old(s->row) : r.row);
  @ ensures limit: \result != BERM_STOP_INTERNAL && s->bound == true ==> \exists integer limit;
  @   sk_motion_limit_is{Pre}(p, r.joint, s->row, r.angle_urad, r.velocity_urad_s, limit) && s->limit_urad ==
  @     (\old(s->bound) == true && r.row <= \old(s->row) && \result != BERM_STOP_BRAKING ? sk_least(\old(s->limit_urad), limit) : limit);
  @ ensures deadline: \result != BERM_STOP_INTERNAL && s->bound == true ==> \exists integer deadline;
  @   sk_motion_deadline_is{Pre}(p, r.joint, s->row, r.now_us, r.velocity_urad_s, deadline) && s->deadline_us ==
  @     (\old(s->bound) == true && r.row <= \old(s->row) && \result != BERM_STOP_BRAKING ? sk_least(\old(s->deadline_us), deadline) : deadline);
  @*/
int32_t sk_motion_side_step(sk_motion_side *s, const berm_parameters *p, sk_motion_reading r);

/* Both directions: the reading as measured, its command the highest and command_low_urad_s the lowest that may be in force. Results as above. */
/*@ requires \valid(s) && \valid_read(p) && \separated(s, p);
  @ assigns *s;
  @ ensures results: \result == BERM_STOP_NONE || \result == BERM_STOP_UNCOMMANDED || \result == BERM_STOP_BRAKING || \result == BERM_STOP_INTERNAL;
  @ ensures fits: \result != BERM_STOP_INTERNAL ==> sk_motion_fits(p, r);
  @ ensures right: \result == BERM_STOP_NONE ==>
  @   !sk_motion_wrong{Pre}(&s->up, p, r.joint, r.row, r.angle_urad, r.velocity_urad_s, r.command_urad_s, r.now_us) &&
  @   !sk_motion_wrong{Pre}(&s->down, p, r.joint, r.row, -r.angle_urad, -r.velocity_urad_s, -command_low_urad_s, r.now_us);
  @ ensures wrong: \result == BERM_STOP_UNCOMMANDED || \result == BERM_STOP_BRAKING ==>
  @   sk_motion_wrong{Pre}(&s->up, p, r.joint, r.row, r.angle_urad, r.velocity_urad_s, r.command_urad_s, r.now_us) ||
  @   sk_motion_wrong{Pre}(&s->down, p, r.joint, r.row, -r.angle_urad, -r.velocity_urad_s, -command_low_urad_s, r.now_us);
  @*/
int32_t sk_motion_step(sk_motion_joint *s, const berm_parameters *p, sk_motion_reading r, int32_t command_low_urad_s);

SK_END
#endif
