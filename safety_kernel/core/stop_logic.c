#include "stop_logic.h"

/* What this cycle's inputs ask for. */
typedef struct stop_demand {
  uint8_t rank;   /* of the highest reason present */
  uint8_t reason;
  bool cut;       /* power is to be removed at once */
  bool go;        /* nothing but the reasons, and the interlock in STANDBY, is in the way of motion */
  bool off;       /* the run switch is seen off */
} stop_demand;

/*@ predicate demand_ok(stop_demand d) =
  @   d.rank <= SK_RANK_FAULT && d.reason < BERM_STOP_REASONS && (d.reason == 0 <==> d.rank == SK_RANK_NONE) &&
  @   (d.cut == true ==> d.rank >= SK_RANK_LATCH) && (d.go == true ==> d.off == false);
  @ predicate stopping_shape(sk_stop_state *s) = sk_stop_paused(s) || sk_stop_held(s) || sk_stop_latching(s) || sk_stop_faulting(s);
  @ predicate rank_joined(integer before, integer asked, integer now) = now == (asked > before ? asked : before);
  @*/

/*@ requires \valid_read(in);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_stop_wild(in);
  @*/
static bool wild(const sk_stop_input *in)
{
  return in->fault_reason >= BERM_STOP_REASONS || in->latch_reason >= BERM_STOP_REASONS || in->hold_reason >= BERM_STOP_REASONS;
}

/*@ requires \valid_read(in);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_stop_cut(in);
  @*/
static bool cut(const sk_stop_input *in)
{
  bool by_fault = in->fault_reason != 0U && in->fault_category_0;
  bool by_latch = in->latch_reason != 0U && in->latch_category_0;
  return by_fault || by_latch || wild(in);
}

/*@ requires \valid_read(in);
  @ assigns \nothing;
  @ ensures \result == SK_RANK_FAULT <==> sk_stop_fault(in);
  @ ensures \result == SK_RANK_LATCH <==> sk_stop_latch(in);
  @ ensures \result == SK_RANK_HOLD <==> sk_stop_hold(in);
  @ ensures \result == SK_RANK_NONE <==> sk_stop_quiet(in);
  @ ensures 0 <= \result <= SK_RANK_FAULT;
  @*/
static uint8_t input_rank(const sk_stop_input *in)
{
  if (in->fault_reason != 0U || wild(in)) { return SK_RANK_FAULT; }
  if (in->latch_reason != 0U) { return SK_RANK_LATCH; }
  if (in->hold_reason != 0U) { return SK_RANK_HOLD; }
  return SK_RANK_NONE;
}

/* The reason of the highest rank. */
/*@ requires \valid_read(in);
  @ assigns \nothing;
  @ ensures \result < BERM_STOP_REASONS;
  @ ensures \result == 0 <==> sk_stop_quiet(in);
  @*/
static uint8_t input_reason(const sk_stop_input *in)
{
  if (wild(in)) { return BERM_STOP_INTERNAL; }
  if (in->fault_reason != 0U) { return in->fault_reason; }
  if (in->latch_reason != 0U) { return in->latch_reason; }
  return in->hold_reason;
}

/*@ requires \valid_read(in);
  @ assigns \nothing;
  @ ensures demand_ok(\result);
  @ ensures \result.rank == SK_RANK_FAULT <==> sk_stop_fault(in);
  @ ensures \result.rank == SK_RANK_LATCH <==> sk_stop_latch(in);
  @ ensures \result.rank == SK_RANK_HOLD <==> sk_stop_hold(in);
  @ ensures \result.rank == SK_RANK_NONE <==> sk_stop_quiet(in);
  @ ensures \result.cut == true <==> sk_stop_cut(in);
  @ ensures \result.go == true <==> sk_stop_go(in);
  @ ensures \result.off == true <==> sk_stop_off(in);
  @*/
