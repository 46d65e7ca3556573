#include "gathering/kinematic_chain.hpp"

#include <fmt/format.h>

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

}  // namespace berm::app
