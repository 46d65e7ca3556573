#include "base_motion.h"

void sk_base_init(sk_base_state *s)
{
  s->learned = false;
  s->moved = false;
  s->roll_urad = 0;
  s->pitch_urad = 0;
  s->track_urad = 0;
  s->attitude_us = -1;
  s->azimuth_us = -1;
  s->learned_roll_urad = 0;
  s->learned_pitch_urad = 0;
  s->learned_track_urad = 0;
  s->tilt_frames = 0;
  s->turn_frames = 0;
}

int32_t sk_base_apart(int32_t a_urad, int32_t b_urad)
{
  int64_t turned = ((int64_t)a_urad - b_urad) % SK_TURN_URAD;
  if (turned < 0) { turned = turned + SK_TURN_URAD; }
  /*@ assert 0 <= turned < SK_TURN_URAD; */
  /*@ assert turned == sk_turned(a_urad, b_urad); */
  if (turned > SK_TURN_URAD - turned) { turned = SK_TURN_URAD - turned; }
  return (int32_t)turned;
}

/*@ requires 0 < most <= 1000;
  @ assigns \nothing;
  @ ensures up: beyond == true ==> \result == sk_counted(count, \true, most);
  @ ensures down: beyond == false ==> \result == sk_counted(count, \false, most);
  @*/
static int32_t sk_count_frame(int32_t count, bool beyond, int32_t most)
{
  int32_t now = count;
  if (now < 0) { now = 0; }
  if (now > most) { now = most; }
  if (beyond) { return now < most ? now + 1 : most; }
  return now > 0 ? now - 1 : 0;
}

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_tilted(s, roll_urad, pitch_urad, limit_urad);
  @*/
static bool sk_is_tilted(const sk_base_state *s, int32_t roll_urad, int32_t pitch_urad, int32_t limit_urad)
{
  return sk_base_apart(roll_urad, s->learned_roll_urad) > limit_urad || sk_base_apart(pitch_urad, s->learned_pitch_urad) > limit_urad;
}

void sk_base_attitude(sk_base_state *s, const berm_parameters *p, int32_t roll_urad, int32_t pitch_urad, int64_t now_us)
{
  s->roll_urad = roll_urad;
  s->pitch_urad = pitch_urad;
  s->attitude_us = now_us;
  if (!s->learned) {
    s->tilt_frames = 0;
    return;
  }
  s->tilt_frames = sk_count_frame(s->tilt_frames, sk_is_tilted(s, roll_urad, pitch_urad, p->base_tilt_urad), SK_BASE_TILT_FRAMES);
  if (s->tilt_frames >= SK_BASE_TILT_FRAMES || sk_is_tilted(s, roll_urad, pitch_urad, p->base_tilt_hard_urad)) { s->moved = true; }
}

void sk_base_azimuth(sk_base_state *s, const berm_parameters *p, int32_t track_urad, int64_t now_us)
{
  s->track_urad = track_urad;
  s->azimuth_us = now_us;
  if (!s->learned) {
    s->turn_frames = 0;
    return;
  }
  s->turn_frames = sk_count_frame(s->turn_frames, sk_base_apart(track_urad, s->learned_track_urad) > p->base_azimuth_urad, SK_BASE_TURN_FRAMES);
  if (s->turn_frames >= SK_BASE_TURN_FRAMES) { s->moved = true; }
}

void sk_base_slipped(sk_base_state *s)
{
  if (s->learned) { s->moved = true; }
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_base_heard(last_us, now_us, age_us);
  @*/
static bool sk_is_heard(int64_t last_us, int64_t now_us, int32_t age_us)
{
  return 0 <= last_us && last_us <= now_us && now_us - last_us <= age_us;
}

bool sk_base_fresh(const sk_base_state *s, const berm_parameters *p, int64_t now_us)
{
  return sk_is_heard(s->attitude_us, now_us, p->base_frame_age_us) && sk_is_heard(s->azimuth_us, now_us, p->base_frame_age_us);
}

bool sk_base_learn(sk_base_state *s, const berm_parameters *p, int64_t now_us)
{
  if (!sk_base_fresh(s, p, now_us)) { return false; }
  s->learned = true;
  s->moved = false;
  s->learned_roll_urad = s->roll_urad;
  s->learned_pitch_urad = s->pitch_urad;
  s->learned_track_urad = s->track_urad;
  s->tilt_frames = 0;
  s->turn_frames = 0;
  return true;
}
