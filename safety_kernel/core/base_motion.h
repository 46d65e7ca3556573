/* Base motion: whether the machine's base still stands as it did when the map was begun. The map is in the base frame: a base that tilts or
 * turns takes the map with it. Roll, pitch and the tracks' azimuth are held against a reference. A slip that turns nothing no frame shows: the
 * terrain shows it (base_slip.h). The frames are unguarded: they can only stop the machine. */
#ifndef SK_BASE_MOTION_H
#define SK_BASE_MOTION_H
#include "sk_common.h"
#include "config/parameter_block.h"
SK_BEGIN

#define SK_TURN_URAD 6283185    /* 2 pi */
#define SK_BASE_TILT_FRAMES 15  /* Roll_Pitch comes every 20 ms: 300 ms */
#define SK_BASE_TURN_FRAMES 3   /* Vehicle_Azimuth every 100 ms: 300 ms */

typedef struct sk_base_state {
  bool learned;                                        /* there is a reference */
  bool moved;                                          /* the base has moved since it was taken */
  int32_t roll_urad, pitch_urad, track_urad;           /* newest */
  int64_t attitude_us, azimuth_us;                     /* when; -1 never */
  int32_t learned_roll_urad, learned_pitch_urad, learned_track_urad;
  int32_t tilt_frames, turn_frames;                    /* frames beyond the limit less frames within it, never below 0: a majority's vote */
} sk_base_state;

/*@ logic integer sk_turned(integer a, integer b) = ((a - b) % SK_TURN_URAD + SK_TURN_URAD) % SK_TURN_URAD;
  @ // the angle between two directions, whichever way round is shorter
  @ logic integer sk_apart(integer a, integer b) = sk_turned(a, b) <= SK_TURN_URAD - sk_turned(a, b) ? sk_turned(a, b) : SK_TURN_URAD - sk_turned(a, b);
  @ predicate sk_tilted{L}(sk_base_state *s, integer roll, integer pitch, integer limit) =
  @   sk_apart(roll, \at(s->learned_roll_urad, L)) > limit || sk_apart(pitch, \at(s->learned_pitch_urad, L)) > limit;
  @ logic integer sk_within_count(integer count, integer most) = count < 0 ? 0 : (count > most ? most : count);
  @ logic integer sk_counted(integer count, boolean beyond, integer most) =
  @   sk_within_count(sk_within_count(count, most) + (beyond == \true ? 1 : -1), most);
  @ predicate sk_base_heard(integer last, integer now, integer age) = 0 <= last <= now && now - last <= age;
  @ predicate sk_base_reference_kept{A, B}(sk_base_state *s) = \at(s->learned, A) == \at(s->learned, B) &&
  @   \at(s->learned_roll_urad, A) == \at(s->learned_roll_urad, B) && \at(s->learned_pitch_urad, A) == \at(s->learned_pitch_urad, B) &&
  @   \at(s->learned_track_urad, A) == \at(s->learned_track_urad, B);
  @*/

/* No reference, nothing heard. */
/*@ requires \valid(s);
  @ assigns *s;
  @ ensures s->learned == false && s->moved == false && s->attitude_us == -1 && s->azimuth_us == -1 && s->tilt_frames == 0 && s->turn_frames == 0;
  @*/
void sk_base_init(sk_base_state *s);

/* The angle between two directions, 0 to pi. */
/*@ assigns \nothing;
  @ ensures \result == sk_apart(a_urad, b_urad) && 0 <= \result <= SK_TURN_URAD / 2;
  @*/
int32_t sk_base_apart(int32_t a_urad, int32_t b_urad);

/* A Roll_Pitch frame. The base has moved when this frame lies beyond the hard limit, or SK_BASE_TILT_FRAMES more frames lay beyond the lasting
 * limit than within it. */
