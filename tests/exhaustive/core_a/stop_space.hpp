// All states and all inputs of the stop logic. Reason codes stand for themselves only as far as the logic can tell them apart: none, one of the
// contract's, another of the contract's, none of the contract's; times as: within each limit, at it, beyond it, backwards.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "contract/berm_contract.h"
#include "core/stop_logic.h"

namespace berm::core_test {

constexpr std::int64_t kEntered = 1'000'000, kHoldSeen = 1'150'000;
// The release of the run switch, as the kernel codes it.
constexpr std::uint16_t kAwaited = SK_RELEASE_AWAITED, kSeen = SK_RELEASE_SEEN;
constexpr std::uint16_t kCodes[] = {SK_STATE_INIT, SK_STATE_STANDBY, SK_STATE_RUN, SK_STATE_STOPPING, SK_STATE_STOPPED, SK_STATE_FAULT};

// An independent statement of which states are valid.
bool valid_state(const sk_stop_state& s);
// All valid states entered at kEntered, a hold reason last seen at kHoldSeen; reasons: two codes for each rank.
std::vector<sk_stop_state> valid_states();
// All inputs at now_us; reasons of each kind: none, two of the contract's, one beyond them.
std::vector<sk_stop_input> inputs(std::int64_t now_us);
std::vector<std::int64_t> times();

bool same(const sk_stop_state& a, const sk_stop_state& b);
const char* name(std::uint16_t code);

}  // namespace berm::core_test