static stop_demand demand_of(const sk_stop_input *in)
{
  stop_demand d;
  d.rank = input_rank(in);
  d.reason = input_reason(in);
  d.cut = cut(in);
  d.go = in->operator_run && in->inputs_ready;
  d.off = in->operator_run_off && !in->operator_run;
  return d;
}

/* STANDBY or RUN: nothing holds. */
/*@ requires \valid(s) && (code == SK_STATE_STANDBY || code == SK_STATE_RUN);
  @ assigns s->code, s->rank, s->reason, s->category, s->latched, s->reset_seen_released;
  @ ensures s->code == code && sk_stop_idle(s);
  @*/
static void enter_idle(sk_stop_state *s, uint16_t code)
{
  s->code = code;
  s->rank = SK_RANK_NONE;
  s->reason = 0U;
  s->category = SK_CATEGORY_NONE;
  s->latched = false;
  s->reset_seen_released = false;
}

/* STOPPED latched, or FAULT. */
/*@ requires \valid(s) && 0 < reason < BERM_STOP_REASONS && category <= SK_CATEGORY_1;
  @ requires (code == SK_STATE_STOPPED && rank == SK_RANK_LATCH) || (code == SK_STATE_FAULT && rank == SK_RANK_FAULT);
  @ assigns s->code, s->run_release, s->rank, s->reason, s->category, s->latched, s->reset_seen_released;
  @ ensures s->code == code && s->rank == rank && s->reason == reason && s->category == category && s->latched == true;
  @ ensures s->reset_seen_released == false && s->run_release == SK_RELEASE_AWAITED && sk_stop_valid(s);
  @*/
static void enter_latched(sk_stop_state *s, uint16_t code, uint8_t rank, uint8_t reason, uint8_t category)
{
  s->code = code;
  s->rank = rank;
  s->reason = reason;
  s->category = category;
  s->latched = true;
  s->reset_seen_released = false;
  s->run_release = SK_RELEASE_AWAITED;
}

/* Takes up what is asked for: a higher rank replaces rank and reason; power that is to be removed at once stays so. */
/*@ requires \valid(s) && demand_ok(d) && stopping_shape(s);
  @ assigns s->run_release, s->rank, s->reason, s->category, s->latched, s->reset_seen_released;
  @ ensures stopping_shape(s);
  @ ensures release: s->run_release == (d.rank >= SK_RANK_LATCH ? SK_RELEASE_AWAITED : \old(s->run_release));
  @ ensures rank_joined(\old(s->rank), d.rank, s->rank);
  @ ensures kept: d.rank <= \old(s->rank) ==> s->reason == \old(s->reason) && s->latched == \old(s->latched) &&
  @   s->reset_seen_released == \old(s->reset_seen_released);
  @ ensures taken: d.rank > \old(s->rank) ==> s->reason == d.reason && s->reset_seen_released == false;
  @ ensures cuts: s->category == SK_CATEGORY_0 <==> d.cut == true || \old(s->category) == SK_CATEGORY_0;
  @*/
static void take_up(sk_stop_state *s, stop_demand d)
{
  if (d.rank > s->rank) {
    s->rank = d.rank;
    s->reason = d.reason;
    s->latched = d.rank >= SK_RANK_LATCH;
    s->reset_seen_released = false;
  }
  if (d.rank >= SK_RANK_LATCH) { s->run_release = SK_RELEASE_AWAITED; }
  if (d.cut) { s->category = SK_CATEGORY_0; }
  if (s->category != SK_CATEGORY_0) { s->category = s->rank == SK_RANK_HOLD ? SK_CATEGORY_HELD : SK_CATEGORY_1; }
}

