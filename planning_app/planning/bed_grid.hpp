// Heights over a bed's floor on square cells, and what makes a map of them fit for templates: smoothing, and filling what is hidden.
#pragma once

#include <cstddef>
#include <vector>

namespace berm::app {

struct BedGrid {
  static constexpr double cell = 0.15;  // m (stentz-1999, 4.3)

  BedGrid() = default;
  BedGrid(double length, double width);

  double length = 0.0, width = 0.0;     // m, along u and v
  int columns = 0, rows = 0;            // along u, along v
  std::vector<double> height;           // m over the floor, row by row
  std::vector<char> known;              // 0: no height

  std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * columns + column); }
  // Of the nearest cell, for places beyond the rim.
  double at(int column, int row) const;
  // Of a cell's middle, from the bed's middle.
  double u(int column) const { return (column + 0.5) * cell - 0.5 * columns * cell; }
  double v(int row) const { return (row + 0.5) * cell - 0.5 * rows * cell; }
  int column_of(double u) const;
  int row_of(double v) const;

  double known_share() const;
  double known_mean() const;            // 0 where nothing is known
};

// Known cells become the Gaussian mean of the known cells about them; the others stay unknown. sigma in m.
BedGrid smoothed(const BedGrid& grid, double sigma);

// Unknown cells get the mean of the known ones (stentz-1999, 4.3), higher or lower by as much as the cell lies above these by the books (of the same size,
// all known); afterwards all are known. A side that the walls hide is then no lower for being hidden, nor is what was seen empty beside it worth more.
BedGrid filled(const BedGrid& grid, const BedGrid& noted);

// So much soil laid evenly over the cells whose middles lie within a rectangle of these sides about (u, v), m. Nothing where there is no such cell.
struct Pour { double u = 0.0, v = 0.0, along = 0.0, across = 0.0, kg = 0.0, density = 0.0; };
BedGrid poured(const BedGrid& grid, const Pour& pour);

// Soil slides from cell to cell until no step is steeper than the slope (rise over run), or nearly; the walls hold it.
BedGrid settled(const BedGrid& grid, double slope);

}  // namespace berm::app
