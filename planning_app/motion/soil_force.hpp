// How hard the soil resists the bucket, from the cylinders' pressures.
#pragma once

#include "motion/arm_kinematics.hpp"
#include "motion/implement_weight.hpp"

namespace berm::app {

// Force on the bucket in the swing plane, N: outward, upward.
struct PlaneForce { double r = 0.0, z = 0.0; };

// All that acts on the bucket besides its own weight: the soil's push and the weight of what it holds. From the two differences of moments between
// neighbouring pins, so that it need not be known where on the bucket it acts; nothing where boom and stick are in line.
PlaneForce force_on_bucket(const MachineModel& machine, const Joints& angle, const Moments& held, const Moments& empty);

// Of the tip in the swing plane, m/s.
double tip_speed(const MachineModel& machine, const Joints& angle, const Joints& velocity);

// The part of a force that works against the tip's motion, N; nothing below 0.03 m/s.
double resistance(const MachineModel& machine, const Joints& angle, const Joints& velocity, const PlaneForce& force);

// What a dig has brought into the bucket, from how hard and how long the soil resisted. How much soil that is the weighing of earlier digs says.
class DigFill {
public:
  void begin() { impulse_ = 0.0; }
  void add(double resistance_n, double dt);
  double impulse() const { return impulse_; }           // N s
  bool known() const { return kg_per_impulse_ > 0.0; }
  double kg() const;                                    // of a usual soil while it is not known
  double kg_per_impulse() const { return kg_per_impulse_; }
  // What the bucket of this dig held when it had been lifted. A full one (of most_kg) says only that there was at least so much.
  void learn(double weighed_kg, double most_kg);

private:
  double impulse_ = 0.0;
  double kg_per_impulse_ = 0.0;
};

}  // namespace berm::app
