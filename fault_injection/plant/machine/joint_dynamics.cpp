#include "plant/machine/joint_dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "plant/machine/kinematics.hpp"

namespace berm::plant {

namespace {

double square(double x) { return x * x; }
double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

// A joint that soil holds up loses its speed faster than its brake alone could take it.
constexpr double kSoilBrakeFactor = 4.0;

}  // namespace

double swing_inertia(const DynamicsConfig& config, const ImplementShape& shape, const JointState& joints, double payload_kg) {
  const InertiaConfig& m = config.inertia;
  const ImplementPose pose = implement_pose(shape, joints);
  return m.upper + m.boom_mass * square(m.boom_radius) + m.stick_mass * square(place(pose.stick, m.stick_centre).r) +
         (m.bucket_mass + payload_kg) * square(place(pose.bucket, m.bucket_centre).r);
}

std::array<double, 4> braking(const DynamicsConfig& config, const ImplementShape& shape, const JointState& joints, double payload_kg) {
  std::array<double, 4> out{};
  out[0] = config.swing_brake_torque / swing_inertia(config, shape, joints, payload_kg);
  for (std::size_t j = 1; j < 4; ++j) out[j] = config.joint[j].brake;
  if (joints.velocity[1] < 0.0) {  // the load helps a boom that goes down
    const double share = std::clamp(payload_kg / config.payload_reference, 0.0, 1.0);
    out[1] += share * (config.boom_lower_brake_loaded - out[1]);
  }
  return out;
}

JointDynamics::JointDynamics(const DynamicsConfig& config, const ImplementShape& shape, std::uint64_t seed, const JointState& start)
    : config_(config), shape_(shape), noise_(seed, 11), state_(start) {}

void JointDynamics::break_joint(const MachineFault& fault) {
  switch (fault.kind) {
    case MachineFaultKind::weak_brake: brake_share_[fault.joint] = fault.factor; break;
    case MachineFaultKind::stuck_valve: valve_sticks_[fault.joint] = true; break;
    case MachineFaultKind::stuck_angle:
    case MachineFaultKind::own_error: break;  // the joint is sound
    case MachineFaultKind::runaway: driven_[fault.joint] = fault.factor * config_.joint[fault.joint].velocity_max; break;
  }
}

void JointDynamics::mend_joint(const MachineFault& fault) {
  switch (fault.kind) {
    case MachineFaultKind::weak_brake: brake_share_[fault.joint] = 1.0; break;
    case MachineFaultKind::stuck_valve: valve_sticks_[fault.joint] = false; [[fallthrough]];
    case MachineFaultKind::runaway: driven_[fault.joint].reset(); break;
    case MachineFaultKind::stuck_angle:
    case MachineFaultKind::own_error: break;
  }
}

std::array<double, 4> JointDynamics::targets(Drive drive, const DigForces& soil) const {
  std::array<double, 4> target{};
  if (drive == Drive::brake) return target;
  double flow = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    const JointConfig& joint = config_.joint[j];
    const double asked = std::clamp(driven_[j].value_or(obeyed_[j]), -joint.velocity_max, joint.velocity_max);
    if (std::abs(asked) <= joint.dead_band) continue;
    target[j] = std::clamp(asked * (1.0 + wander_[j]), -joint.velocity_max, joint.velocity_max);
    flow += std::abs(target[j]) / joint.velocity_max;
  }
  const double share = flow > config_.flow_limit ? config_.flow_limit / flow : 1.0;
  for (std::size_t j = 0; j < 4; ++j) target[j] *= share * std::clamp(soil.resist_speed_factor[j], 0.0, 1.0);
  return target;
}

void JointDynamics::move_joint(std::size_t j, double dt, double target, double brake_limit, double drive_limit, double soil_factor) {
  const JointConfig& joint = config_.joint[j];
  const double before = state_.velocity[j];
  const double braked = before - sign(before) * std::min(std::abs(before), brake_limit * dt);
  double after = before;
  if (target == 0.0 || before * target < 0.0) {
    after = braked;
  } else if (std::abs(target) < std::abs(before)) {
    const double limit = soil_factor < 1.0 ? brake_limit * kSoilBrakeFactor : brake_limit;
    after = before + std::clamp((target - before) / joint.lag, -limit, limit) * dt;
  } else if (before != 0.0 || rest_[j] <= 0.0 || target * last_direction_[j] > 0.0) {
    after = before + std::clamp((target - before) / joint.lag, -drive_limit, drive_limit) * dt;
  }
  if (after != 0.0) {
    last_direction_[j] = sign(after);
    rest_[j] = joint.reversal;
  } else {
    rest_[j] = std::max(0.0, rest_[j] - dt);
  }
  state_.velocity[j] = after;
  state_.angle[j] += 0.5 * (before + after) * dt;
  const double held = std::clamp(state_.angle[j], joint.low, joint.high);
  if (held != state_.angle[j]) {
    state_.angle[j] = held;
    state_.velocity[j] = 0.0;
  }
}

void JointDynamics::step(double dt, Drive drive, const std::array<double, 4>& command, const DigForces& soil, double payload_kg) {
  const auto substeps = std::max<std::int64_t>(1, std::llround(dt / kSubstep));
  const double h = dt / static_cast<double>(substeps);
  for (std::size_t j = 0; j < 4; ++j) {
    pending_[j].push_back({substep_ + std::llround(config_.joint[j].dead_time / h), command[j]});
    wander_[j] = std::clamp(0.98 * wander_[j] + noise_.bounded(0.2 * config_.joint[j].ripple), -config_.joint[j].ripple, config_.joint[j].ripple);
  }
  for (std::int64_t i = 0; i < substeps; ++i, ++substep_) {
    for (std::size_t j = 0; j < 4; ++j) {
      while (!pending_[j].empty() && pending_[j].front().due_step <= substep_) {
        obeyed_[j] = pending_[j].front().velocity;
        pending_[j].pop_front();
      }
      if (valve_sticks_[j] && !driven_[j] && drive == Drive::obey && std::abs(obeyed_[j]) > config_.joint[j].dead_band) driven_[j] = obeyed_[j];
    }
    const std::array<double, 4> target = targets(drive, soil);
    std::array<double, 4> brake_limit = braking(config_, shape_, state_, payload_kg);
    for (std::size_t j = 0; j < 4; ++j) brake_limit[j] *= brake_share_[j];
    const double torque_limit = config_.swing_drive_torque / swing_inertia(config_, shape_, state_, payload_kg);
    for (std::size_t j = 0; j < 4; ++j) {
      const double acceleration = config_.joint[j].acceleration;
      const double drive_limit = j == 0 ? std::min(acceleration, torque_limit) : acceleration;
      move_joint(j, h, target[j], brake_limit[j], drive_limit, soil.resist_speed_factor[j]);
    }
  }
}

}  // namespace berm::plant
