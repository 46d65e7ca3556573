/* Whether a joint's angle changes as its speed says. The two are read by sensors of their own; one that stands still, drifts or jumps while the other tells
 * the truth puts the reach box where the joint is not.
 *
 * Over a span of readings the way by the speeds is the sum of (v before + v now) / 2 times the time between. The angle's change may differ from it by
 *   2 angle errors (both ends);
 *   the speed's error e over the span;
 *   half of every change of the speed over the time in which it changed (it changed at some moment between two readings), and what it may have
 *   done besides within acceleration_max, a (t + latency) / 4 over t;
 *   what the readings' unknown ages, up to the state latency each, may shift: twice the latency times (first and last speed, all changes, 2 e).
 * More is a disagreement. A span ends after SK_AGREE_SPAN_US, and the next begins with its last reading. */
#ifndef SK_JOINT_AGREEMENT_H
#define SK_JOINT_AGREEMENT_H
#include "contract/berm_contract.h"
#include "motion_supervision.h"
#include "reach_box.h"
SK_BEGIN

#define SK_AGREE_SPAN_US 500000
#define SK_AGREE_GAP_MOST_US 100000         /* between two readings; after a longer one a span begins anew */
#define SK_AGREE_LATENCY_MOST_US 2000000
#define SK_AGREE_CHANGE_MOST 1000000000     /* urad/s; more change in a span is no motion, and counts as this */
#define SK_AGREE_RATE_MOST 200000000        /* urad/s */

/* A span of one joint's readings; way and allowance are twice what they name, in urad us / s. */
typedef struct sk_agreement {
  int64_t since_us, last_us; /* its first and newest reading; -1: none yet */
  int64_t way;               /* by the speeds */
  int64_t allowance;         /* by errors and changes of the speed */
  int64_t change_urad_s;     /* sum of the speed's changes */
  int32_t latency_us;        /* the most of any reading */
  int32_t first_angle_urad, first_velocity_urad_s, velocity_urad_s;
} sk_agreement;

/* Angle and speed of one joint, of one moment within the latency. */
typedef struct sk_agreement_reading {
  int64_t now_us;
  int32_t joint;
  int32_t angle_urad, velocity_urad_s;
  int32_t latency_us; /* their age at now_us, at most */
} sk_agreement_reading;

