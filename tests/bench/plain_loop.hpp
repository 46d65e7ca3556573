// The reference: what a plain loop takes that bounds each part over a step by its extents in fixed directions and holds these against the columns.
// It is no certificate: floating point, the two ends of the step only (no arc between them), no freshness, nothing proved.
#pragma once

#include <cstdint>
#include <vector>

#include "config/parameter_block.h"
#include "motion.hpp"

namespace berm::bench {

class PlainLoop {
 public:
  PlainLoop(const berm_parameters& parameters, int cells, int cell_mm, const std::vector<std::int32_t>& heights_mm);

  // Of each step, how many of its parts meet a column.
  void run(const Joints* joints, int* hit_parts_of_step) const; // kSteps + 1 of joints

 private:
  static constexpr int kDirections = 17;  // whose z is not negative: of the 26 of a cube's faces, edges and corners
  struct Bounds {
    float least[kDirections];
    float x_low, x_high, y_low, y_high;
  };
  struct Frame {
    float r[3], z[3], c[3], s[3];  // of the links in the swing plane
    float swing_c, swing_s;
  };
  Frame frame_at(const Joints& joints) const;
  void bound(int part, const Frame& from, const Frame& to, Bounds& out) const;
  bool hits(const Bounds& bounds) const;

  const berm_parameters& parameters_;
  int cells_;
  float cell_, origin_;
  std::vector<float> top_;
};

}  // namespace berm::bench
