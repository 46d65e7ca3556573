// Of the dig zones, the cells where the bucket may be moving soil. Only there may the ground rise for another reason than that somebody comes.
#pragma once

#include <vector>

#include "config/parameter_block.h"
#include "core/monitor_region.h"
#include "geometry/kinematics.hpp"

namespace berm::kernel {

class DigWatch {
 public:
  // Soil that heaps up by more than a rise does so no farther from the bucket than this, as seen from above: it is pulled towards the machine,
  // where a heap of 1.1 m on the edge is 1.4 m wide (seen in simulation); beyond the teeth and beside them the face only slides down.
  static constexpr double kBehindM = 1.5, kBeyondM = 0.5, kBesideM = 0.5;

  struct Cell {
    sk_monitor_cell at;
    double x_m, y_m;     // its middle, base frame
    double ceiling_m;    // of its zone: soil heaps up no higher
    bool near, was_near; // a bucket that may move soil, in the newest step and in the one before
  };

  explicit DigWatch(const berm_parameters& parameters);

  // Once a cycle, with the joints as they are now. A bucket above the zone's ceiling moves no soil, nor does one that stands.
  void step(const JointAngles& joints, bool stands);
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  const berm_parameters& parameters_;
  Kinematics kinematics_;
  std::vector<Cell> cells_;  // every cell that touches a dig zone
};

}  // namespace berm::kernel
