// The value that a share of others lies below.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace berm::run {

// 0 without values.
inline double percentile_of(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

}  // namespace berm::run
