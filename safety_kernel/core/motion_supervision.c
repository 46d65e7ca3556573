#include "motion_supervision.h"

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_motion_fits(p, r);
  @*/
static bool sk_motion_ok(const berm_parameters *p, sk_motion_reading r)
{
  if (r.joint < 0 || r.joint >= SK_JOINTS || r.row < 0 || r.row >= BERM_BRAKE_REACHES) { return false; }
  if (!sk_times_ok(p) || !sk_limits_ok(p, r.joint)) { return false; }
  if (p->standstill_urad_s < 0 || p->standstill_urad_s > SK_REACH_SPEED_MAX_URAD_S) { return false; }
  return -SK_REACH_ANGLE_MAX_URAD <= r.angle_urad && r.angle_urad <= SK_REACH_ANGLE_MAX_URAD &&
         -SK_REACH_SPEED_MAX_URAD_S <= r.velocity_urad_s && r.velocity_urad_s <= SK_REACH_SPEED_MAX_URAD_S &&
         -SK_REACH_SPEED_MAX_URAD_S <= r.command_urad_s && r.command_urad_s <= SK_REACH_SPEED_MAX_URAD_S &&
         0 <= r.now_us && r.now_us <= SK_MOTION_NOW_MAX_US;
}

/*@ requires \valid_read(s) && \valid_read(p) && sk_motion_fits(p, r);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_motion_uncommanded(s, p, r.joint, r.velocity_urad_s, r.command_urad_s);
  @*/
static bool sk_motion_is_uncommanded(const sk_motion_side *s, const berm_parameters *p, sk_motion_reading r)
{
  int64_t follow = sk_most_of(r.command_urad_s, 0) + 2 * (int64_t)p->velocity_error_urad_s[r.joint];
  return r.velocity_urad_s > sk_most_of(follow, s->ceiling_urad_s);
}

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_motion_goes_on(s, r.row, r.command_urad_s);
  @*/
static bool sk_motion_is_going_on(const sk_motion_side *s, sk_motion_reading r)
{
  return r.command_urad_s <= 0 && s->bound && r.row <= s->row;
}

/*@ requires \valid_read(s) && \valid_read(p) && sk_motion_fits(p, r);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_motion_overrun(s, p, r.joint, r.row, r.angle_urad, r.velocity_urad_s, r.command_urad_s, r.now_us);
  @*/
static bool sk_motion_is_overrun(const sk_motion_side *s, const berm_parameters *p, sk_motion_reading r)
{
  int64_t rest = sk_most_of(p->standstill_urad_s, 2 * (int64_t)p->velocity_error_urad_s[r.joint]);
  if (!sk_motion_is_going_on(s, r)) { return false; }
  return r.angle_urad > s->limit_urad || (r.now_us > s->deadline_us && r.velocity_urad_s > rest);
}

/*@ requires \valid(s) && \valid_read(p) && \separated(s, p) && sk_motion_fits(p, r);
  @ assigns s->ceiling_urad_s;
  @ ensures s->ceiling_urad_s == sk_motion_ceiling(p, r.joint, r.velocity_urad_s, r.command_urad_s, \old(s->ceiling_urad_s));
  @*/
static void sk_motion_lower(sk_motion_side *s, const berm_parameters *p, sk_motion_reading r)
{
  int64_t error = p->velocity_error_urad_s[r.joint];
  int64_t follow = sk_most_of(r.command_urad_s, 0) + 2 * error;
  int64_t lost = sk_least_of(s->ceiling_urad_s, r.velocity_urad_s + 3 * error);
  s->ceiling_urad_s = (int32_t)sk_most_of(follow, lost);
}

int32_t sk_motion_side_step(sk_motion_side *s, const berm_parameters *p, sk_motion_reading r)
{
  int32_t result = BERM_STOP_NONE;
  int32_t row = r.row, speed, stop_urad, time_us;
  int64_t limit_urad, deadline_us;
  bool going_on;
  if (!sk_motion_ok(p, r)) { return BERM_STOP_INTERNAL; }
  going_on = sk_motion_is_going_on(s, r);
  if (going_on) { row = s->row; }
  speed = (int32_t)sk_least_of((int64_t)r.velocity_urad_s + p->velocity_error_urad_s[r.joint], p->velocity_max_urad_s[r.joint]);
  /*@ assert speed == sk_motion_speed(p, r.joint, r.velocity_urad_s); */
  stop_urad = sk_brake_angle(p, r.joint, row, speed);
  time_us = sk_brake_time(p, r.joint, row, speed);
  if (stop_urad < 0 || time_us < 0) { return BERM_STOP_INTERNAL; }
  limit_urad = (int64_t)r.angle_urad + 2 * (int64_t)p->angle_error_urad[r.joint] + stop_urad;
  deadline_us = r.now_us + p->state_latency_us + time_us;
  /*@ assert limit_here: sk_motion_limit_is(p, r.joint, row, r.angle_urad, r.velocity_urad_s, limit_urad); */
  /*@ assert deadline_here: sk_motion_deadline_is(p, r.joint, row, r.now_us, r.velocity_urad_s, deadline_us); */
  if (sk_motion_is_uncommanded(s, p, r)) { result = BERM_STOP_UNCOMMANDED; }
  else if (sk_motion_is_overrun(s, p, r)) { result = BERM_STOP_BRAKING; }
  sk_motion_lower(s, p, r);
  if (going_on && result != BERM_STOP_BRAKING) {
    s->limit_urad = sk_least_of(s->limit_urad, limit_urad);
    s->deadline_us = sk_least_of(s->deadline_us, deadline_us);
  } else {
    s->limit_urad = limit_urad;
    s->deadline_us = deadline_us;
  }
  s->row = row;
  s->bound = r.command_urad_s <= 0;
  return result;
}

/*@ requires \valid(s);
  @ assigns *s;
  @ ensures s->bound == false && s->ceiling_urad_s == SK_MOTION_NO_CEILING;
  @*/
static void sk_motion_begin_side(sk_motion_side *s)
{
  s->limit_urad = 0;
  s->deadline_us = 0;
  s->ceiling_urad_s = SK_MOTION_NO_CEILING;
  s->row = 0;
  s->bound = false;
}

void sk_motion_begin(sk_motion_joint *s)
{
  sk_motion_begin_side(&s->up);
  sk_motion_begin_side(&s->down);
}

int32_t sk_motion_step(sk_motion_joint *s, const berm_parameters *p, sk_motion_reading r, int32_t command_low_urad_s)
{
  sk_motion_reading down = r;
  int32_t up_result, down_result;
  if (!sk_motion_ok(p, r)) { return BERM_STOP_INTERNAL; }
  if (command_low_urad_s < -SK_REACH_SPEED_MAX_URAD_S || command_low_urad_s > SK_REACH_SPEED_MAX_URAD_S) { return BERM_STOP_INTERNAL; }
  down.angle_urad = -r.angle_urad;
  down.velocity_urad_s = -r.velocity_urad_s;
  down.command_urad_s = -command_low_urad_s;
  up_result = sk_motion_side_step(&s->up, p, r);
  down_result = sk_motion_side_step(&s->down, p, down);
  if (up_result == BERM_STOP_INTERNAL || down_result == BERM_STOP_INTERNAL) { return BERM_STOP_INTERNAL; }
  return up_result != BERM_STOP_NONE ? up_result : down_result;
}
