#include "motion/arm_kinematics.hpp"

#include <cmath>

namespace berm::app {

namespace {

PlanePoint along(const PlanePoint& from, double length, double elevation) {
  return {from.r + length * std::cos(elevation), from.z + length * std::sin(elevation)};
}

bool within(const JointLimits& limits, double angle, double guard) {
  constexpr double rounding = 1e-12;
  return angle >= limits.low + guard - rounding && angle <= limits.high - guard + rounding;
}

}  // namespace

ArmPoints forward(const MachineModel& machine, double boom_angle, double stick_angle, double bucket_angle) {
  ArmPoints p;
  p.boom_pin = {machine.boom_pin_x, machine.boom_pin_z};
  p.stick_attitude = boom_angle + stick_angle;
  p.bucket_attitude = p.stick_attitude + bucket_angle;
  p.stick_pin = along(p.boom_pin, machine.boom_length, boom_angle);
  p.bucket_pin = along(p.stick_pin, machine.stick_length, p.stick_attitude);
  p.tip = along(p.bucket_pin, machine.bucket_length, p.bucket_attitude);
  return p;
}

Point in_base(const PlanePoint& p, double swing_angle) {
  return {p.r * std::cos(swing_angle), p.r * std::sin(swing_angle), p.z};
}

std::optional<Joints> inverse_pin(const MachineModel& machine, const PlanePoint& pin, double attitude, double guard) {
  const double a = machine.boom_length, b = machine.stick_length;
  const double dr = pin.r - machine.boom_pin_x, dz = pin.z - machine.boom_pin_z;
  const double cosine = (dr * dr + dz * dz - a * a - b * b) / (2.0 * a * b);
  if (!(cosine >= -1.0 && cosine <= 1.0)) return std::nullopt;
  const double stick_angle = -std::acos(cosine);  // the stick folds down only
  const double boom_angle = std::atan2(dz, dr) - std::atan2(b * std::sin(stick_angle), a + b * cosine);
  Joints q{0.0, boom_angle, stick_angle, wrapped(attitude - boom_angle - stick_angle)};
  for (const std::size_t j : {boom, stick, bucket})
    if (!within(machine.joint[j], q[j], guard)) return std::nullopt;
  return q;
}

std::optional<Joints> inverse_tip(const MachineModel& machine, const PlanePoint& tip, double attitude, double guard) {
  const PlanePoint pin = along(tip, -machine.bucket_length, attitude);
  return inverse_pin(machine, pin, attitude, guard);
}

}  // namespace berm::app
