/* Stop logic: INIT, STANDBY, RUN, STOPPING, STOPPED, FAULT. What latches, what resumes by itself, what needs the operator. */
#ifndef SK_STOP_LOGIC_H
#define SK_STOP_LOGIC_H
#include "sk_common.h"
#include "contract/berm_contract.h"
SK_BEGIN

/* far-apart codes: no single, double or triple bit flip turns one into another */
#define SK_STATE_INIT     0x1E2Du
#define SK_STATE_STANDBY  0x5A3Cu
#define SK_STATE_RUN      0xA5C3u
#define SK_STATE_STOPPING 0xC35Au
#define SK_STATE_STOPPED  0x3CA5u
#define SK_STATE_FAULT    0x6996u

/* Whether the run switch was seen off, in STANDBY, since the start or the last latched stop: else RUN must not begin. Far apart as well: no flipped
   bits let a machine go whose switch was left on. */
#define SK_RELEASE_AWAITED 0x2D96u
#define SK_RELEASE_SEEN    0xD269u

/* Ranks of what holds: a higher one replaces a lower one, an equal one does not. */
#define SK_RANK_NONE 0u
#define SK_RANK_HOLD 1u   /* resumes by itself */
#define SK_RANK_LATCH 2u  /* needs the operator */
#define SK_RANK_FAULT 3u  /* needs the operator */

#define SK_CATEGORY_0 0u      /* power removed at once */
#define SK_CATEGORY_1 1u      /* braked, then power removed */
#define SK_CATEGORY_HELD 2u   /* braked, power kept */
#define SK_CATEGORY_NONE 255u

#define SK_STOPPING_LIMIT_US 6000000 /* a stop that has not come to standstill by then is a fault (BERM_STOP_BRAKING), category 0 */
#define SK_RESUME_QUIET_US 300000    /* RUN begins, and resumes, when no hold reason was seen for so long: noise must not start and stop the machine */

/* Inputs of one cycle. reason codes are BERM_STOP_* of the contract; a code that is none of them is read as the fault BERM_STOP_INTERNAL. */
typedef struct sk_stop_input {
  int64_t now_us;
  uint8_t fault_reason;      /* BERM_STOP_* of a fault seen in this cycle, or 0: latches FAULT */
  bool fault_category_0;     /* that fault removes power at once */
  uint8_t latch_reason;      /* operator, e-stop, app silent: latches STOPPED, or 0 */
  bool latch_category_0;
  uint8_t hold_reason;       /* collision predicted, unknown, stale, floor, range, request hold: stops, resumes by itself, or 0 */
  bool inputs_ready;         /* parameters in force, first frames of machine and operator seen, scanners alive */
  bool standstill;
  bool operator_run;         /* run switch on */
  bool operator_run_off;     /* run switch heard off; what is not heard is neither on nor off */
  bool operator_reset;       /* reset key, level */
} sk_stop_input;

typedef struct sk_stop_state {
  uint16_t code;
  uint16_t run_release;      /* SK_RELEASE_* */
  uint8_t reason;            /* in force; 0 in RUN, and in STOPPING because the run switch was released */
  uint8_t category;          /* SK_CATEGORY_*: 0, 1, 2 held for a hold reason, 255 none */
  uint8_t rank;              /* SK_RANK_* of reason */
  bool latched;
  bool reset_seen_released;  /* a reset counts only after the key was seen released in this latched stop */
  int64_t since_us;          /* when this state was entered */
  int64_t hold_seen_us;      /* the last cycle with a hold reason; -1: none yet */
} sk_stop_state;

typedef struct sk_stop_output {
  bool motion_enabled;       /* commands of the request may be sent */
  bool heartbeat_enable;     /* the machine keeps pilot pressure */
} sk_stop_output;

