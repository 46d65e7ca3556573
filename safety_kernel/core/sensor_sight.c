#include "sensor_sight.h"

bool sk_ray_blind(int32_t last_mm)
{
  return last_mm < SK_SIGHT_NEAR_MM;
}

bool sk_ray_dusty(int32_t other_mm, int32_t last_mm)
{
  return SK_SIGHT_NEAR_MM <= other_mm && (int64_t)other_mm + SK_SIGHT_NEAR_MM <= last_mm;
}

/*@ requires \valid(s);
  @ assigns *s;
  @ ensures s->expected == 0 && s->blind == 0 && s->blocked == 0;
  @*/
static void sk_strip_begin(sk_strip *s)
{
  s->expected = 0;
  s->blind = 0;
  s->blocked = 0;
}

void sk_eye_begin(sk_eye *e)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= SK_SIGHT_STRIPS;
    @ loop invariant \forall integer i; 0 <= i < k ==> e->strip[i].expected == 0 && e->strip[i].blind == 0 && e->strip[i].blocked == 0;
    @ loop assigns k, e->strip[0 .. SK_SIGHT_STRIPS - 1];
    @ loop variant SK_SIGHT_STRIPS - k;
    @*/
  for (k = 0; k < SK_SIGHT_STRIPS; k++) { sk_strip_begin(&e->strip[k]); }
  e->returns = 0;
  e->dusty = 0;
  e->dust_permille = 0;
  e->since_us = 0;
}

void sk_strip_ray(sk_strip *s, bool blind, int32_t limit_permille)
{
  s->expected += 1;
  if (blind) { s->blind += 1; }
  if (s->expected < SK_SIGHT_RAYS) { return; }
  s->blocked = (int64_t)s->blind * 1000 >= (int64_t)limit_permille * SK_SIGHT_RAYS ? 1 : 0;
  s->expected = 0;
  s->blind = 0;
}

void sk_eye_ray(sk_eye *e, int32_t strip, bool blind, int32_t limit_permille)
{
  if (strip < 0 || strip >= SK_SIGHT_STRIPS) { return; }
  sk_strip_ray(&e->strip[strip], blind, limit_permille);
}

bool sk_eye_blocked(const sk_eye *e)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= SK_SIGHT_STRIPS;
    @ loop invariant \forall integer i; 0 <= i < k ==> e->strip[i].blocked != 1;
    @ loop assigns k;
    @ loop variant SK_SIGHT_STRIPS - k;
    @*/
  for (k = 0; k < SK_SIGHT_STRIPS; k++) {
    if (e->strip[k].blocked == 1) { return true; }
  }
  return false;
}

/* The level, rounded up. */
/*@ requires 0 <= dusty <= returns <= SK_SIGHT_RETURNS && 0 < returns;
  @ assigns \nothing;
  @ ensures level: sk_dust_level_is(\result, dusty, returns);
  @ ensures range: 0 <= \result <= 1000;
  @*/
static int32_t sk_dust_level(int32_t dusty, int32_t returns)
{
  int32_t sum = dusty * 1000 + returns - 1;
  int32_t level = sum / returns;
  /*@ assert whole: sum == returns * level + sum % returns; */
  /*@ assert rest: 0 <= sum % returns < returns; */
  /*@ assert above: level * returns >= dusty * 1000; */
  /*@ assert below: (level - 1) * returns < dusty * 1000; */
  /*@ assert share: (level - 1) * returns < 1000 * returns; */
  return level;
}

void sk_eye_return(sk_eye *e, bool dusty, int64_t now_us)
{
  if (now_us < 0) { return; }
  if (e->returns == 0) { e->since_us = now_us; }
  e->returns += 1;
  if (dusty) { e->dusty += 1; }
  if (e->returns < SK_SIGHT_RETURNS && (e->returns < SK_SIGHT_RETURNS_LEAST || now_us - e->since_us < SK_SIGHT_DUST_US)) { return; }
  e->dust_permille = sk_dust_level(e->dusty, e->returns);
  e->returns = 0;
  e->dusty = 0;
}

void sk_dust_begin(sk_dust *d)
{
  d->slow_us = -1;
  d->stop_us = -1;
}

int32_t sk_dust_worst(const sk_eye *eye, int32_t eyes)
{
  int32_t k, worst = 0;
  /*@ loop invariant 0 <= k <= eyes && 0 <= worst;
    @ loop invariant \forall integer i; 0 <= i < k ==> eye[i].dust_permille <= worst;
    @ loop invariant worst == 0 || \exists integer i; 0 <= i < k && eye[i].dust_permille == worst;
    @ loop assigns k, worst;
    @ loop variant eyes - k;
    @*/
  for (k = 0; k < eyes; k++) {
    if (eye[k].dust_permille > worst) { worst = eye[k].dust_permille; }
  }
  return worst;
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_dust_holds(last_us, now_us, dwell_us);
  @*/
static bool sk_is_dust_held(int64_t last_us, int64_t now_us, int32_t dwell_us)
{
  if (last_us < 0) { return false; }
  if (now_us < last_us) { return true; }
  return now_us - last_us < dwell_us;
}

int32_t sk_sight_verdict(sk_dust *d, const sk_eye *eye, int32_t eyes, sk_dust_rules r, int64_t now_us)
{
  int32_t level = sk_dust_worst(eye, eyes);
  bool slow = level >= r.slow_permille, stop = level >= r.stop_permille;
  bool slow_held = sk_is_dust_held(d->slow_us, now_us, r.dwell_us), stop_held = sk_is_dust_held(d->stop_us, now_us, r.dwell_us);
  /*@ assert slow_somewhere: slow == true <==> sk_dust_somewhere(eye, eyes, r.slow_permille); */
  /*@ assert stop_somewhere: stop == true <==> sk_dust_somewhere(eye, eyes, r.stop_permille); */
  if (slow) { d->slow_us = now_us; }
  if (stop) { d->stop_us = now_us; }
  if (stop || stop_held) { return SK_DUST_STOP; }
  return slow || slow_held ? SK_DUST_SLOW : SK_DUST_NONE;
}
