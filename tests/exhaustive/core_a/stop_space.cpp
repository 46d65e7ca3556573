#include "stop_space.hpp"

#include <limits>

namespace berm::core_test {

namespace {

sk_stop_state make(std::uint16_t code, std::uint8_t reason, std::uint8_t category, std::uint8_t rank, bool released, std::uint16_t run_release) {
  sk_stop_state s{};
  s.code = code;
  s.run_release = run_release;
  s.reason = reason;
  s.category = category;
  s.rank = rank;
  s.latched = rank >= 2;
  s.reset_seen_released = released;
  s.since_us = kEntered;
  s.hold_seen_us = kHoldSeen;
  return s;
}

}  // namespace

bool valid_state(const sk_stop_state& s) {
  const bool reason_named = s.reason >= 1 && s.reason <= 23;
  const bool braked_or_cut = s.category == 0 || s.category == 1;
  if (s.latched != (s.rank == 2 || s.rank == 3)) return false;
  if ((s.rank == 0) == (s.reason != 0)) return false;
  if (s.rank != 0 && !reason_named) return false;
  // Only in STANDBY may the release of the run switch have been seen or not.
  const bool never_yet = s.code == SK_STATE_INIT || s.latched;
  if (s.run_release != kAwaited && s.run_release != kSeen) return false;
  if (s.code != SK_STATE_STANDBY && (s.run_release == kAwaited) != never_yet) return false;
  switch (s.code) {
    case SK_STATE_INIT:
    case SK_STATE_STANDBY:
    case SK_STATE_RUN: return s.rank == 0 && s.category == 255;
    case SK_STATE_STOPPING:
      if (s.rank == 0 || s.rank == 3) return s.category == 1;
      return s.rank == 1 ? s.category == 2 : s.rank == 2 && braked_or_cut;
    case SK_STATE_STOPPED: return s.rank == 1 ? s.category == 2 : s.rank == 2 && braked_or_cut;
    case SK_STATE_FAULT: return s.rank == 3 && braked_or_cut;
    default: return false;
  }
}

std::vector<sk_stop_state> valid_states() {
  std::vector<sk_stop_state> all;
  for (const std::uint16_t code : kCodes)
    for (const int rank : {0, 1, 2, 3})
      for (const int reason : {0, 1, 21})
        for (const int category : {0, 1, 2, 255})
          for (const bool released : {false, true})
            for (const std::uint16_t run_release : {kAwaited, kSeen}) {
              const sk_stop_state s = make(code, static_cast<std::uint8_t>(reason), static_cast<std::uint8_t>(category), static_cast<std::uint8_t>(rank), released, run_release);
              if (valid_state(s)) all.push_back(s);
            }
  return all;
}

std::vector<sk_stop_input> inputs(std::int64_t now_us) {
  std::vector<sk_stop_input> all;
  const std::uint8_t codes[] = {0, 2, 14, 24};
  for (const std::uint8_t fault : codes)
    for (const std::uint8_t latch : codes)
      for (const std::uint8_t hold : codes)
        for (unsigned bits = 0; bits < 128; ++bits) {
          sk_stop_input in{};
          in.now_us = now_us;
          in.fault_reason = fault;
          in.latch_reason = latch;
          in.hold_reason = hold;
          in.fault_category_0 = bits & 1;
          in.latch_category_0 = bits & 2;
          in.inputs_ready = bits & 4;
          in.standstill = bits & 8;
          in.operator_run = bits & 16;
          in.operator_reset = bits & 32;
          in.operator_run_off = bits & 64;
          all.push_back(in);
        }
  return all;
}

std::vector<std::int64_t> times() {
  return {kEntered, kEntered + SK_STOPPING_LIMIT_US, kEntered + SK_STOPPING_LIMIT_US + 1, kEntered - 1,
          kHoldSeen - 1, kHoldSeen + SK_RESUME_QUIET_US - 1, kHoldSeen + SK_RESUME_QUIET_US,
          std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()};
}

bool same(const sk_stop_state& a, const sk_stop_state& b) {
  return a.code == b.code && a.run_release == b.run_release && a.reason == b.reason && a.category == b.category && a.rank == b.rank && a.latched == b.latched &&
         a.reset_seen_released == b.reset_seen_released && a.since_us == b.since_us && a.hold_seen_us == b.hold_seen_us;
}

const char* name(std::uint16_t code) {
  switch (code) {
    case SK_STATE_INIT: return "INIT";
    case SK_STATE_STANDBY: return "STANDBY";
    case SK_STATE_RUN: return "RUN";
    case SK_STATE_STOPPING: return "STOPPING";
    case SK_STATE_STOPPED: return "STOPPED";
    case SK_STATE_FAULT: return "FAULT";
    default: return "corrupted";
  }
}

}  // namespace berm::core_test
