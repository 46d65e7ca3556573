#include "gathering/kinematic_chain.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace berm::app {

Eigen::Isometry3d dh_transform(const DhLink& link, double joint_value) {
  const double theta = link.theta + (link.joint == DhLink::Joint::kRevolute ? joint_value : 0.0);
  const double d = link.d + (link.joint == DhLink::Joint::kPrismatic ? joint_value : 0.0);
  const double ct = std::cos(theta), st = std::sin(theta), ca = std::cos(link.alpha), sa = std::sin(link.alpha);
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() << ct, -st * ca, st * sa, st, ct * ca, -ct * sa, 0.0, sa, ca;
  out.translation() << link.a * ct, link.a * st, d;
  return out;
}

Eigen::Isometry3d KinematicChain::pose(std::span<const double> joint_values) const {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  for (const DhLink& link : links_) {
    double value = 0.0;
    if (link.joint != DhLink::Joint::kFixed) {
      if (link.encoder >= joint_values.size()) throw std::out_of_range(fmt::format("encoder {} of {} values", link.encoder, joint_values.size()));
      value = joint_values[link.encoder];
    }
    out = out * dh_transform(link, value);
  }
  return out;
}

KinematicChain panning_scanner(double x, double y, double z) {
  const double bearing = std::atan2(y, x);
  DhLink swing_link, pan_link;
  swing_link.theta = bearing;
  swing_link.d = z;
  swing_link.a = std::hypot(x, y);
  swing_link.joint = DhLink::Joint::kRevolute;
  swing_link.encoder = 0;
  pan_link.theta = -bearing;
  pan_link.alpha = 0.5 * std::numbers::pi;
  pan_link.joint = DhLink::Joint::kRevolute;
  pan_link.encoder = 1;
  return KinematicChain({swing_link, pan_link});
}

}  // namespace berm::app
