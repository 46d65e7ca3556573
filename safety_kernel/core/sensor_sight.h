/* Whether a sensor can see: strips of its window that something lies on, and dust in the air.
 *
 * An eye is a panning scanner or a lidar. Its turn is divided into strips. Of a ray that must meet ground ("expected") it is told whether it was
 * blind: nothing came back, or the farthest echo lies on the window. A strip is judged whenever it has had SK_SIGHT_RAYS expected rays, and stays as
 * it was judged until then; one without expected rays is not judged, and that none come is supervised elsewhere (a silent sensor). Dust sends part
 * of the light back before the target does: of the rays that came back so many per mille had an echo well before the last. */
#ifndef SK_SENSOR_SIGHT_H
#define SK_SENSOR_SIGHT_H
#include "sk_common.h"
SK_BEGIN

#define SK_SIGHT_STRIPS 24
#define SK_SIGHT_RAYS 40             /* expected rays of a strip between two judgements */
#define SK_SIGHT_NEAR_MM 500         /* what is nearer lies on the window; echoes nearer to each other are of one target */
#define SK_SIGHT_RETURNS 1000        /* after so many rays that came back the dust level is worked out, */
#define SK_SIGHT_RETURNS_LEAST 100   /* after a second so many are enough */
#define SK_SIGHT_DUST_US 1000000

enum { SK_DUST_NONE = 0, SK_DUST_SLOW = 1, SK_DUST_STOP = 2 };

typedef struct sk_strip {
  int32_t expected, blind; /* rays since it was judged */
  int32_t blocked;         /* 1: as judged last; 0: not, or never judged */
} sk_strip;

typedef struct sk_eye {
  sk_strip strip[SK_SIGHT_STRIPS];
  int32_t returns, dusty; /* rays that came back since the level was worked out, and those of them with an echo before the last */
  int32_t dust_permille;
  int64_t since_us;       /* the first of them */
} sk_eye;

typedef struct sk_dust {
  int64_t slow_us, stop_us; /* when there was last so much; -1: never */
} sk_dust;

typedef struct sk_dust_rules {
  int32_t slow_permille, stop_permille;
  int32_t dwell_us; /* after the level was last so high */
} sk_dust_rules;

/*@ predicate sk_strip_valid{L}(sk_strip *s) = 0 <= \at(s->blind, L) <= \at(s->expected, L) < SK_SIGHT_RAYS && 0 <= \at(s->blocked, L) <= 1;
  @ predicate sk_strips_valid{L}(sk_eye *e) = \forall integer k; 0 <= k < SK_SIGHT_STRIPS ==> sk_strip_valid{L}(&e->strip[k]);
  @ predicate sk_counts_valid{L}(sk_eye *e) = 0 <= \at(e->dusty, L) <= \at(e->returns, L) < SK_SIGHT_RETURNS &&
  @   0 <= \at(e->dust_permille, L) <= 1000 && 0 <= \at(e->since_us, L);
  @ predicate sk_eye_valid{L}(sk_eye *e) = sk_strips_valid{L}(e) && sk_counts_valid{L}(e);
  @ predicate sk_strip_kept{A, B}(sk_strip *s) = \at(s->expected, A) == \at(s->expected, B) && \at(s->blind, A) == \at(s->blind, B) &&
  @   \at(s->blocked, A) == \at(s->blocked, B);
  @ // the strip had one ray more: counted, or judged with it
  @ predicate sk_strip_counted{A, B}(sk_strip *s, integer blind) = \at(s->expected, B) == \at(s->expected, A) + 1 &&
  @   \at(s->blind, B) == \at(s->blind, A) + blind && \at(s->blocked, B) == \at(s->blocked, A);
  @ predicate sk_strip_judged{A, B}(sk_strip *s, integer blind, integer limit) = \at(s->expected, B) == 0 && \at(s->blind, B) == 0 &&
  @   (\at(s->blocked, B) == 1 <==> (\at(s->blind, A) + blind) * 1000 >= limit * SK_SIGHT_RAYS);
  @ predicate sk_strip_due{A}(sk_strip *s) = \at(s->expected, A) == SK_SIGHT_RAYS - 1;
  @ // the dust level is worked out with this return
  @ predicate sk_dust_due(integer returns, integer since, integer now) =
  @   returns >= SK_SIGHT_RETURNS || (returns >= SK_SIGHT_RETURNS_LEAST && now - since >= SK_SIGHT_DUST_US);
  @ predicate sk_dust_level_is(integer level, integer dusty, integer returns) =
  @   level * returns >= dusty * 1000 && (level - 1) * returns < dusty * 1000;
  @ predicate sk_dust_holds(integer last, integer now, integer dwell) = 0 <= last && (now < last || now - last < dwell);
  @ predicate sk_dust_somewhere(sk_eye *eye, integer eyes, integer limit) = \exists integer k; 0 <= k < eyes && eye[k].dust_permille >= limit;
  @*/

