/* Which states of the stop logic there are, and the one that it begins with. */
#include "stop_logic.h"

void sk_stop_init(sk_stop_state *s)
{
  s->code = SK_STATE_INIT;
  s->run_release = SK_RELEASE_AWAITED;
  s->reason = 0U;
  s->category = SK_CATEGORY_NONE;
  s->rank = SK_RANK_NONE;
  s->latched = false;
  s->reset_seen_released = false;
  s->since_us = 0;
  s->hold_seen_us = -1;
}

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_stop_idle(s);
  @*/
static bool idle(const sk_stop_state *s)
{
  return s->rank == SK_RANK_NONE && s->reason == 0U && s->category == SK_CATEGORY_NONE && !s->latched;
}

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_stop_paused(s);
  @*/
static bool paused(const sk_stop_state *s)
{
  return s->rank == SK_RANK_NONE && s->reason == 0U && s->category == SK_CATEGORY_1 && !s->latched;
}

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_stop_held(s);
  @*/
static bool held(const sk_stop_state *s)
{
  return s->rank == SK_RANK_HOLD && s->reason > 0U && s->reason < BERM_STOP_REASONS && s->category == SK_CATEGORY_HELD && !s->latched;
}

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> s->rank == rank && 0 < s->reason < BERM_STOP_REASONS && s->category <= SK_CATEGORY_1 && s->latched == true;
  @*/
static bool latched_at(const sk_stop_state *s, uint8_t rank)
{
  return s->rank == rank && s->reason > 0U && s->reason < BERM_STOP_REASONS && s->category <= SK_CATEGORY_1 && s->latched;
}

/* What is latched, and what has not begun, still awaits the release; what runs, or resumes by itself, has had it. */
/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_stop_release_fits(s);
  @*/
static bool release_fits(const sk_stop_state *s)
{
  if (s->run_release == SK_RELEASE_SEEN) { return s->code != SK_STATE_INIT && !s->latched; }
  if (s->run_release != SK_RELEASE_AWAITED) { return false; }
  return s->code == SK_STATE_INIT || s->code == SK_STATE_STANDBY || s->latched;
}

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_stop_shaped(s);
  @*/
static bool shaped(const sk_stop_state *s)
{
  if (s->code == SK_STATE_INIT || s->code == SK_STATE_STANDBY || s->code == SK_STATE_RUN) { return idle(s); }
  if (s->code == SK_STATE_STOPPED) { return held(s) || latched_at(s, SK_RANK_LATCH); }
  if (s->code == SK_STATE_FAULT) { return latched_at(s, SK_RANK_FAULT); }
  if (s->code != SK_STATE_STOPPING) { return false; }
  return paused(s) || held(s) || latched_at(s, SK_RANK_LATCH) || (latched_at(s, SK_RANK_FAULT) && s->category == SK_CATEGORY_1);
}

bool sk_stop_is_valid(const sk_stop_state *s)
{
  return shaped(s) && release_fits(s);
}
