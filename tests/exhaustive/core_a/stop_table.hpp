// The stop logic once more, as a table of rules read from top to bottom; written from the requirements, not from the core.
#pragma once

#include "stop_space.hpp"

namespace berm::core_test {

// The state after one step from a valid state, by the table.
sk_stop_state expected_state(const sk_stop_state& s, const sk_stop_input& in);

}  // namespace berm::core_test