/* From INIT, STANDBY: no motion, so a stop is complete at once. */
/*@ requires \valid(s) && demand_ok(d) && sk_stop_valid(s) && (s->code == SK_STATE_INIT || s->code == SK_STATE_STANDBY);
  @ assigns s->code, s->run_release, s->rank, s->reason, s->category, s->latched, s->reset_seen_released;
  @ ensures sk_stop_valid(s);
  @ ensures fault: s->code == SK_STATE_FAULT <==> d.rank == SK_RANK_FAULT;
  @ ensures latch: s->code == SK_STATE_STOPPED <==> d.rank == SK_RANK_LATCH && \old(s->code) == SK_STATE_STANDBY;
  @ ensures run: s->code == SK_STATE_RUN <==> d.rank == SK_RANK_NONE && d.go == true && settled == true &&
  @   \old(s->code) == SK_STATE_STANDBY && \old(s->run_release) == SK_RELEASE_SEEN;
  @ ensures release: s->latched == false ==> s->run_release ==
  @   (\old(s->code) == SK_STATE_STANDBY && s->code == SK_STATE_STANDBY && d.off == true ? SK_RELEASE_SEEN : \old(s->run_release));
  @ ensures init: s->code == SK_STATE_INIT ==> \old(s->code) == SK_STATE_INIT;
  @ ensures init_latch: \old(s->code) == SK_STATE_INIT && d.rank == SK_RANK_LATCH ==> s->code == SK_STATE_INIT;
  @ ensures cut: d.cut == true && s->code != SK_STATE_INIT ==> s->category == SK_CATEGORY_0;
  @ ensures rest: s->code != SK_STATE_STOPPING && (s->code == SK_STATE_STOPPED ==> s->latched == true);
  @*/
static void step_idle(sk_stop_state *s, stop_demand d, bool inputs_ready, bool settled)
{
  uint8_t category = d.cut ? SK_CATEGORY_0 : SK_CATEGORY_1;
  if (d.rank == SK_RANK_FAULT) {
    enter_latched(s, SK_STATE_FAULT, SK_RANK_FAULT, d.reason, category);
  } else if (s->code == SK_STATE_INIT) {
    if (d.rank != SK_RANK_LATCH && inputs_ready) { enter_idle(s, SK_STATE_STANDBY); }
  } else if (d.rank == SK_RANK_LATCH) {
    enter_latched(s, SK_STATE_STOPPED, SK_RANK_LATCH, d.reason, category);
  } else if (d.off) {
    s->run_release = SK_RELEASE_SEEN;
  } else if (d.rank == SK_RANK_NONE && d.go && settled && s->run_release == SK_RELEASE_SEEN) {
    enter_idle(s, SK_STATE_RUN);
  }
}

/* From RUN. */
/*@ requires \valid(s) && demand_ok(d) && sk_stop_valid(s) && s->code == SK_STATE_RUN;
  @ assigns s->code, s->run_release, s->rank, s->reason, s->category, s->latched, s->reset_seen_released;
  @ ensures sk_stop_valid(s);
  @ ensures run: s->code == SK_STATE_RUN <==> d.rank == SK_RANK_NONE && d.go == true;
  @ ensures stop: s->code == SK_STATE_RUN || s->code == SK_STATE_STOPPING || s->code == SK_STATE_FAULT;
  @ ensures release: s->latched == false ==> s->run_release == \old(s->run_release);
  @ ensures rank: s->rank == d.rank;
  @ ensures cut: d.cut == true ==> s->category == SK_CATEGORY_0;
  @*/
static void step_run(sk_stop_state *s, stop_demand d)
{
  if (d.rank == SK_RANK_NONE && d.go) { return; }
  s->category = SK_CATEGORY_1;
  take_up(s, d);
  if (s->rank == SK_RANK_FAULT && s->category == SK_CATEGORY_0) {
    enter_latched(s, SK_STATE_FAULT, SK_RANK_FAULT, s->reason, SK_CATEGORY_0);
  } else {
    s->code = SK_STATE_STOPPING;
  }
}

