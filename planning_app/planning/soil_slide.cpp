#include "planning/soil_slide.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr double share = 0.25;  // of the excess, for a cell has four neighbours

// Calls visit(a, b) for all pairs of neighbours, round by round, until it returns false for all of them.
template <class Visit>
void relax(int columns, int rows, int most_rounds, Visit visit) {
  for (int round = 0; round < most_rounds; ++round) {
    bool moved = false;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const std::size_t here = static_cast<std::size_t>(row * columns + column);
        if (column + 1 < columns && visit(here, here + 1)) moved = true;
        if (row + 1 < rows && visit(here, here + static_cast<std::size_t>(columns))) moved = true;
      }
    if (!moved) return;
  }
}

}  // namespace

void slide_to_rest(std::vector<double>& heights, int columns, int rows, const SlideLimits& limits) {
  relax(columns, rows, limits.most_rounds, [&](std::size_t a, std::size_t b) {
    const double step = heights[a] - heights[b], excess = std::fabs(step) - limits.steepest;
    if (!(excess > limits.rest_step)) return false;
    const double moved = std::copysign(share * excess, step);
    heights[a] -= moved;
    heights[b] += moved;
    return true;
  });
}

void slide_to_rest(std::vector<double>& heights, std::vector<double>& bank, int columns, int rows, const SlideLimits& limits, double bank_steepest) {
  relax(columns, rows, limits.most_rounds, [&](std::size_t a, std::size_t b) {
    const std::size_t upper = heights[a] >= heights[b] ? a : b, lower = upper == a ? b : a;
    bool moved = false;
    const double overhang = bank[upper] - heights[lower] - bank_steepest;
    if (overhang > limits.rest_step) {
      bank[upper] -= share * overhang;
      moved = true;
    }
    const double excess = heights[upper] - heights[lower] - limits.steepest, slides = std::min(share * excess, heights[upper] - bank[upper]);
    if (excess > limits.rest_step && slides > share * limits.rest_step) {
      heights[upper] -= slides;
      heights[lower] += slides;
      moved = true;
    }
    return moved;
  });
}

}  // namespace berm::app
