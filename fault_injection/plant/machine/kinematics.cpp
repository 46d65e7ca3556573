#include "plant/machine/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace berm::plant {

SwingPlanePoint place(const LinkPose& link, const OutlinePoint& point) {
  const double c = std::cos(link.angle), s = std::sin(link.angle);
  return {link.origin.r + point.x * c - point.z * s, link.origin.z + point.x * s + point.z * c};
}

ImplementPose implement_pose(const ImplementShape& shape, const JointState& joints) {
  ImplementPose pose{};
  pose.boom = {{shape.boom_pin_x, shape.boom_pin_z}, joints.angle[1]};
  pose.stick = {place(pose.boom, {shape.boom, 0.0}), pose.boom.angle + joints.angle[2]};
  pose.bucket = {place(pose.stick, {shape.stick, 0.0}), pose.stick.angle + joints.angle[3]};
  pose.tip = place(pose.bucket, {shape.bucket, 0.0});
  return pose;
}

const LinkPose& link_of(const ImplementPose& pose, int link) {
  if (link == 1) return pose.boom;
  return link == 2 ? pose.stick : pose.bucket;
}

double bucket_underside(const ImplementShape& shape, const JointState& joints) {
  const ImplementPose pose = implement_pose(shape, joints);
  double lowest = pose.tip.z;
  for (const SolidPart& part : shape.parts) {
    if (part.link != 3) continue;
    for (const OutlinePoint& point : part.outline) lowest = std::min(lowest, place(pose.bucket, point).z);
  }
  return lowest;
}

double reach(const ImplementShape& shape, const JointState& joints) {
  const ImplementPose pose = implement_pose(shape, joints);
  double largest = 0.0;
  for (const SolidPart& part : shape.parts) {
    for (const OutlinePoint& point : part.outline) {
      largest = std::max(largest, std::hypot(place(link_of(pose, part.link), point).r, part.half_width));
    }
  }
  return largest;
}

}  // namespace berm::plant
