#include "motion/soil_force.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

PlaneForce force_on_bucket(const MachineModel& machine, const Joints& angle, const Moments& held, const Moments& empty) {
  constexpr double least_sine = 0.1;  // of the stick's angle to the boom
  const ArmPoints arm = forward(machine, angle);
  const PlanePoint along_boom{arm.stick_pin.r - arm.boom_pin.r, arm.stick_pin.z - arm.boom_pin.z};
  const PlanePoint along_stick{arm.bucket_pin.r - arm.stick_pin.r, arm.bucket_pin.z - arm.stick_pin.z};
  // The cylinders hold against it: along x force = -(moment of this pin - moment of the next).
  const double boom_share = -((held[0] - empty[0]) - (held[1] - empty[1])), stick_share = -((held[1] - empty[1]) - (held[2] - empty[2]));
  const double determinant = along_boom.r * along_stick.z - along_boom.z * along_stick.r;
  if (std::fabs(determinant) < least_sine * machine.boom_length * machine.stick_length) return {};
  // a.r F.z - a.z F.r = boom_share; b.r F.z - b.z F.r = stick_share
  return {(along_boom.r * stick_share - along_stick.r * boom_share) / -determinant, (along_stick.z * boom_share - along_boom.z * stick_share) / determinant};
}

namespace {

PlanePoint tip_velocity(const MachineModel& machine, const Joints& angle, const Joints& velocity) {
  constexpr double dt = 0.01;
  Joints later = angle;
  for (const Joint j : {boom, stick, bucket}) later[j] += velocity[j] * dt;
  const PlanePoint from = forward(machine, angle).tip, to = forward(machine, later).tip;
  return {(to.r - from.r) / dt, (to.z - from.z) / dt};
}

}  // namespace

double tip_speed(const MachineModel& machine, const Joints& angle, const Joints& velocity) {
  const PlanePoint v = tip_velocity(machine, angle, velocity);
  return std::hypot(v.r, v.z);
}

double resistance(const MachineModel& machine, const Joints& angle, const Joints& velocity, const PlaneForce& force) {
  constexpr double least_speed = 0.03;
  const PlanePoint v = tip_velocity(machine, angle, velocity);
  const double speed = std::hypot(v.r, v.z);
  if (speed < least_speed) return 0.0;
  return -(force.r * v.r + force.z * v.z) / speed;
}

double DigFill::kg() const {
  constexpr double usual = 0.02;  // kg per N s, of common soils: until one was weighed
  return impulse_ * (known() ? kg_per_impulse_ : usual);
}

void DigFill::add(double resistance_n, double dt) {
  constexpr double noise = 3e3;  // N: less is no soil
  if (resistance_n > noise) impulse_ += resistance_n * dt;
}

void DigFill::learn(double weighed_kg, double most_kg) {
  constexpr double weight = 0.5, full_share = 0.90, probe = 1.04;
  constexpr double least_impulse = 5e3;  // N s
  if (impulse_ < least_impulse || weighed_kg <= 0.0) return;
  const double seen = weighed_kg / impulse_;
  if (!known()) kg_per_impulse_ = seen;
  // Full before the dig was ended, perhaps long before: the next is ended a little sooner, until one is not full.
  else if (weighed_kg > full_share * most_kg) kg_per_impulse_ = std::max(seen, probe * kg_per_impulse_);
  else kg_per_impulse_ += weight * (seen - kg_per_impulse_);
}

}  // namespace berm::app
