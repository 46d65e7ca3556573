// Beds and sides drawn for the tests of a fit's statements: each test draws its own statements of them.
#pragma once

#include <random>

#include "recognition/bed_residuals.hpp"

namespace berm::app {

class DrawnBeds {
 public:
  explicit DrawnBeds(unsigned seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int side() { return between(0.0, 1.0) < 0.5 ? -1 : 1; }

  BedVector values() {
    BedVector v;
    v << between(-2, 2), between(5, 8), between(0, 2), between(-3, 3), between(-0.1, 0.1), between(-0.1, 0.1), between(4, 6), between(2, 3), between(0.05, 0.15);
    return v;
  }

 private:
  std::mt19937 random_;
};

}  // namespace berm::app
