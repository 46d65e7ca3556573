// Terrain shape templates over a bed map (stentz-1999, 4.3): how well a certain profile of the load matches at a cell.
#pragma once

#include <vector>

#include "planning/bed_grid.hpp"

namespace berm::app {

// Square, an odd number of cells a side, row by row; the sum of weight times height is the score.
struct BedTemplate {
  int side = 0;
  std::vector<double> weight;

  double at(int column, int row) const { return weight[static_cast<std::size_t>(row * side + column)]; }
};

// 7 x 7, about as wide as the bucket: the mean height, m. Its least score is the lowest part of the load.
BedTemplate constant_template();
// 5 x 5: how much lower the inner 3 x 3 cells lie than the rim, m. Positive in a hole, negative on a heap, 0 on any slope.
BedTemplate hole_template();
// 7 x 7: the rise over the template's side, m, along u (true) or v, of the plane that fits best. 0 on the flat, in a hole's middle and on a heap's top.
BedTemplate slope_template(bool along);

// The template's score about one cell of a filled map; beyond the rim the load counts as it is at the rim.
double score(const BedGrid& filled, const BedTemplate& shape, int column, int row);

// Of every cell, row by row.
std::vector<double> convolved(const BedGrid& filled, const BedTemplate& shape);

}  // namespace berm::app
