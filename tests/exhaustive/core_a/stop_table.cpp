#include "stop_table.hpp"

namespace berm::core_test {

namespace {

constexpr std::uint16_t kStopped = SK_STATE_STOPPED;
constexpr std::uint16_t kFault = SK_STATE_FAULT;

struct Ask {
  int rank;
  int reason;
  bool cut;
};

Ask asked(const sk_stop_input& in) {
  if (in.fault_reason > 15 || in.latch_reason > 15 || in.hold_reason > 15) return {3, BERM_STOP_INTERNAL, true};
  const bool cut = (in.fault_reason && in.fault_category_0) || (in.latch_reason && in.latch_category_0);
  if (in.fault_reason) return {3, in.fault_reason, cut};
  if (in.latch_reason) return {2, in.latch_reason, cut};
  return {in.hold_reason ? 1 : 0, in.hold_reason, cut};
}

// What a stop of a rank looks like.
struct Goal {
  std::uint16_t code;
  int rank;
  int reason;
  int category;
  bool released;
};

// Whether the run switch was seen off, from what the requirements say of it and nothing else.
std::uint16_t release(const sk_stop_state& s, const sk_stop_input& in, std::uint16_t next_code, int next_rank) {
  if (next_rank >= 2 || s.rank >= 2) return kAwaited;
  if (s.code == SK_STATE_STANDBY && next_code == SK_STATE_STANDBY && in.operator_run_off && !in.operator_run) return kSeen;
  return s.run_release;
}

Goal goal(const sk_stop_state& s, const sk_stop_input& in) {
  const Ask ask = asked(in);
  const bool go = in.operator_run && in.inputs_ready;
  const bool worse = ask.rank > s.rank;
  const int rank = worse ? ask.rank : s.rank;
  const int reason = worse ? ask.reason : s.reason;
  const bool cut = ask.cut || s.category == 0;
  const int category = cut ? 0 : rank == 1 ? 2 : 1;
  const bool overdue = in.now_us < s.since_us || in.now_us > s.since_us + SK_STOPPING_LIMIT_US;
  const bool settled = in.now_us < s.hold_seen_us || in.now_us >= s.hold_seen_us + SK_RESUME_QUIET_US;
  const Goal idle_here{s.code, 0, 0, 255, s.reset_seen_released};
  const Goal standby{SK_STATE_STANDBY, 0, 0, 255, false};
  const Goal run{SK_STATE_RUN, 0, 0, 255, false};

  switch (s.code) {
    case SK_STATE_INIT:
      if (ask.rank == 3) return {SK_STATE_FAULT, 3, ask.reason, ask.cut ? 0 : 1, false};
      return ask.rank == 2 || !in.inputs_ready ? idle_here : standby;
    case SK_STATE_STANDBY:
      if (ask.rank == 3) return {SK_STATE_FAULT, 3, ask.reason, ask.cut ? 0 : 1, false};
      if (ask.rank == 2) return {SK_STATE_STOPPED, 2, ask.reason, ask.cut ? 0 : 1, false};
      return ask.rank == 0 && go && settled && s.run_release == kSeen ? run : idle_here;
    case SK_STATE_RUN:
      if (ask.rank == 0 && go) return idle_here;
      if (ask.rank == 3 && ask.cut) return {SK_STATE_FAULT, 3, ask.reason, 0, false};
      return {SK_STATE_STOPPING, ask.rank, ask.reason, ask.cut ? 0 : ask.rank == 1 ? 2 : 1, ask.rank == 0 && s.reset_seen_released};
    case SK_STATE_STOPPING: {
      const bool released = !worse && s.reset_seen_released;
      if (rank == 3 && cut) return {SK_STATE_FAULT, 3, reason, 0, released};
      if (in.standstill && rank == 0) return standby;
      if (in.standstill) return {rank == 3 ? kFault : kStopped, rank, reason, category, released};
      if (overdue) return {SK_STATE_FAULT, 3, rank == 3 ? reason : BERM_STOP_BRAKING, 0, false};
      return {SK_STATE_STOPPING, rank, reason, category, released};
    }
    case SK_STATE_STOPPED:
    case SK_STATE_FAULT:
      break;
    default: return {SK_STATE_FAULT, 3, BERM_STOP_INTERNAL, 0, false};
  }
  if (!s.latched) {  // STOPPED for a hold reason
    if (ask.rank >= 2) return {ask.rank == 3 ? kFault : kStopped, ask.rank, ask.reason, ask.cut ? 0 : 1, false};
    if (!go) return standby;
    if (ask.rank == 0 && settled) return run;
    return {SK_STATE_STOPPED, 1, s.reason, 2, s.reset_seen_released};
  }
  const bool reset = ask.rank == 0 && in.standstill && in.operator_reset && s.reset_seen_released;
  if (reset) return standby;
  const bool released = (!worse && s.reset_seen_released) || !in.operator_reset;
  return {rank == 3 ? kFault : kStopped, rank, reason, category, released};
}

}  // namespace

sk_stop_state expected_state(const sk_stop_state& s, const sk_stop_input& in) {
  const Goal g = goal(s, in);
  sk_stop_state next{};
  next.code = g.code;
  next.rank = static_cast<std::uint8_t>(g.rank);
  next.reason = static_cast<std::uint8_t>(g.reason);
  next.category = static_cast<std::uint8_t>(g.category);
  next.latched = g.rank >= 2;
  next.reset_seen_released = g.released;
  next.run_release = release(s, in, g.code, g.rank);
  next.since_us = g.code == s.code ? s.since_us : in.now_us;
  next.hold_seen_us = in.hold_reason ? in.now_us : s.hold_seen_us;
  return next;
}

}  // namespace berm::core_test
