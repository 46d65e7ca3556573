// The links' frames with their sines and cosines at hand, for cutting and ray casting.
#pragma once

#include <array>
#include <cmath>

#include "plant/machine/kinematics.hpp"

namespace berm::plant {

// A link's frame in the swing plane: origin in the near pin, x along the pin line, z to its left.
struct LinkFrame {
  SwingPlanePoint pin{0, 0};
  double angle = 0, cos_angle = 1, sin_angle = 0;

  LinkFrame() = default;
  explicit LinkFrame(const LinkPose& p) : pin(p.origin), angle(p.angle), cos_angle(std::cos(p.angle)), sin_angle(std::sin(p.angle)) {}
  [[nodiscard]] SwingPlanePoint out(double x, double z) const {
    return {pin.r + cos_angle * x - sin_angle * z, pin.z + sin_angle * x + cos_angle * z};
  }
};

// The links of one joint state. Indices as in the contract: 1 boom, 2 stick, 3 bucket; 0 is not used.
struct LinkFrames {
  double swing = 0;
  std::array<LinkFrame, 4> link{};
};

inline LinkFrames link_frames(const ImplementShape& shape, const JointState& joints) {
  const ImplementPose p = implement_pose(shape, joints);
  return {joints.angle[0], {LinkFrame{}, LinkFrame(p.boom), LinkFrame(p.stick), LinkFrame(p.bucket)}};
}

}  // namespace berm::plant
