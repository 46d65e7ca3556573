/* ISO 13855's minimum distance S = K T + C, and what stopping time it leaves: K the speed of approach, T from the moment at which somebody comes into
 * the safety region to the machine's standstill, C what of him may reach ahead before he is detected.
 *
 * Directions about the swing axis are told apart in sectors of one degree: at the rim of the largest region, 15 m, a sector is 0.26 m wide, so that
 * who is wider than two sectors is met by any sensor that saw each of them. Of a sector it is known when it was last seen, and for how long it had
 * been unseen before, as long as who came in that time may not have been told of by the Workspace Monitor. */
#ifndef SK_SEPARATION_H
#define SK_SEPARATION_H
#include "sk_common.h"
SK_BEGIN

#define SK_SECTORS 360
#define SK_BLIND_MOST_US 600000000           /* unseen for longer, or never seen: counts as this, which no distance allows for */
#define SK_DETECT_MOST_US 60000000
#define SK_APPROACH_LEAST_MM_S 100           /* at which SK_BLIND_MOST_US is farther than SK_COORD_MAX_MM */
#define SK_APPROACH_MOST_MM_S 10000
#define SK_INTRUSION_MOST_MM 10000
#define SK_SEPARATION_TIME_MOST_US 2000000000

/* A sector: the longest of the gaps between two looks at it that ended since window_us, and the longest of the window before. */
typedef struct sk_sector {
  int64_t seen_us;   /* newest return; -1: none yet */
  int64_t window_us;
  int32_t gap_us;
  int32_t gap_before_us;
} sk_sector;

typedef struct sk_sectors {
  sk_sector sector[SK_SECTORS]; /* k: bearings from k to k + 1 degrees, counted from x towards y of the base frame */
} sk_sectors;

typedef struct sk_separation_rules {
  int32_t approach_mm_s; /* K */
  int32_t intrusion_mm;  /* C */
  int32_t detect_us;     /* from somebody's first returns to the stop that he causes, at most; gaps are remembered for as long */
} sk_separation_rules;

typedef struct sk_separation {
  int32_t sector;  /* the worst */
  int32_t stop_us; /* the most stopping time that is left; -1: none, motion is denied */
} sk_separation;

/*@ logic integer sk_unseen(integer seen, integer now) =
  @   seen < 0 || now < seen || now - seen > SK_BLIND_MOST_US ? SK_BLIND_MOST_US : now - seen;
  @ predicate sk_sector_valid{L}(sk_sector *s) = -1 <= \at(s->seen_us, L) && 0 <= \at(s->window_us, L) &&
  @   (\at(s->window_us, L) <= \at(s->seen_us, L) || \at(s->window_us, L) == 0) &&
  @   0 <= \at(s->gap_us, L) <= SK_BLIND_MOST_US && 0 <= \at(s->gap_before_us, L) <= SK_BLIND_MOST_US;
  @ // a gap that ended then counts still
  @ predicate sk_remembers{L}(sk_sector *s, integer memory, integer ended, integer gap) =
  @   (gap <= \at(s->gap_us, L) && ended <= \at(s->window_us, L) + memory) || (gap <= \at(s->gap_before_us, L) && ended <= \at(s->window_us, L));
  @ predicate sk_sees{L}(sk_sector *s, integer now, integer memory) = 0 <= now && \at(s->seen_us, L) <= now && 0 <= memory;
  @ predicate sk_sector_kept{A, B}(sk_sector *s) = \at(s->seen_us, A) == \at(s->seen_us, B) && \at(s->window_us, A) == \at(s->window_us, B) &&
  @   \at(s->gap_us, A) == \at(s->gap_us, B) && \at(s->gap_before_us, A) == \at(s->gap_before_us, B);
  @ // for how long somebody may have been in the sector, at most, of whom nothing is known
  @ predicate sk_blind_is{L}(sk_sector *s, integer now, integer blind) =
  @   sk_unseen(\at(s->seen_us, L), now) <= blind && \at(s->gap_us, L) <= blind && \at(s->gap_before_us, L) <= blind &&
  @   (blind == sk_unseen(\at(s->seen_us, L), now) || blind == \at(s->gap_us, L) || blind == \at(s->gap_before_us, L));
  @ predicate sk_sectors_valid{L}(sk_sectors *s) = \forall integer k; 0 <= k < SK_SECTORS ==> sk_sector_valid{L}(&s->sector[k]);
  @ predicate sk_separation_rules_fit(sk_separation_rules r) = SK_APPROACH_LEAST_MM_S <= r.approach_mm_s <= SK_APPROACH_MOST_MM_S &&
  @   0 <= r.intrusion_mm <= SK_INTRUSION_MOST_MM && 0 <= r.detect_us <= SK_DETECT_MOST_US;
  @ // S for a time in us, whole millimetres rounded up
  @ logic integer sk_distance_of(integer approach, integer time_us, integer intrusion) = (approach * time_us + 999999) / 1000000 + intrusion;
  @ // S is not more than the distance; no rounding
  @ predicate sk_keeps(sk_separation_rules r, integer time_us, integer distance) =
  @   r.approach_mm_s * time_us <= (distance - r.intrusion_mm) * 1000000;
  @*/

