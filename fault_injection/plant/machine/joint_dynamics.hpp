// Closed-loop joint dynamics: dead time, dead band, first-order lag, acceleration and braking limits, shared pump flow, soil resistance,
// hard stops. Integrated in steps of one millisecond. SI units, radians; joint order swing, boom, stick, bucket.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "plant/machine/machine_fault.hpp"
#include "plant/machine/plant_profile.hpp"
#include "plant/machine/seeded_noise.hpp"
#include "plant/world/world.hpp"

namespace berm::plant {

enum class Drive {
  obey,   // the newest command, after its dead time
  brake,  // whatever was commanded: every joint to standstill at its braking deceleration
};

// Lumped inertia about the swing axis for a pose and payload, kg m2.
double swing_inertia(const DynamicsConfig& config, const ImplementShape& shape, const JointState& joints, double payload_kg);
// Deceleration towards standstill at this moment, rad/s2.
std::array<double, 4> braking(const DynamicsConfig& config, const ImplementShape& shape, const JointState& joints, double payload_kg);

class JointDynamics {
 public:
  JointDynamics(const DynamicsConfig& config, const ImplementShape& shape, std::uint64_t seed, const JointState& start);

  // From t to t + dt, obeying a command that arrived by t.
  void step(double dt, Drive drive, const std::array<double, 4>& command, const DigForces& soil, double payload_kg);
  const JointState& state() const { return state_; }
  // Faults whose time has come act from the next step on, until they are mended.
  void break_joint(const MachineFault& fault);
  void mend_joint(const MachineFault& fault);
  // Joint's motion no longer follows what is commanded: it runs away, or its valve is stuck.
  bool out_of_control(std::size_t joint) const { return driven_[joint].has_value(); }

 private:
  static constexpr double kSubstep = 0.001;

  struct Pending { std::int64_t due_step; double velocity; };

  std::array<double, 4> targets(Drive drive, const DigForces& soil) const;
  void move_joint(std::size_t j, double dt, double target, double brake_limit, double drive_limit, double soil_factor);

  DynamicsConfig config_;
  ImplementShape shape_;
  SeededNoise noise_;
  JointState state_;
  std::array<std::deque<Pending>, 4> pending_;
  std::array<double, 4> obeyed_{};          // the command whose dead time is over
  std::array<double, 4> wander_{};          // relative error of the speed reached
  std::array<double, 4> rest_{};            // time left before the motion may turn round
  std::array<double, 4> last_direction_{};  // sign of the last motion
  std::array<double, 4> brake_share_{1.0, 1.0, 1.0, 1.0};  // of the deceleration that is left
  std::array<bool, 4> valve_sticks_{};                     // when it is next opened
  std::array<std::optional<double>, 4> driven_{};          // rad/s, whatever is commanded
  std::int64_t substep_ = 0;
};

}  // namespace berm::plant