/* At standstill: where a stop of this rank ends. */
/*@ requires \valid(s) && stopping_shape(s);
  @ requires s->run_release == (s->latched == true ? SK_RELEASE_AWAITED : SK_RELEASE_SEEN);
  @ assigns s->code, s->rank, s->reason, s->category, s->latched, s->reset_seen_released;
  @ ensures sk_stop_valid(s);
  @ ensures \old(s->rank) == SK_RANK_FAULT ==> s->code == SK_STATE_FAULT;
  @ ensures \old(s->rank) == SK_RANK_LATCH || \old(s->rank) == SK_RANK_HOLD ==> s->code == SK_STATE_STOPPED;
  @ ensures \old(s->rank) == SK_RANK_NONE ==> s->code == SK_STATE_STANDBY;
  @ ensures \old(s->rank) != SK_RANK_NONE ==> s->rank == \old(s->rank) && s->reason == \old(s->reason) &&
  @   s->category == \old(s->category) && s->latched == \old(s->latched);
  @*/
static void come_to_rest(sk_stop_state *s)
{
  if (s->rank == SK_RANK_NONE) { enter_idle(s, SK_STATE_STANDBY); }
  else if (s->rank == SK_RANK_FAULT) { s->code = SK_STATE_FAULT; }
  else { s->code = SK_STATE_STOPPED; }
}

/*@ requires \valid_read(s) && \valid_read(in);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_stop_overdue(s, in);
  @*/
static bool is_overdue(const sk_stop_state *s, const sk_stop_input *in)
{
  return s->since_us < 0 || in->now_us < s->since_us || in->now_us - s->since_us > SK_STOPPING_LIMIT_US;
}

/* From STOPPING. */
/*@ requires \valid(s) && demand_ok(d) && s->code == SK_STATE_STOPPING && sk_stop_valid(s);
  @ assigns s->code, s->run_release, s->rank, s->reason, s->category, s->latched, s->reset_seen_released;
  @ ensures sk_stop_valid(s);
  @ ensures codes: s->code == SK_STATE_STOPPING || s->code == SK_STATE_STOPPED || s->code == SK_STATE_STANDBY || s->code == SK_STATE_FAULT;
  @ ensures standby: s->code == SK_STATE_STANDBY ==> \old(s->rank) == SK_RANK_NONE && d.rank == SK_RANK_NONE;
  @ ensures release: s->latched == false ==> s->run_release == \old(s->run_release);
  @ ensures rank: s->code != SK_STATE_STANDBY ==> s->rank >= d.rank && s->rank >= \old(s->rank);
  @ ensures first: s->rank == \old(s->rank) ==> s->reason == \old(s->reason);
  @ ensures cut: d.cut == true || \old(s->category) == SK_CATEGORY_0 ==> s->category == SK_CATEGORY_0;
  @ ensures bounded: s->code == SK_STATE_STOPPING ==> standstill == false && overdue == false;
  @*/
static void step_stopping(sk_stop_state *s, stop_demand d, bool standstill, bool overdue)
{
  take_up(s, d);
  if (s->rank == SK_RANK_FAULT && s->category == SK_CATEGORY_0) {
    s->code = SK_STATE_FAULT;
  } else if (standstill) {
    come_to_rest(s);
  } else if (overdue) {
    uint8_t reason = s->rank == SK_RANK_FAULT ? s->reason : (uint8_t)BERM_STOP_BRAKING;
    enter_latched(s, SK_STATE_FAULT, SK_RANK_FAULT, reason, SK_CATEGORY_0);
  }
}

/* A time of the last hold reason that cannot be is none: nothing but the wait depends on it. */
bool sk_stop_is_settled(const sk_stop_state *s, const sk_stop_input *in)
{
  return s->hold_seen_us < 0 || in->now_us < s->hold_seen_us || in->now_us - s->hold_seen_us >= SK_RESUME_QUIET_US;
}

