#include "separation.h"

int64_t sk_separation_distance(int32_t approach_mm_s, int64_t time_us, int32_t intrusion_mm)
{
  if (approach_mm_s < 0 || approach_mm_s > SK_APPROACH_MOST_MM_S || time_us < 0 || time_us > SK_SEPARATION_TIME_MOST_US) { return -1; }
  if (intrusion_mm < 0 || intrusion_mm > SK_INTRUSION_MOST_MM) { return -1; }
  /*@ assert 0 <= approach_mm_s * time_us <= SK_APPROACH_MOST_MM_S * SK_SEPARATION_TIME_MOST_US; */
  return (approach_mm_s * time_us + 999999) / 1000000 + intrusion_mm;
}

void sk_sectors_begin(sk_sectors *s)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= SK_SECTORS;
    @ loop invariant \forall integer i; 0 <= i < k ==> s->sector[i].seen_us == -1 && s->sector[i].window_us == 0 &&
    @   s->sector[i].gap_us == 0 && s->sector[i].gap_before_us == 0;
    @ loop assigns k, s->sector[0 .. SK_SECTORS - 1];
    @ loop variant SK_SECTORS - k;
    @*/
  for (k = 0; k < SK_SECTORS; k++) {
    s->sector[k].seen_us = -1;
    s->sector[k].window_us = 0;
    s->sector[k].gap_us = 0;
    s->sector[k].gap_before_us = 0;
  }
}

/*@ requires -1 <= seen_us;
  @ assigns \nothing;
  @ ensures \result == sk_unseen(seen_us, now_us) && 0 <= \result <= SK_BLIND_MOST_US;
  @*/
static int32_t sk_unseen_for(int64_t seen_us, int64_t now_us)
{
  if (seen_us < 0 || now_us < seen_us) { return SK_BLIND_MOST_US; }
  if (now_us - seen_us > SK_BLIND_MOST_US) { return SK_BLIND_MOST_US; }
  return (int32_t)(now_us - seen_us);
}

void sk_sector_see(sk_sector *s, int64_t now_us, int32_t memory_us)
{
  int32_t gap_us;
  if (now_us < 0 || now_us < s->seen_us || memory_us < 0) { return; }
  gap_us = s->seen_us < 0 ? 0 : sk_unseen_for(s->seen_us, now_us);
  if (now_us - s->window_us > memory_us) {
    s->gap_before_us = s->gap_us;
    s->gap_us = gap_us;
    s->window_us = now_us;
  } else if (gap_us > s->gap_us) {
    s->gap_us = gap_us;
  }
  s->seen_us = now_us;
}

int32_t sk_sector_blind(const sk_sector *s, int64_t now_us)
{
  int32_t blind_us = sk_unseen_for(s->seen_us, now_us);
  if (s->gap_us > blind_us) { blind_us = s->gap_us; }
  if (s->gap_before_us > blind_us) { blind_us = s->gap_before_us; }
  return blind_us;
}

int32_t sk_sectors_worst(const sk_sectors *s, int64_t now_us)
{
  int32_t k, worst = 0, most_us = sk_sector_blind(&s->sector[0], now_us);
  /*@ loop invariant 1 <= k <= SK_SECTORS && 0 <= worst < k;
    @ loop invariant sk_blind_is(&s->sector[worst], now_us, most_us);
    @ loop invariant \forall integer i, here; 0 <= i < k && sk_blind_is(&s->sector[i], now_us, here) ==> here <= most_us;
    @ loop assigns k, worst, most_us;
    @ loop variant SK_SECTORS - k;
    @*/
  for (k = 1; k < SK_SECTORS; k++) {
    int32_t blind_us = sk_sector_blind(&s->sector[k], now_us);
    if (blind_us > most_us) {
      worst = k;
      most_us = blind_us;
    }
  }
  return worst;
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_separation_rules_fit(r);
  @*/
static bool sk_are_separation_rules_ok(sk_separation_rules r)
{
  if (r.approach_mm_s < SK_APPROACH_LEAST_MM_S || r.approach_mm_s > SK_APPROACH_MOST_MM_S) { return false; }
  return r.intrusion_mm >= 0 && r.intrusion_mm <= SK_INTRUSION_MOST_MM && r.detect_us >= 0 && r.detect_us <= SK_DETECT_MOST_US;
}

/* The whole time in which way_mm is not walked through. */
/*@ requires SK_APPROACH_LEAST_MM_S <= approach_mm_s <= SK_APPROACH_MOST_MM_S && 0 <= way_mm <= SK_COORD_MAX_MM;
  @ assigns \nothing;
  @ ensures kept: approach_mm_s * \result <= way_mm * 1000000;
  @ ensures most: way_mm * 1000000 < approach_mm_s * (\result + 1);
  @ ensures range: 0 <= \result <= SK_COORD_MAX_MM * 10000;
  @*/
static int64_t sk_time_for(int32_t approach_mm_s, int32_t way_mm)
{
  int64_t way_nm = (int64_t)way_mm * 1000000;
  int64_t time_us = way_nm / approach_mm_s;
  /*@ assert whole: way_nm == approach_mm_s * time_us + way_nm % approach_mm_s; */
  /*@ assert rest: 0 <= way_nm % approach_mm_s < approach_mm_s; */
  /*@ assert bound: SK_APPROACH_LEAST_MM_S * time_us <= approach_mm_s * time_us; */
  return time_us;
}

int32_t sk_separation_stop_time(sk_separation_rules r, int32_t blind_us, int32_t distance_mm)
{
  int64_t time_us;
  if (!sk_are_separation_rules_ok(r) || blind_us < 0 || blind_us > SK_BLIND_MOST_US || distance_mm > SK_COORD_MAX_MM) { return -1; }
  if (distance_mm < r.intrusion_mm) { return -1; }
  time_us = sk_time_for(r.approach_mm_s, distance_mm - r.intrusion_mm) - blind_us - r.detect_us;
  /*@ assert sum: time_us <= SK_COORD_MAX_MM * 10000; */
  if (time_us < 0) {
    /*@ assert none: r.approach_mm_s * (blind_us + r.detect_us) > (distance_mm - r.intrusion_mm) * 1000000; */
    return -1;
  }
  return (int32_t)time_us;
}

sk_separation sk_separate(const sk_sectors *s, int64_t now_us, sk_separation_rules r, int32_t distance_mm)
{
  sk_separation left;
  int32_t blind_us;
  left.sector = sk_sectors_worst(s, now_us);
  blind_us = sk_sector_blind(&s->sector[left.sector], now_us);
  left.stop_us = sk_separation_stop_time(r, blind_us, distance_mm);
  /*@ assert no_worse: \forall integer k, blind; 0 <= k < SK_SECTORS && sk_blind_is(&s->sector[k], now_us, blind) ==> blind <= blind_us; */
  /*@ assert slower: 0 <= left.stop_us ==> \forall integer blind; blind <= blind_us ==>
    @   r.approach_mm_s * (blind + r.detect_us + left.stop_us) <= r.approach_mm_s * (blind_us + r.detect_us + left.stop_us); */
  return left;
}