/* No echo (0), or the farthest one on the window. */
/*@ assigns \nothing;
  @ ensures \result == true <==> last_mm < SK_SIGHT_NEAR_MM;
  @*/
bool sk_ray_blind(int32_t last_mm);

/* An echo that is neither on the window nor of what gave the last. */
/*@ assigns \nothing;
  @ ensures \result == true <==> SK_SIGHT_NEAR_MM <= other_mm && other_mm + SK_SIGHT_NEAR_MM <= last_mm;
  @*/
bool sk_ray_dusty(int32_t other_mm, int32_t last_mm);

/* Nothing was seen yet, and nothing is blocked. */
/*@ requires \valid(e);
  @ assigns *e;
  @ ensures valid: sk_eye_valid(e);
  @ ensures begun: \forall integer k; 0 <= k < SK_SIGHT_STRIPS ==>
  @   e->strip[k].expected == 0 && e->strip[k].blind == 0 && e->strip[k].blocked == 0;
  @ ensures clean: e->returns == 0 && e->dust_permille == 0;
  @*/
void sk_eye_begin(sk_eye *e);

/* An expected ray of the strip. With the last one that it needs the strip is judged: blocked if at least limit_permille were blind, else not. */
/*@ requires \valid(s) && sk_strip_valid(s);
  @ assigns *s;
  @ ensures valid: sk_strip_valid(s);
  @ ensures counted: !sk_strip_due{Pre}(s) ==> sk_strip_counted{Pre, Post}(s, blind ? 1 : 0);
  @ ensures judged: sk_strip_due{Pre}(s) ==> sk_strip_judged{Pre, Post}(s, blind ? 1 : 0, limit_permille);
  @*/
void sk_strip_ray(sk_strip *s, bool blind, int32_t limit_permille);

/* An expected ray of an eye; one of no strip changes nothing. */
/*@ requires \valid(e) && sk_eye_valid(e);
  @ assigns e->strip[0 .. SK_SIGHT_STRIPS - 1];
  @ ensures valid: sk_eye_valid(e);
  @ ensures others: \forall integer k; 0 <= k < SK_SIGHT_STRIPS && k != strip ==> sk_strip_kept{Pre, Post}(&e->strip[k]);
  @ ensures counted: 0 <= strip < SK_SIGHT_STRIPS && !sk_strip_due{Pre}(&e->strip[strip]) ==>
  @   sk_strip_counted{Pre, Post}(&e->strip[strip], blind ? 1 : 0);
  @ ensures judged: 0 <= strip < SK_SIGHT_STRIPS && sk_strip_due{Pre}(&e->strip[strip]) ==>
  @   sk_strip_judged{Pre, Post}(&e->strip[strip], blind ? 1 : 0, limit_permille);
  @*/
void sk_eye_ray(sk_eye *e, int32_t strip, bool blind, int32_t limit_permille);

/* Something lies on the window. */
/*@ requires \valid_read(e) && sk_eye_valid(e);
  @ assigns \nothing;
  @ ensures \result == true <==> \exists integer k; 0 <= k < SK_SIGHT_STRIPS && e->strip[k].blocked == 1;
  @*/
