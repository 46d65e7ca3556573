// Loose soil on a grid of heights slides until it stands.
#pragma once

#include <cstddef>
#include <vector>

namespace berm::app {

struct SlideLimits {
  double steepest = 0.0;   // m that neighbouring cells may differ by
  double rest_step = 0.0;  // m of excess that is left standing
  int most_rounds = 0;
};

// heights: row by row. What is too steep moves to its neighbours, none is lost; nothing passes the rim.
void slide_to_rest(std::vector<double>& heights, int columns, int rows, const SlideLimits& limits);

// The same with firm soil (bank) under the loose: only what lies over it slides, but where it stands out of its neighbours by more than bank_steepest it
// breaks off and is loose.
void slide_to_rest(std::vector<double>& heights, std::vector<double>& bank, int columns, int rows, const SlideLimits& limits, double bank_steepest);

}  // namespace berm::app
