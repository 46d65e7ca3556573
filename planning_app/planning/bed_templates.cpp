#include "planning/bed_templates.hpp"

#include <cstdlib>

namespace berm::app {

namespace {

constexpr int wide = 7, narrow = 5;

BedTemplate blank(int side) { return {side, std::vector<double>(static_cast<std::size_t>(side * side), 0.0)}; }

}  // namespace

BedTemplate constant_template() { return {wide, std::vector<double>(static_cast<std::size_t>(wide * wide), 1.0 / (wide * wide))}; }

BedTemplate hole_template() {
  constexpr int inner = 9, rim = narrow * narrow - inner;
  BedTemplate t = blank(narrow);
  for (int row = 0; row < narrow; ++row)
    for (int column = 0; column < narrow; ++column) {
      const bool inside = std::abs(row - narrow / 2) <= 1 && std::abs(column - narrow / 2) <= 1;
      t.weight[static_cast<std::size_t>(row * narrow + column)] = inside ? -1.0 / inner : 1.0 / rim;
    }
  return t;
}

BedTemplate slope_template(bool along) {
  double squares = 0.0;  // of the distances from the middle, in cells
  for (int k = -wide / 2; k <= wide / 2; ++k) squares += wide * k * k;
  BedTemplate t = blank(wide);
  for (int row = 0; row < wide; ++row)
    for (int column = 0; column < wide; ++column)
      t.weight[static_cast<std::size_t>(row * wide + column)] = wide * ((along ? column : row) - wide / 2) / squares;
  return t;
}

double score(const BedGrid& filled, const BedTemplate& shape, int column, int row) {
  double sum = 0.0;
  const int half = shape.side / 2;
  for (int j = 0; j < shape.side; ++j)
    for (int i = 0; i < shape.side; ++i) sum += shape.at(i, j) * filled.at(column + i - half, row + j - half);
  return sum;
}

std::vector<double> convolved(const BedGrid& filled, const BedTemplate& shape) {
  std::vector<double> out;
  out.reserve(filled.height.size());
  for (int row = 0; row < filled.rows; ++row)
    for (int column = 0; column < filled.columns; ++column) out.push_back(score(filled, shape, column, row));
  return out;
}

}  // namespace berm::app
