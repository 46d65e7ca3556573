// What the rays of a sweep say of a bed, as single statements for a fit.
#pragma once

#include <vector>

#include "recognition/bed_model.hpp"
#include "recognition/packed_rays.hpp"

namespace berm::app {

// A plane of the bed: axis 0 or 1 with the side, and whether it is the wall's outer face; axis 2: the plane of the tops.
struct BedPlane {
  int axis = 0, side = 1;
  bool outer = false;
};

struct BedConstraint {
  Eigen::Vector3f head, at;  // of the ray
  bool edge = false;
  BedPlane plane;            // the return lies on it; or the ray crosses it
  BedPlane bound;            // edge: where the ray crosses plane, side * coordinate is below the bound (sense 1) or beyond it (sense -1)
  int sense = 1;
  double offset = 0.0;       // m: return on a face, its mean distance outwards
  double deviation = 0.03;   // m
  bool in_corner = false;    // return on a face, and as near to the wall beside it: of that wall perhaps
};

// pose: near enough to tell which face each ray meets.
std::vector<BedConstraint> constraints(const BedPose& pose, const std::vector<Ray>& rays);

// The rays of one fit: those that come within so many metres of the walls at its start, in plan, and there no lower than so many below what is seen of them.
class FitRays {
 public:
  // packed: the same rays.
  FitRays(const BedPose& start, const std::vector<Ray>& rays, const PackedRays& packed, double within, double below);
  // What they say, as above. Those that say nothing, most of them, are passed over eight at a time.
  [[nodiscard]] std::vector<BedConstraint> constraints(const BedPose& pose);

 private:
  std::vector<Ray> rays_;
  PackedRays packed_;
  std::vector<std::uint32_t> speaking_;
};

}  // namespace berm::app