/*@ requires \valid(s) && \valid_read(p) && \separated(s, p);
  @ assigns s->roll_urad, s->pitch_urad, s->attitude_us, s->tilt_frames, s->moved;
  @ ensures newest: s->roll_urad == roll_urad && s->pitch_urad == pitch_urad && s->attitude_us == now_us;
  @ ensures unlearned: s->learned == false ==> s->moved == \old(s->moved) && s->tilt_frames == 0;
  @ ensures beyond: s->learned == true && sk_tilted{Pre}(s, roll_urad, pitch_urad, p->base_tilt_urad) ==>
  @   s->tilt_frames == sk_counted(\old(s->tilt_frames), \true, SK_BASE_TILT_FRAMES);
  @ ensures within: s->learned == true && !sk_tilted{Pre}(s, roll_urad, pitch_urad, p->base_tilt_urad) ==>
  @   s->tilt_frames == sk_counted(\old(s->tilt_frames), \false, SK_BASE_TILT_FRAMES);
  @ ensures moved: s->learned == true ==> (s->moved == true <==> \old(s->moved) == true ||
  @   sk_tilted{Pre}(s, roll_urad, pitch_urad, p->base_tilt_hard_urad) || s->tilt_frames >= SK_BASE_TILT_FRAMES);
  @*/
void sk_base_attitude(sk_base_state *s, const berm_parameters *p, int32_t roll_urad, int32_t pitch_urad, int64_t now_us);

/* A Vehicle_Azimuth frame: the tracks' part of it. */
/*@ requires \valid(s) && \valid_read(p) && \separated(s, p);
  @ assigns s->track_urad, s->azimuth_us, s->turn_frames, s->moved;
  @ ensures newest: s->track_urad == track_urad && s->azimuth_us == now_us;
  @ ensures unlearned: s->learned == false ==> s->moved == \old(s->moved) && s->turn_frames == 0;
  @ ensures beyond: s->learned == true && sk_apart(track_urad, s->learned_track_urad) > p->base_azimuth_urad ==>
  @   s->turn_frames == sk_counted(\old(s->turn_frames), \true, SK_BASE_TURN_FRAMES);
  @ ensures within: s->learned == true && sk_apart(track_urad, s->learned_track_urad) <= p->base_azimuth_urad ==>
  @   s->turn_frames == sk_counted(\old(s->turn_frames), \false, SK_BASE_TURN_FRAMES);
  @ ensures moved: s->learned == true ==> (s->moved == true <==> \old(s->moved) == true || s->turn_frames >= SK_BASE_TURN_FRAMES);
  @*/
void sk_base_azimuth(sk_base_state *s, const berm_parameters *p, int32_t track_urad, int64_t now_us);

/* The terrain lies elsewhere than when the reference was taken. */
/*@ requires \valid(s);
  @ assigns s->moved;
  @ ensures s->moved == true <==> \old(s->moved) == true || s->learned == true;
  @*/
void sk_base_slipped(sk_base_state *s);

/* Both messages were heard within base_frame_age_us. A message from the future was not. */
/*@ requires \valid_read(s) && \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_base_heard(s->attitude_us, now_us, p->base_frame_age_us) && sk_base_heard(s->azimuth_us, now_us, p->base_frame_age_us);
  @*/
bool sk_base_fresh(const sk_base_state *s, const berm_parameters *p, int64_t now_us);

/* Takes the newest frames as the reference, and what moved is forgotten: the caller begins the map anew. Refused, and nothing changed, while the
 * frames are not fresh. Nothing else ends `moved`. */
/*@ requires \valid(s) && \valid_read(p) && \separated(s, p);
  @ assigns s->learned, s->moved, s->learned_roll_urad, s->learned_pitch_urad, s->learned_track_urad, s->tilt_frames, s->turn_frames;
  @ ensures accepts: \result == true <==> sk_base_heard(s->attitude_us, now_us, p->base_frame_age_us) &&
  @   sk_base_heard(s->azimuth_us, now_us, p->base_frame_age_us);
  @ ensures taken: \result == true ==> s->learned == true && s->moved == false && s->learned_roll_urad == s->roll_urad &&
  @   s->learned_pitch_urad == s->pitch_urad && s->learned_track_urad == s->track_urad && s->tilt_frames == 0 && s->turn_frames == 0;
  @ ensures refused: \result == false ==> sk_base_reference_kept{Pre, Post}(s) && s->moved == \old(s->moved) &&
  @   s->tilt_frames == \old(s->tilt_frames) && s->turn_frames == \old(s->turn_frames);
  @*/
bool sk_base_learn(sk_base_state *s, const berm_parameters *p, int64_t now_us);

SK_END
#endif
