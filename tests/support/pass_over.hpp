// Rules of the clearance check without the overpass rule: whatever stands there may be passed over.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/clearance_rules.h"

namespace berm::test {

inline void pass_over(sk_clearance_rules& rules, std::int16_t limit_mm = std::numeric_limits<std::int16_t>::max()) {
  for (auto& row : rules.pass_mm) std::fill(std::begin(row), std::end(row), limit_mm);
}

}  // namespace berm::test
