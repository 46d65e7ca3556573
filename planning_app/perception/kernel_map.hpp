// The kernel's published map as ground for the skyline: what the kernel will check against.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "contract/berm_contract.h"
#include "planning/skyline.hpp"

namespace berm::app {

// Heights by cell of a square map; one height for all that is outside.
class CellGround {
public:
  // A cell's side and the map's low corner, m; heights row by row, x fastest, which must outlive this.
  CellGround(double cell, double origin, int side, const double* height, double outside)
      : cell_(cell), per_cell_(1.0 / cell), origin_(origin), outside_(outside), side_(side), height_(height) {}

  double operator()(double x, double y) const {
    const int ix = index(x), iy = index(y);
    if (ix < 0 || iy < 0 || ix >= side_ || iy >= side_) return outside_;
    return height_[static_cast<std::size_t>(iy) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(ix)];
  }

private:
  static constexpr double doubtful = 1e-9;  // cells: far more than the product differs from the quotient

  // The quotient's floor; divided only where the product by the reciprocal does not tell it. -1 outside.
  int index(double v) const {
    const double cells = (v - origin_) * per_cell_;
    if (!(cells > -1.0 && cells < side_ + 1.0)) return -1;
    const int whole = static_cast<int>(cells);
    const double part = cells - whole;
    return part > doubtful && part < 1.0 - doubtful ? whole : static_cast<int>(std::floor((v - origin_) / cell_));
  }

  double cell_, per_cell_, origin_, outside_;
  int side_;
  const double* height_;
};

class KernelMap {
public:
  KernelMap();

  // Copies the published map; rows may be of different cycles.
  void take(const berm_state_segment& segment);

  enum class Unseen {
    level,    // as high as the ground the machine stands on: for plans, by then it will have been seen
    blocked   // infinitely high, as the kernel takes it
  };
  CellGround ground(Unseen unseen) const;  // refers to this map
  double cell() const { return cell_; }    // m
  bool is_void() const { return void_; }   // no cell of it was ever seen, as where the kernel begins it anew

private:
  double cell_ = 0.3, origin_ = 0.0;  // m
  bool void_ = true;
  std::vector<double> level_, blocked_;  // as ground gives them
};

}  // namespace berm::app