/* S (mm, rounded up) for T = time_us; -1 where an argument is out of its range. */
/*@ assigns \nothing;
  @ ensures invalid: \result == -1 <==> !(0 <= approach_mm_s <= SK_APPROACH_MOST_MM_S && 0 <= time_us <= SK_SEPARATION_TIME_MOST_US &&
  @   0 <= intrusion_mm <= SK_INTRUSION_MOST_MM);
  @ ensures distance: \result != -1 ==> \result == sk_distance_of(approach_mm_s, time_us, intrusion_mm);
  @*/
int64_t sk_separation_distance(int32_t approach_mm_s, int64_t time_us, int32_t intrusion_mm);

/* Nothing was ever seen. */
/*@ requires \valid(s);
  @ assigns s->sector[0 .. SK_SECTORS - 1];
  @ ensures valid: sk_sectors_valid(s);
  @ ensures unseen: \forall integer k; 0 <= k < SK_SECTORS ==> s->sector[k].seen_us == -1;
  @*/
void sk_sectors_begin(sk_sectors *s);

/* The sector is seen now. Nothing changes when time has run backwards. The first look ends no gap: who is there is the monitor's ground. */
/*@ requires \valid(s) && sk_sector_valid(s);
  @ assigns *s;
  @ ensures valid: sk_sector_valid(s);
  @ ensures refused: !sk_sees{Pre}(s, now_us, memory_us) ==> sk_sector_kept{Pre, Post}(s);
  @ ensures seen: sk_sees{Pre}(s, now_us, memory_us) ==> s->seen_us == now_us;
  @ ensures gap: sk_sees{Pre}(s, now_us, memory_us) && 0 <= \old(s->seen_us) ==>
  @   sk_remembers(s, memory_us, now_us, sk_unseen(\old(s->seen_us), now_us));
  @ ensures remembered: sk_sees{Pre}(s, now_us, memory_us) ==> \forall integer ended, gap;
  @   ended <= now_us <= ended + memory_us && sk_remembers{Pre}(s, memory_us, ended, gap) ==> sk_remembers(s, memory_us, ended, gap);
  @*/
void sk_sector_see(sk_sector *s, int64_t now_us, int32_t memory_us);

/* The longest time for which somebody may have been in the sector, of whom nothing is known yet: since it was last seen, or a remembered gap. */
/*@ requires \valid_read(s) && sk_sector_valid(s);
  @ assigns \nothing;
  @ ensures range: 0 <= \result <= SK_BLIND_MOST_US;
  @ ensures blind: sk_blind_is(s, now_us, \result);
  @ ensures remembered: \forall integer memory, ended, gap; sk_remembers(s, memory, ended, gap) ==> gap <= \result;
  @*/
int32_t sk_sector_blind(const sk_sector *s, int64_t now_us);

/* The first of the sectors whose blind time is the longest. */
/*@ requires \valid_read(s) && sk_sectors_valid(s);
  @ assigns \nothing;
  @ ensures range: 0 <= \result < SK_SECTORS;
  @ ensures worst: \forall integer k, here, worst; 0 <= k < SK_SECTORS && sk_blind_is(&s->sector[k], now_us, here) &&
  @   sk_blind_is(&s->sector[\result], now_us, worst) ==> here <= worst;
  @*/
int32_t sk_sectors_worst(const sk_sectors *s, int64_t now_us);

/* The most stopping time (us) with which S is not more than distance_mm where somebody may have gone unnoticed for blind_us; -1 where there is none,
 * or an argument is out of its range. */
/*@ assigns \nothing;
  @ ensures range: -1 <= \result <= SK_BLIND_MOST_US;
  @ ensures fits: 0 <= \result ==> sk_separation_rules_fit(r) && 0 <= blind_us <= SK_BLIND_MOST_US;
  @ ensures kept: 0 <= \result ==> sk_keeps(r, blind_us + r.detect_us + \result, distance_mm);
  @ ensures most: sk_separation_rules_fit(r) && 0 <= blind_us <= SK_BLIND_MOST_US && distance_mm <= SK_COORD_MAX_MM ==>
  @   !sk_keeps(r, blind_us + r.detect_us + \result + 1, distance_mm);
  @ ensures unseen: blind_us == SK_BLIND_MOST_US ==> \result == -1;
  @*/
int32_t sk_separation_stop_time(sk_separation_rules r, int32_t blind_us, int32_t distance_mm);

/* The same of the worst sector, and so of all. */
/*@ requires \valid_read(s) && sk_sectors_valid(s);
  @ assigns \nothing;
  @ ensures range: 0 <= \result.sector < SK_SECTORS && -1 <= \result.stop_us <= SK_BLIND_MOST_US;
  @ ensures everywhere: 0 <= \result.stop_us ==> \forall integer k, blind; 0 <= k < SK_SECTORS && sk_blind_is(&s->sector[k], now_us, blind) ==>
  @   sk_keeps(r, blind + r.detect_us + \result.stop_us, distance_mm);
  @ ensures most: sk_separation_rules_fit(r) && distance_mm <= SK_COORD_MAX_MM ==> \exists integer blind;
  @   sk_blind_is(&s->sector[\result.sector], now_us, blind) && !sk_keeps(r, blind + r.detect_us + \result.stop_us + 1, distance_mm);
  @*/
sk_separation sk_separate(const sk_sectors *s, int64_t now_us, sk_separation_rules r, int32_t distance_mm);

SK_END
#endif
