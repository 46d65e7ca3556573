// The outline of a part of the implements as points, close enough together to be held against the ground one by one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "motion/machine_model.hpp"

namespace berm::app {

// In the part's link's frame, m; no two neighbours farther apart than spacing (m), every corner among them.
inline std::vector<std::array<double, 2>> outline_points(const Prism& part, double spacing) {
  std::vector<std::array<double, 2>> points;
  for (std::size_t i = 0; i < part.outline.size(); ++i) {
    const auto& from = part.outline[i];
    const auto& to = part.outline[(i + 1) % part.outline.size()];
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::hypot(to[0] - from[0], to[1] - from[1]) / spacing)));
    for (int k = 0; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      points.push_back({from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])});
    }
  }
  return points;
}

}  // namespace berm::app
