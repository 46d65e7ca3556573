// A prism or a slice as the peers want it: corners in metres, and faces.
#pragma once

#include <vector>

#include "config/parameter_block.h"
#include "core/clearance.h"
#include "motion.hpp"

namespace berm::bench {

// Two outlines of as many corners, the left one first; corner i of one joins corner i of the other.
struct ConvexBody {
  std::vector<Vec3> corner;
  // FCL's encoding: of each face the number of corners, then these counter-clockwise from outside.
  std::vector<int> faces() const;
  int face_count() const { return static_cast<int>(corner.size()) / 2 + 2; }
};

ConvexBody body_of(const sk_slice& slice);                                                                      // in the base frame
ConvexBody body_of(const berm_parameters& parameters, const berm_part& part, const Joints& joints);  // in the base frame
ConvexBody body_of(const berm_part& part);                                                                      // in the link's frame (x, y left, z)

// A link's pose: columns of the rotation, then the position.
struct Pose {
  Vec3 x, y, z, at;
};
Pose pose_of(const berm_parameters& parameters, int link, const Joints& joints);

}  // namespace berm::bench