/* From STOPPED for a hold reason: power is on, the machine stands. */
/*@ requires \valid(s) && demand_ok(d) && sk_stop_valid(s) && sk_stop_held(s) && s->code == SK_STATE_STOPPED;
  @ assigns s->code, s->run_release, s->rank, s->reason, s->category, s->latched, s->reset_seen_released;
  @ ensures sk_stop_valid(s);
  @ ensures codes: s->code == SK_STATE_RUN || s->code == SK_STATE_STANDBY || s->code == SK_STATE_STOPPED || s->code == SK_STATE_FAULT;
  @ ensures run: s->code == SK_STATE_RUN <==> d.rank == SK_RANK_NONE && d.go == true && settled == true;
  @ ensures standby: s->code == SK_STATE_STANDBY ==> d.rank <= SK_RANK_HOLD;
  @ ensures release: s->latched == false ==> s->run_release == \old(s->run_release);
  @ ensures fault: s->code == SK_STATE_FAULT <==> d.rank == SK_RANK_FAULT;
  @ ensures latch: d.rank == SK_RANK_LATCH <==> s->rank == SK_RANK_LATCH;
  @ ensures first: s->rank == SK_RANK_HOLD ==> s->reason == \old(s->reason);
  @ ensures cut: d.cut == true ==> s->category == SK_CATEGORY_0;
  @*/
static void step_held(sk_stop_state *s, stop_demand d, bool settled)
{
  if (d.rank >= SK_RANK_LATCH) {
    take_up(s, d);
    come_to_rest(s);
  } else if (!d.go) {
    enter_idle(s, SK_STATE_STANDBY);
  } else if (d.rank == SK_RANK_NONE && settled) {
    enter_idle(s, SK_STATE_RUN);
  }
}

/* From STOPPED latched, or FAULT. */
/*@ requires \valid(s) && demand_ok(d) && s->latched == true && sk_stop_valid(s);
  @ requires s->code == SK_STATE_STOPPED || s->code == SK_STATE_FAULT;
  @ assigns s->code, s->run_release, s->rank, s->reason, s->category, s->latched, s->reset_seen_released;
  @ ensures sk_stop_valid(s);
  @ ensures codes: s->code == SK_STATE_STANDBY || s->code == SK_STATE_STOPPED || s->code == SK_STATE_FAULT;
  @ ensures fault: \old(s->code) == SK_STATE_FAULT ==> s->code != SK_STATE_STOPPED;
  @ ensures reset: s->code == SK_STATE_STANDBY <==>
  @   d.rank == SK_RANK_NONE && standstill == true && reset == true && \old(s->reset_seen_released) == true;
  @ ensures rank: s->code != SK_STATE_STANDBY ==> s->latched == true && rank_joined(\old(s->rank), d.rank, s->rank);
  @ ensures first: s->rank == \old(s->rank) ==> s->reason == \old(s->reason);
  @ ensures cut: s->latched == true && (d.cut == true || \old(s->category) == SK_CATEGORY_0) ==> s->category == SK_CATEGORY_0;
  @ ensures released: reset == false ==> s->reset_seen_released == true;
  @ ensures release: s->run_release == SK_RELEASE_AWAITED;
  @*/
static void step_latched(sk_stop_state *s, stop_demand d, bool standstill, bool reset)
{
  if (d.rank == SK_RANK_NONE && standstill && reset && s->reset_seen_released) {
    enter_idle(s, SK_STATE_STANDBY);
    return;
  }
  take_up(s, d);
  come_to_rest(s);
  if (!reset) { s->reset_seen_released = true; }
}