/*@ logic integer sk_size(integer a) = a < 0 ? -a : a;
  @ predicate sk_agreement_fits{L}(berm_parameters *p, sk_agreement_reading r) =
  @   0 <= r.joint < SK_JOINTS && sk_limits_fit{L}(p, r.joint) && 0 <= r.now_us <= SK_MOTION_NOW_MAX_US &&
  @   -SK_REACH_ANGLE_MAX_URAD <= r.angle_urad <= SK_REACH_ANGLE_MAX_URAD &&
  @   -SK_REACH_SPEED_MAX_URAD_S <= r.velocity_urad_s <= SK_REACH_SPEED_MAX_URAD_S && 0 <= r.latency_us <= SK_AGREE_LATENCY_MOST_US;
  @ predicate sk_span_fits{L}(sk_agreement *s, integer longest) =
  @   0 <= \at(s->since_us, L) <= \at(s->last_us, L) <= SK_MOTION_NOW_MAX_US && \at(s->last_us, L) - \at(s->since_us, L) <= longest &&
  @   \at(s->way, L) <= 2 * SK_REACH_SPEED_MAX_URAD_S * (\at(s->last_us, L) - \at(s->since_us, L)) &&
  @   -2 * SK_REACH_SPEED_MAX_URAD_S * (\at(s->last_us, L) - \at(s->since_us, L)) <= \at(s->way, L) &&
  @   0 <= \at(s->allowance, L) <= SK_AGREE_RATE_MOST * (\at(s->last_us, L) - \at(s->since_us, L)) &&
  @   0 <= \at(s->change_urad_s, L) <= SK_AGREE_CHANGE_MOST && 0 <= \at(s->latency_us, L) <= SK_AGREE_LATENCY_MOST_US &&
  @   -SK_REACH_ANGLE_MAX_URAD <= \at(s->first_angle_urad, L) <= SK_REACH_ANGLE_MAX_URAD &&
  @   -SK_REACH_SPEED_MAX_URAD_S <= \at(s->first_velocity_urad_s, L) <= SK_REACH_SPEED_MAX_URAD_S &&
  @   -SK_REACH_SPEED_MAX_URAD_S <= \at(s->velocity_urad_s, L) <= SK_REACH_SPEED_MAX_URAD_S;
  @ predicate sk_agreement_valid{L}(sk_agreement *s) = \at(s->since_us, L) == -1 || sk_span_fits{L}(s, SK_AGREE_SPAN_US);
  @ predicate sk_agreement_goes_on{L}(sk_agreement *s, integer now) = 0 <= \at(s->since_us, L) &&
  @   \at(s->last_us, L) < now <= \at(s->last_us, L) + SK_AGREE_GAP_MOST_US;
  @
  @ // of the span with a reading that comes after the time: way, allowance, changes and latency
  @ logic integer sk_way_with{L}(sk_agreement *s, integer velocity, integer time) = \at(s->way, L) + (\at(s->velocity_urad_s, L) + velocity) * time;
  @ logic integer sk_latency_with{L}(sk_agreement *s, integer latency) = sk_most(\at(s->latency_us, L), latency);
  @ logic integer sk_agreement_rate{L}(berm_parameters *p, integer joint, integer change, integer latency, integer time) =
  @   change + 2 * \at(p->velocity_error_urad_s[joint], L) + \at(p->acceleration_max_urad_s2[joint], L) * (time + latency) / 2000000 + 1;
  @ logic integer sk_allowance_with{L}(sk_agreement *s, berm_parameters *p, integer joint, integer velocity, integer latency, integer time) =
  @   \at(s->allowance, L) +
  @   sk_agreement_rate{L}(p, joint, sk_size(velocity - \at(s->velocity_urad_s, L)), sk_latency_with{L}(s, latency), time) * time;
  @ logic integer sk_change_with{L}(sk_agreement *s, integer velocity) =
  @   sk_least(SK_AGREE_CHANGE_MOST, \at(s->change_urad_s, L) + sk_size(velocity - \at(s->velocity_urad_s, L)));
  @ // twice by how much the change of the angle may differ from the way
  @ logic integer sk_may_differ(integer angle_error, integer velocity_error, integer allowance, integer latency, integer first, integer velocity,
  @     integer change) =
  @   4000000 * angle_error + allowance + 4 * (latency * (sk_size(first) + sk_size(velocity) + change + 2 * velocity_error));
  @ predicate sk_differs_with{L}(sk_agreement *s, berm_parameters *p, sk_agreement_reading r, integer time) =
  @   sk_size(2000000 * (r.angle_urad - \at(s->first_angle_urad, L)) - sk_way_with{L}(s, r.velocity_urad_s, time)) >
  @   sk_may_differ(\at(p->angle_error_urad[r.joint], L), \at(p->velocity_error_urad_s[r.joint], L),
  @     sk_allowance_with{L}(s, p, r.joint, r.velocity_urad_s, r.latency_us, time), sk_latency_with{L}(s, r.latency_us),
  @     \at(s->first_velocity_urad_s, L), r.velocity_urad_s, sk_change_with{L}(s, r.velocity_urad_s));
  @ predicate sk_disagrees{L}(sk_agreement *s, berm_parameters *p, sk_agreement_reading r) = sk_agreement_goes_on{L}(s, r.now_us) &&
  @   \exists integer time; time == r.now_us - \at(s->last_us, L) && sk_differs_with{L}(s, p, r, time);
  @ predicate sk_span_with{A, B}(sk_agreement *s, berm_parameters *p, integer joint, integer velocity, integer latency, integer time) =
  @   \at(s->since_us, B) == \at(s->since_us, A) && \at(s->last_us, B) == \at(s->last_us, A) + time &&
  @   \at(s->way, B) == sk_way_with{A}(s, velocity, time) && \at(s->allowance, B) == sk_allowance_with{A}(s, p, joint, velocity, latency, time) &&
  @   \at(s->change_urad_s, B) == sk_change_with{A}(s, velocity) && \at(s->latency_us, B) == sk_latency_with{A}(s, latency) &&
  @   \at(s->first_angle_urad, B) == \at(s->first_angle_urad, A) && \at(s->first_velocity_urad_s, B) == \at(s->first_velocity_urad_s, A) &&
  @   \at(s->velocity_urad_s, B) == velocity;
  @ predicate sk_agreement_begins_with{L}(sk_agreement *s, sk_agreement_reading r) = \at(s->since_us, L) == r.now_us &&
  @   \at(s->last_us, L) == r.now_us && \at(s->way, L) == 0 && \at(s->allowance, L) == 0 && \at(s->change_urad_s, L) == 0 &&
  @   \at(s->latency_us, L) == r.latency_us && \at(s->first_angle_urad, L) == r.angle_urad &&
  @   \at(s->first_velocity_urad_s, L) == r.velocity_urad_s && \at(s->velocity_urad_s, L) == r.velocity_urad_s;
  @ predicate sk_agreement_kept{A, B}(sk_agreement *s) = \at(*s, A) == \at(*s, B);
  @*/

/* Nothing is known: a span begins with the next reading. */
/*@ requires \valid(s);
  @ assigns *s;
  @ ensures valid: sk_agreement_valid(s);
  @ ensures none: s->since_us == -1;
  @*/
void sk_agreement_begin(sk_agreement *s);

/* Judges one reading: BERM_STOP_NONE, BERM_STOP_STATE_FRAME for a disagreement, with which a span begins anew, or BERM_STOP_INTERNAL, and nothing changed,
 * where reading or parameters are out of their range. */
/*@ requires \valid(s) && \valid_read(p) && \separated(s, p) && sk_agreement_valid(s);
  @ assigns *s;
  @ ensures results: \result == BERM_STOP_NONE || \result == BERM_STOP_STATE_FRAME || \result == BERM_STOP_INTERNAL;
  @ ensures fits: \result == BERM_STOP_INTERNAL <==> !sk_agreement_fits(p, r);
  @ ensures valid: sk_agreement_valid(s);
  @ ensures kept: \result == BERM_STOP_INTERNAL ==> sk_agreement_kept{Pre, Post}(s);
  @ ensures disagrees: \result == BERM_STOP_STATE_FRAME ==> sk_disagrees{Pre}(s, p, r);
  @ ensures agrees: \result == BERM_STOP_NONE ==> !sk_disagrees{Pre}(s, p, r);
  @ ensures anew: \result != BERM_STOP_INTERNAL && (\result == BERM_STOP_STATE_FRAME || !sk_agreement_goes_on{Pre}(s, r.now_us) ||
  @   r.now_us - \old(s->since_us) >= SK_AGREE_SPAN_US) ==> sk_agreement_begins_with(s, r);
  @ ensures on: \result == BERM_STOP_NONE && sk_agreement_goes_on{Pre}(s, r.now_us) && r.now_us - \old(s->since_us) < SK_AGREE_SPAN_US ==>
  @   sk_span_with{Pre, Post}(s, p, r.joint, r.velocity_urad_s, r.latency_us, r.now_us - \old(s->last_us));
  @*/
int32_t sk_agreement_step(sk_agreement *s, const berm_parameters *p, sk_agreement_reading r);

SK_END
#endif