/*@ predicate sk_stop_wild(sk_stop_input *i) =
  @   i->fault_reason >= BERM_STOP_REASONS || i->latch_reason >= BERM_STOP_REASONS || i->hold_reason >= BERM_STOP_REASONS;
  @ predicate sk_stop_fault(sk_stop_input *i) = i->fault_reason != 0 || sk_stop_wild(i);
  @ predicate sk_stop_latch(sk_stop_input *i) = i->latch_reason != 0 && !sk_stop_fault(i);
  @ predicate sk_stop_hold(sk_stop_input *i) = i->hold_reason != 0 && i->latch_reason == 0 && !sk_stop_fault(i);
  @ predicate sk_stop_quiet(sk_stop_input *i) = i->fault_reason == 0 && i->latch_reason == 0 && i->hold_reason == 0;
  @ predicate sk_stop_cut(sk_stop_input *i) =
  @   (i->fault_reason != 0 && i->fault_category_0 == true) || (i->latch_reason != 0 && i->latch_category_0 == true) || sk_stop_wild(i);
  @ predicate sk_stop_go(sk_stop_input *i) = i->operator_run == true && i->inputs_ready == true;
  @ predicate sk_stop_off(sk_stop_input *i) = i->operator_run == false && i->operator_run_off == true;
  @ predicate sk_stop_reset(sk_stop_state *s, sk_stop_input *i) =
  @   i->operator_reset == true && s->reset_seen_released == true && i->standstill == true && sk_stop_quiet(i);
  @ predicate sk_stop_overdue(sk_stop_state *s, sk_stop_input *i) =
  @   !(0 <= s->since_us <= i->now_us && i->now_us - s->since_us <= SK_STOPPING_LIMIT_US);
  @ predicate sk_stop_settled(sk_stop_state *s, sk_stop_input *i) =
  @   !(0 <= s->hold_seen_us <= i->now_us && i->now_us - s->hold_seen_us < SK_RESUME_QUIET_US);
  @
  @ predicate sk_stop_idle(sk_stop_state *s) =
  @   s->rank == SK_RANK_NONE && s->reason == 0 && s->category == SK_CATEGORY_NONE && s->latched == false;
  @ predicate sk_stop_paused(sk_stop_state *s) =
  @   s->rank == SK_RANK_NONE && s->reason == 0 && s->category == SK_CATEGORY_1 && s->latched == false;
  @ predicate sk_stop_held(sk_stop_state *s) =
  @   s->rank == SK_RANK_HOLD && 0 < s->reason < BERM_STOP_REASONS && s->category == SK_CATEGORY_HELD && s->latched == false;
  @ predicate sk_stop_latching(sk_stop_state *s) =
  @   s->rank == SK_RANK_LATCH && 0 < s->reason < BERM_STOP_REASONS && s->category <= SK_CATEGORY_1 && s->latched == true;
  @ predicate sk_stop_faulting(sk_stop_state *s) =
  @   s->rank == SK_RANK_FAULT && 0 < s->reason < BERM_STOP_REASONS && s->category <= SK_CATEGORY_1 && s->latched == true;
  @ predicate sk_stop_release_fits(sk_stop_state *s) =
  @   (s->run_release == SK_RELEASE_AWAITED && (s->code == SK_STATE_INIT || s->code == SK_STATE_STANDBY || s->latched == true)) ||
  @   (s->run_release == SK_RELEASE_SEEN && s->code != SK_STATE_INIT && s->latched == false);
  @ predicate sk_stop_shaped(sk_stop_state *s) =
  @   (s->code == SK_STATE_INIT && sk_stop_idle(s)) || (s->code == SK_STATE_STANDBY && sk_stop_idle(s)) ||
  @   (s->code == SK_STATE_RUN && sk_stop_idle(s)) ||
  @   (s->code == SK_STATE_STOPPING && (sk_stop_paused(s) || sk_stop_held(s) || sk_stop_latching(s) ||
  @                                     (sk_stop_faulting(s) && s->category == SK_CATEGORY_1))) ||
  @   (s->code == SK_STATE_STOPPED && (sk_stop_held(s) || sk_stop_latching(s))) ||
  @   (s->code == SK_STATE_FAULT && sk_stop_faulting(s));
  @ predicate sk_stop_valid(sk_stop_state *s) = sk_stop_shaped(s) && sk_stop_release_fits(s);
  @*/

/*@ requires \valid(s);
  @ assigns *s;
  @ ensures sk_stop_valid(s) && s->code == SK_STATE_INIT && s->run_release == SK_RELEASE_AWAITED && s->since_us == 0 && s->hold_seen_us == -1;
  @*/
void sk_stop_init(sk_stop_state *s);

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_stop_valid(s);
  @*/
bool sk_stop_is_valid(const sk_stop_state *s);

/* Whether no hold reason was seen for so long that RUN may begin or resume. */
/*@ requires \valid_read(s) && \valid_read(in);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_stop_settled(s, in);
  @*/
bool sk_stop_is_settled(const sk_stop_state *s, const sk_stop_input *in);