/*@ requires \valid(s) && demand_ok(d) && \valid_read(in) && \separated(s, in) && sk_stop_valid(s);
  @ assigns s->code, s->run_release, s->rank, s->reason, s->category, s->latched, s->reset_seen_released;
  @ ensures sk_stop_valid(s);
  @ ensures run: s->code == SK_STATE_RUN <==> d.rank == SK_RANK_NONE && d.go == true && \old(s->latched) == false &&
  @   (\old(s->code) == SK_STATE_RUN || (sk_stop_settled{Pre}(s, in) && (\old(s->code) == SK_STATE_STOPPED ||
  @    (\old(s->code) == SK_STATE_STANDBY && \old(s->run_release) == SK_RELEASE_SEEN))));
  @ ensures release: s->latched == false ==> s->run_release ==
  @   (\old(s->code) == SK_STATE_STANDBY && s->code == SK_STATE_STANDBY && d.off == true ? SK_RELEASE_SEEN : \old(s->run_release));
  @ ensures init: s->code == SK_STATE_INIT ==> \old(s->code) == SK_STATE_INIT;
  @ ensures fault: d.rank == SK_RANK_FAULT ==> s->rank == SK_RANK_FAULT;
  @ ensures latch: d.rank == SK_RANK_LATCH && \old(s->code) != SK_STATE_INIT ==> s->latched == true;
  @ ensures init_latch: d.rank == SK_RANK_LATCH && \old(s->code) == SK_STATE_INIT ==> s->code == SK_STATE_INIT;
  @ ensures stays: \old(s->code) == SK_STATE_FAULT ==> s->code == SK_STATE_FAULT || s->code == SK_STATE_STANDBY;
  @ ensures latched: \old(s->latched) == true ==> s->latched == true || s->code == SK_STATE_STANDBY;
  @ ensures reset: \old(s->latched) == true ==> (s->code == SK_STATE_STANDBY <==> \old(s->code) != SK_STATE_STOPPING &&
  @   d.rank == SK_RANK_NONE && in->standstill == true && in->operator_reset == true && \old(s->reset_seen_released) == true);
  @ ensures first: \old(s->rank) != 0 && s->rank != 0 ==>
  @   s->rank > \old(s->rank) || (s->rank == \old(s->rank) && s->reason == \old(s->reason));
  @ ensures cut: d.cut == true && s->code != SK_STATE_INIT ==> s->category == SK_CATEGORY_0;
  @ ensures no_weaker: \old(s->category) == SK_CATEGORY_0 && s->latched == true ==> s->category == SK_CATEGORY_0;
  @ ensures bounded: \old(s->code) == SK_STATE_STOPPING && s->code == SK_STATE_STOPPING ==>
  @   in->standstill == false && !sk_stop_overdue{Pre}(s, in);
  @*/
static void advance(sk_stop_state *s, stop_demand d, const sk_stop_input *in)
{
  if (s->code == SK_STATE_RUN) { step_run(s, d); }
  else if (s->code == SK_STATE_STOPPING) { step_stopping(s, d, in->standstill, is_overdue(s, in)); }
  else if (s->latched) { step_latched(s, d, in->standstill, in->operator_reset); }
  else if (s->code == SK_STATE_STOPPED) { step_held(s, d, sk_stop_is_settled(s, in)); }
  else { step_idle(s, d, in->inputs_ready, sk_stop_is_settled(s, in)); }
}

/*@ requires \valid_read(s) && sk_stop_shaped(s);
  @ assigns \nothing;
  @ ensures \result == true <==> s->code == SK_STATE_RUN || (s->code == SK_STATE_STOPPING && s->category != SK_CATEGORY_0) ||
  @   (s->code == SK_STATE_STOPPED && s->latched == false);
  @ ensures s->category == SK_CATEGORY_0 ==> \result == false;
  @*/
static bool keeps_power(const sk_stop_state *s)
{
  if (s->code == SK_STATE_STOPPING) { return s->category != SK_CATEGORY_0; }
  if (s->code == SK_STATE_STOPPED) { return !s->latched; }
  return s->code == SK_STATE_RUN;
}

void sk_stop_step(sk_stop_state *s, const sk_stop_input *in, sk_stop_output *out)
{
  stop_demand d = demand_of(in);
  uint16_t before = s->code;
  if (sk_stop_is_valid(s)) { advance(s, d, in); }
  else { enter_latched(s, SK_STATE_FAULT, SK_RANK_FAULT, BERM_STOP_INTERNAL, SK_CATEGORY_0); }
  if (s->code != before) { s->since_us = in->now_us; }
  if (in->hold_reason != 0U) { s->hold_seen_us = in->now_us; }
  bool powered = keeps_power(s);
  out->motion_enabled = s->code == SK_STATE_RUN;
  out->heartbeat_enable = powered;
}