bool sk_eye_blocked(const sk_eye *e);

/* A ray that came back. The level is rounded up. Before time 0 there is nothing. */
/*@ requires \valid(e) && sk_eye_valid(e);
  @ assigns e->returns, e->dusty, e->dust_permille, e->since_us;
  @ ensures valid: sk_eye_valid(e);
  @ ensures refused: now_us < 0 ==> e->returns == \old(e->returns) && e->dusty == \old(e->dusty) && e->dust_permille == \old(e->dust_permille);
  @ ensures since: 0 <= now_us ==> e->since_us == (\old(e->returns) == 0 ? now_us : \old(e->since_us));
  @ ensures counted: 0 <= now_us && !sk_dust_due(\old(e->returns) + 1, e->since_us, now_us) ==> e->returns == \old(e->returns) + 1 &&
  @   e->dusty == \old(e->dusty) + (dusty ? 1 : 0) && e->dust_permille == \old(e->dust_permille);
  @ ensures judged: 0 <= now_us && sk_dust_due(\old(e->returns) + 1, e->since_us, now_us) ==> e->returns == 0 && e->dusty == 0 &&
  @   sk_dust_level_is(e->dust_permille, \old(e->dusty) + (dusty ? 1 : 0), \old(e->returns) + 1);
  @*/
void sk_eye_return(sk_eye *e, bool dusty, int64_t now_us);

/* There was never dust. */
/*@ requires \valid(d);
  @ assigns *d;
  @ ensures d->slow_us == -1 && d->stop_us == -1;
  @*/
void sk_dust_begin(sk_dust *d);

/* The highest level; 0 of no eye. */
/*@ requires 0 <= eyes && \valid_read(eye + (0 .. eyes - 1));
  @ assigns \nothing;
  @ ensures most: 0 <= \result && \forall integer k; 0 <= k < eyes ==> eye[k].dust_permille <= \result;
  @ ensures least: \result == 0 || \exists integer k; 0 <= k < eyes && eye[k].dust_permille == \result;
  @*/
int32_t sk_dust_worst(const sk_eye *eye, int32_t eyes);

/* What the dust asks for, worst eye and dwell: SK_DUST_NONE, SLOW or STOP. When time has run backwards it holds on. */
/*@ requires 0 <= eyes && \valid_read(eye + (0 .. eyes - 1)) && \valid(d) && \separated(d, eye + (0 .. eyes - 1));
  @ requires 0 < r.slow_permille && 0 < r.stop_permille;
  @ assigns *d;
  @ ensures code: \result == SK_DUST_NONE || \result == SK_DUST_SLOW || \result == SK_DUST_STOP;
  @ ensures stop: \result == SK_DUST_STOP <==> sk_dust_somewhere(eye, eyes, r.stop_permille) || sk_dust_holds(\old(d->stop_us), now_us, r.dwell_us);
  @ ensures slow: \result != SK_DUST_NONE <==> sk_dust_somewhere(eye, eyes, r.slow_permille) || sk_dust_holds(\old(d->slow_us), now_us, r.dwell_us) ||
  @   \result == SK_DUST_STOP;
  @ ensures stop_noted: sk_dust_somewhere(eye, eyes, r.stop_permille) ==> d->stop_us == now_us;
  @ ensures slow_noted: sk_dust_somewhere(eye, eyes, r.slow_permille) ==> d->slow_us == now_us;
  @ ensures stop_kept: !sk_dust_somewhere(eye, eyes, r.stop_permille) ==> d->stop_us == \old(d->stop_us);
  @ ensures slow_kept: !sk_dust_somewhere(eye, eyes, r.slow_permille) ==> d->slow_us == \old(d->slow_us);
  @*/
int32_t sk_sight_verdict(sk_dust *d, const sk_eye *eye, int32_t eyes, sk_dust_rules r, int64_t now_us);

SK_END
#endif