/* Total: a state that is none of the valid ones is read as FAULT (BERM_STOP_INTERNAL), category 0. */
/*@ requires \valid(s) && \valid_read(in) && \valid(out) && \separated(s, in, out);
  @ assigns *s, *out;
  @ ensures valid: sk_stop_shaped(s);
  @ ensures valid_release: sk_stop_release_fits(s);
  @ ensures corrupt: !sk_stop_valid{Pre}(s) ==>
  @   s->code == SK_STATE_FAULT && s->reason == BERM_STOP_INTERNAL && s->category == SK_CATEGORY_0;
  @ ensures motion: out->motion_enabled == true <==> s->code == SK_STATE_RUN;
  @ ensures motion_quiet: s->code == SK_STATE_RUN ==> sk_stop_quiet{Pre}(in);
  @ ensures motion_go: s->code == SK_STATE_RUN ==> sk_stop_go{Pre}(in);
  @ ensures power: out->heartbeat_enable == true <==> s->code == SK_STATE_RUN ||
  @   (s->code == SK_STATE_STOPPING && s->category != SK_CATEGORY_0) || (s->code == SK_STATE_STOPPED && s->latched == false);
  @ ensures cut: sk_stop_cut{Pre}(in) ==> out->heartbeat_enable == false;
  @ ensures no_jump: s->code == SK_STATE_RUN ==> sk_stop_valid{Pre}(s) && \old(s->latched) == false &&
  @   (\old(s->code) == SK_STATE_STANDBY || \old(s->code) == SK_STATE_RUN || \old(s->code) == SK_STATE_STOPPED);
  @ ensures no_init: s->code == SK_STATE_INIT ==> \old(s->code) == SK_STATE_INIT;
  @ ensures latch: sk_stop_valid{Pre}(s) && \old(s->latched) == true ==> s->latched == true || (s->code == SK_STATE_STANDBY &&
  @   sk_stop_reset{Pre}(s, in) && (\old(s->code) == SK_STATE_STOPPED || \old(s->code) == SK_STATE_FAULT));
  @ ensures fault_latches: sk_stop_fault{Pre}(in) ==> s->rank == SK_RANK_FAULT;
  @ ensures latch_latches: sk_stop_latch{Pre}(in) && \old(s->code) != SK_STATE_INIT ==> s->latched == true;
  @ ensures latch_in_init: sk_stop_latch{Pre}(in) && \old(s->code) == SK_STATE_INIT ==> s->code == SK_STATE_INIT || s->code == SK_STATE_FAULT;
  @ ensures hold_stops: sk_stop_hold{Pre}(in) ==> s->code != SK_STATE_RUN;
  @ ensures fault_stays: \old(s->code) == SK_STATE_FAULT ==> s->code == SK_STATE_FAULT || s->code == SK_STATE_STANDBY;
  @ ensures first_reason: sk_stop_valid{Pre}(s) && \old(s->rank) != 0 && s->rank != 0 ==>
  @   s->rank > \old(s->rank) || (s->rank == \old(s->rank) && s->reason == \old(s->reason));
  @ ensures no_weaker: sk_stop_valid{Pre}(s) && \old(s->category) == SK_CATEGORY_0 && s->latched == true ==> s->category == SK_CATEGORY_0;
  @ ensures not_forever: \old(s->code) == SK_STATE_STOPPING && s->code == SK_STATE_STOPPING ==>
  @   in->standstill == false && !sk_stop_overdue{Pre}(s, in);
  @ ensures interlock: s->code == SK_STATE_RUN && \old(s->code) == SK_STATE_STANDBY ==> \old(s->run_release) == SK_RELEASE_SEEN;
  @ ensures interlock_set: s->run_release == SK_RELEASE_SEEN && \old(s->run_release) != SK_RELEASE_SEEN ==>
  @   \old(s->code) == SK_STATE_STANDBY && s->code == SK_STATE_STANDBY && sk_stop_off{Pre}(in);
  @ ensures interlock_anew: s->latched == true || (sk_stop_valid{Pre}(s) && \old(s->latched) == true) || s->code == SK_STATE_INIT ==>
  @   s->run_release == SK_RELEASE_AWAITED;
  @ ensures interlock_seen: sk_stop_valid{Pre}(s) && \old(s->code) == SK_STATE_STANDBY && s->code == SK_STATE_STANDBY && sk_stop_off{Pre}(in) ==>
  @   s->run_release == SK_RELEASE_SEEN;
  @ ensures interlock_kept: \old(s->run_release) == SK_RELEASE_SEEN && s->latched == false ==> s->run_release == SK_RELEASE_SEEN;
  @ ensures starts: sk_stop_valid{Pre}(s) && \old(s->code) == SK_STATE_STANDBY && \old(s->run_release) == SK_RELEASE_SEEN &&
  @   sk_stop_quiet{Pre}(in) && sk_stop_go{Pre}(in) && sk_stop_settled{Pre}(s, in) ==> s->code == SK_STATE_RUN;
  @ ensures runs_on: sk_stop_valid{Pre}(s) && \old(s->code) == SK_STATE_RUN && sk_stop_quiet{Pre}(in) && sk_stop_go{Pre}(in) ==> s->code == SK_STATE_RUN;
  @ ensures resumes: sk_stop_valid{Pre}(s) && \old(s->code) == SK_STATE_STOPPED && \old(s->latched) == false && sk_stop_quiet{Pre}(in) &&
  @   sk_stop_go{Pre}(in) && sk_stop_settled{Pre}(s, in) ==> s->code == SK_STATE_RUN;
  @ ensures waits: s->code == SK_STATE_RUN && \old(s->code) != SK_STATE_RUN ==> sk_stop_settled{Pre}(s, in);
  @ ensures resets: sk_stop_valid{Pre}(s) && (\old(s->code) == SK_STATE_STOPPED || \old(s->code) == SK_STATE_FAULT) &&
  @   \old(s->latched) == true && sk_stop_reset{Pre}(s, in) ==> s->code == SK_STATE_STANDBY;
  @ ensures since: s->code != \old(s->code) ==> s->since_us == in->now_us;
  @ ensures since_kept: s->code == \old(s->code) ==> s->since_us == \old(s->since_us);
  @ ensures hold_seen: in->hold_reason != 0 ==> s->hold_seen_us == in->now_us;
  @ ensures hold_seen_kept: in->hold_reason == 0 ==> s->hold_seen_us == \old(s->hold_seen_us);
  @*/
void sk_stop_step(sk_stop_state *s, const sk_stop_input *in, sk_stop_output *out);

SK_END
#endif
