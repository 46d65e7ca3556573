// Of the dig zones, the cells where the bucket may be moving soil. Only there may the ground rise for another reason than that somebody comes.
#pragma once

#include <cstdint>
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

  // For so long after the bucket has gone what is seen there is still learned, a sweep of the panning scanners: of a face that it hid in part, or whose
  // returns were dropped as its own, the lower half alone was known, and the upper was somebody.
  static constexpr std::int64_t kLearnsOnUs = 3'000'000;

  struct Cell {
    sk_monitor_cell at;
    double x_m, y_m;            // its middle, base frame
    double ceiling_m;           // of its zone: soil heaps up no higher
    bool stirred, was_stirred;  // its ground may have changed and is learned, in the newest step and in the one before
    std::int64_t stirred_us;    // when the bucket last was near; -1: not since it was learned
  };

  explicit DigWatch(const berm_parameters& parameters);

  // Once a cycle, with the joints as they are now. A bucket above the zone's ceiling moves no soil, nor does one that stands. held: somebody is in the
  // region; then nothing is learned on, lest it be he.
  void step(const JointAngles& joints, bool stands, bool held, std::int64_t now_us);
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  const berm_parameters& parameters_;
  Kinematics kinematics_;
  std::vector<Cell> cells_;  // every cell that touches a dig zone
};

}  // namespace berm::kernel
