#include "plant/machine/cylinder_pressures.hpp"

#include <cmath>

#include "plant/machine/kinematics.hpp"

namespace berm::plant {

namespace {

constexpr double kGravity = 9.81;
constexpr double kReturnPressure = 500.0;  // kPa

}  // namespace

std::array<double, 3> holding_moments(const InertiaConfig& mass, const ImplementShape& shape, const JointState& joints, double payload_kg, const EdgeForce& edge) {
  const ImplementPose pose = implement_pose(shape, joints);
  const double boom_centre = pose.boom.origin.r + (mass.boom_radius - shape.boom_pin_x) * std::cos(pose.boom.angle);
  const double stick_centre = place(pose.stick, mass.stick_centre).r, bucket_centre = place(pose.bucket, mass.bucket_centre).r;
  const auto about = [&](const SwingPlanePoint& pin, double boom_kg, double stick_kg) {
    const double weights = kGravity * (boom_kg * (boom_centre - pin.r) + stick_kg * (stick_centre - pin.r) + (mass.bucket_mass + payload_kg) * (bucket_centre - pin.r));
    return weights - ((pose.tip.r - pin.r) * edge.z_n - (pose.tip.z - pin.z) * edge.r_n);
  };
  return {about(pose.boom.origin, mass.boom_mass, mass.stick_mass), about(pose.stick.origin, 0.0, mass.stick_mass), about(pose.bucket.origin, 0.0, 0.0)};
}

std::array<SidePressures, 3> cylinder_pressures(const DynamicsConfig& config, const ImplementShape& shape, const JointState& joints, double payload_kg, const EdgeForce& edge) {
  const std::array<double, 3> moment = holding_moments(config.inertia, shape, joints, payload_kg, edge);
  std::array<SidePressures, 3> sides;
  for (std::size_t c = 0; c < sides.size(); ++c) {
    const CylinderConfig& cylinder = config.cylinder[c];
    const double extending = c == 0 ? moment[c] : -moment[c];
    if (extending >= 0.0) sides[c] = {(extending + kReturnPressure * cylinder.rod) / cylinder.bottom, kReturnPressure};
    else sides[c] = {kReturnPressure, (-extending + kReturnPressure * cylinder.bottom) / cylinder.rod};
  }
  return sides;
}

}  // namespace berm::plant
