#include "joint_agreement.h"

#include "least_most.h"

/*@ lemma sk_grows: \forall integer a, b, c; 0 <= c && a <= b ==> a * c <= b * c;
  @*/

/*@ requires -INT64_MAX <= a;
  @ assigns \nothing;
  @ ensures \result == sk_size(a);
  @*/
static inline int64_t sk_size_of(int64_t a)
{
  return a < 0 ? -a : a;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_agreement_fits(p, r);
  @*/
static bool sk_agreement_ok(const berm_parameters *p, sk_agreement_reading r)
{
  if (r.joint < 0 || r.joint >= SK_JOINTS || !sk_limits_ok(p, r.joint)) { return false; }
  if (r.now_us < 0 || r.now_us > SK_MOTION_NOW_MAX_US) { return false; }
  if (r.angle_urad < -SK_REACH_ANGLE_MAX_URAD || r.angle_urad > SK_REACH_ANGLE_MAX_URAD) { return false; }
  if (r.velocity_urad_s < -SK_REACH_SPEED_MAX_URAD_S || r.velocity_urad_s > SK_REACH_SPEED_MAX_URAD_S) { return false; }
  return r.latency_us >= 0 && r.latency_us <= SK_AGREE_LATENCY_MOST_US;
}

/*@ requires \valid(s) && 0 <= r.now_us <= SK_MOTION_NOW_MAX_US && 0 <= r.latency_us <= SK_AGREE_LATENCY_MOST_US &&
  @   sk_size(r.angle_urad) <= SK_REACH_ANGLE_MAX_URAD && sk_size(r.velocity_urad_s) <= SK_REACH_SPEED_MAX_URAD_S;
  @ assigns *s;
  @ ensures valid: sk_agreement_valid(s);
  @ ensures begins: sk_agreement_begins_with(s, r);
  @*/
static void sk_agreement_begin_with(sk_agreement *s, sk_agreement_reading r)
{
  s->since_us = r.now_us;
  s->last_us = r.now_us;
  s->way = 0;
  s->allowance = 0;
  s->change_urad_s = 0;
  s->latency_us = r.latency_us;
  s->first_angle_urad = r.angle_urad;
  s->first_velocity_urad_s = r.velocity_urad_s;
  s->velocity_urad_s = r.velocity_urad_s;
}

/*@ requires 0 <= time_us <= SK_AGREE_LATENCY_MOST_US && 0 <= most <= 2 * SK_AGREE_CHANGE_MOST && -most <= speed <= most;
  @ assigns \nothing;
  @ ensures way: \result == speed * time_us;
  @ ensures most: \result <= most * time_us;
  @ ensures least: -most * time_us <= \result;
  @ ensures ahead: 0 <= speed ==> 0 <= \result;
  @*/
static int64_t sk_way_of(int64_t speed, int64_t time_us, int64_t most)
{
  /*@ assert ahead: speed * time_us <= most * time_us; */
  /*@ assert back: -most * time_us <= speed * time_us; */
  /*@ assert most_of_all: most * time_us <= 2 * SK_AGREE_CHANGE_MOST * time_us; */
  (void)most;
  return speed * time_us;
}

/*@ requires \valid_read(p) && 0 <= joint < SK_JOINTS && sk_limits_fit(p, joint) && 0 <= time_us <= SK_AGREE_GAP_MOST_US &&
  @   0 <= latency_us <= SK_AGREE_LATENCY_MOST_US && 0 <= change_urad_s <= 2 * SK_REACH_SPEED_MAX_URAD_S;
  @ assigns \nothing;
  @ ensures rate: \result == sk_agreement_rate(p, joint, change_urad_s, latency_us, time_us);
  @ ensures range: 0 <= \result <= SK_AGREE_RATE_MOST;
  @*/
static int64_t sk_agreement_rate_of(const berm_parameters *p, int32_t joint, int64_t change_urad_s, int32_t latency_us, int64_t time_us)
{
  int64_t acceleration = p->acceleration_max_urad_s2[joint];
  int64_t time = time_us + latency_us;
  /*@ assert faster: acceleration * time <= SK_REACH_ACCELERATION_MAX_URAD_S2 * time; */
  /*@ assert not_slower: 0 <= acceleration * time; */
  return change_urad_s + 2 * (int64_t)p->velocity_error_urad_s[joint] + acceleration * time / 2000000 + 1;
}

/*@ requires \valid(s) && \valid_read(p) && \separated(s, p) && 0 <= joint < SK_JOINTS && sk_limits_fit(p, joint) && sk_span_fits(s, SK_AGREE_SPAN_US) &&
  @   0 < time_us <= SK_AGREE_GAP_MOST_US && s->last_us + time_us <= SK_MOTION_NOW_MAX_US && 0 <= latency_us <= SK_AGREE_LATENCY_MOST_US &&
  @   -SK_REACH_SPEED_MAX_URAD_S <= velocity_urad_s <= SK_REACH_SPEED_MAX_URAD_S;
  @ assigns *s;
  @ ensures fits: sk_span_fits(s, SK_AGREE_SPAN_US + SK_AGREE_GAP_MOST_US);
  @ ensures with: sk_span_with{Pre, Post}(s, p, joint, velocity_urad_s, latency_us, time_us);
  @*/
static void sk_agreement_extend(sk_agreement *s, const berm_parameters *p, int32_t joint, int32_t velocity_urad_s, int32_t latency_us, int64_t time_us)
{
  int64_t change = sk_size_of((int64_t)velocity_urad_s - s->velocity_urad_s);
  int64_t way = sk_way_of((int64_t)s->velocity_urad_s + velocity_urad_s, time_us, 2 * SK_REACH_SPEED_MAX_URAD_S);
  int32_t latency = s->latency_us >= latency_us ? s->latency_us : latency_us;
  int64_t rate = sk_agreement_rate_of(p, joint, change, latency, time_us);
  int64_t allowance = sk_way_of(rate, time_us, SK_AGREE_RATE_MOST);
  s->way += way;
  s->allowance += allowance;
  s->change_urad_s = sk_least_of(SK_AGREE_CHANGE_MOST, s->change_urad_s + change);
  s->latency_us = latency;
  s->velocity_urad_s = velocity_urad_s;
  s->last_us += time_us;
}

/*@ requires \valid_read(s) && 0 <= angle_error <= SK_REACH_ERROR_MAX && 0 <= velocity_error <= SK_REACH_ERROR_MAX &&
  @   sk_span_fits(s, SK_AGREE_SPAN_US + SK_AGREE_GAP_MOST_US) && -SK_REACH_ANGLE_MAX_URAD <= angle_urad <= SK_REACH_ANGLE_MAX_URAD;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_size(2000000 * (angle_urad - s->first_angle_urad) - s->way) >
  @   sk_may_differ(angle_error, velocity_error, s->allowance, s->latency_us, s->first_velocity_urad_s, s->velocity_urad_s, s->change_urad_s);
  @*/
static bool sk_agreement_differs(const sk_agreement *s, int64_t angle_error, int64_t velocity_error, int32_t angle_urad)
{
  int64_t speed = sk_size_of(s->first_velocity_urad_s) + sk_size_of(s->velocity_urad_s) + s->change_urad_s + 2 * velocity_error;
  int64_t shifted = sk_way_of(speed, s->latency_us, 2 * SK_AGREE_CHANGE_MOST);
  int64_t differs = 2000000 * ((int64_t)angle_urad - s->first_angle_urad) - s->way;
  return sk_size_of(differs) > 4000000 * angle_error + s->allowance + 4 * shifted;
}

void sk_agreement_begin(sk_agreement *s)
{
  s->since_us = -1;
  s->last_us = -1;
  s->way = 0;
  s->allowance = 0;
  s->change_urad_s = 0;
  s->latency_us = 0;
  s->first_angle_urad = 0;
  s->first_velocity_urad_s = 0;
  s->velocity_urad_s = 0;
}

int32_t sk_agreement_step(sk_agreement *s, const berm_parameters *p, sk_agreement_reading r)
{
  bool differs;
  int64_t time_us, angle_error, velocity_error;
  if (!sk_agreement_ok(p, r)) { return BERM_STOP_INTERNAL; }
  if (s->since_us < 0 || r.now_us <= s->last_us || r.now_us > s->last_us + SK_AGREE_GAP_MOST_US) {
    sk_agreement_begin_with(s, r);
    /*@ assert nothing_to_judge: !sk_disagrees{Pre}(s, p, r); */
    return BERM_STOP_NONE;
  }
  time_us = r.now_us - s->last_us;
  angle_error = p->angle_error_urad[r.joint];
  velocity_error = p->velocity_error_urad_s[r.joint];
  sk_agreement_extend(s, p, r.joint, r.velocity_urad_s, r.latency_us, time_us);
  differs = sk_agreement_differs(s, angle_error, velocity_error, r.angle_urad);
  /*@ assert judged: differs == true <==> sk_differs_with{Pre}(s, p, r, time_us); */
  /*@ assert disagrees: differs == true <==> sk_disagrees{Pre}(s, p, r); */
  if (differs || s->last_us - s->since_us >= SK_AGREE_SPAN_US) { sk_agreement_begin_with(s, r); }
  return differs ? BERM_STOP_STATE_FRAME : BERM_STOP_NONE;
}
