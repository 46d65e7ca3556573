// The plant's own forward kinematics (kernel, app and plant each have theirs on purpose). Metres, radians; r is the horizontal distance from
// the swing axis along the implements, z up from the ground.
#pragma once

#include "plant/machine/implement_shape.hpp"
#include "plant/world/world.hpp"

namespace berm::plant {

struct SwingPlanePoint { double r, z; };
struct LinkPose { SwingPlanePoint origin; double angle; };  // near pin; elevation of the pin line

struct ImplementPose {
  LinkPose boom, stick, bucket;
  SwingPlanePoint tip;
};

ImplementPose implement_pose(const ImplementShape& shape, const JointState& joints);
SwingPlanePoint place(const LinkPose& link, const OutlinePoint& point);
const LinkPose& link_of(const ImplementPose& pose, int link);  // 1 boom, 2 stick, 3 bucket

// Lowest z of the bucket's outline.
double bucket_underside(const ImplementShape& shape, const JointState& joints);
// Largest horizontal distance of any point of the parts from the swing axis.
double reach(const ImplementShape& shape, const JointState& joints);

}  // namespace berm::plant
