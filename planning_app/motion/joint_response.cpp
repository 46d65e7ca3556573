#include "motion/joint_response.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

// Towards the wanted speed, by no more than limit allows.
double approached(double speed, double wanted, double lag, double limit, double seconds) {
  const double gap = wanted - speed, distance = std::fabs(gap), linear = distance - limit * lag;  // beyond this gap the limit holds
  if (linear >= limit * seconds) return speed + std::copysign(limit * seconds, gap);
  const double left = seconds - std::max(0.0, linear) / limit;
  if (lag <= 0.0) return wanted;
  return wanted - std::copysign(std::min(distance, limit * lag) * std::exp(-left / lag), gap);
}

// A torque or a flow has to move an inertia that grows evenly with the load and, between two reaches, nearly evenly with the reach.
double rate_at(const MachineModel::StepResponses& known, const std::array<std::vector<double>, 2>& rates, double reach_m, double loaded) {
  const auto inverse = [&](const std::vector<double>& by_reach) {
    if (by_reach.size() == 1 || reach_m <= known.reach.front()) return 1.0 / by_reach.front();
    std::size_t upper = 1;
    while (upper + 1 < by_reach.size() && known.reach[upper] < reach_m) ++upper;
    const double share = std::clamp((reach_m - known.reach[upper - 1]) / (known.reach[upper] - known.reach[upper - 1]), 0.0, 1.0);
    return (1.0 - share) / by_reach[upper - 1] + share / by_reach[upper];
  };
  return 1.0 / ((1.0 - loaded) * inverse(rates[0]) + loaded * inverse(rates[1]));
}

}  // namespace

double speed_after(const JointResponse& r, double speed, double command, double seconds) {
  const double wanted = std::clamp(r.gain * command, -r.velocity_max, r.velocity_max);
  const double braking = r.deceleration > 0.0 ? r.deceleration : r.acceleration;
  if (wanted == 0.0) return approached(speed, 0.0, r.stop_lag, braking, seconds);
  if (speed * wanted < 0.0) {  // first to standstill, then the other way
    const double standing = std::fabs(speed) / braking;
    if (standing >= seconds) return speed - std::copysign(braking * seconds, speed);
    return approached(0.0, wanted, r.lag, r.acceleration, seconds - standing);
  }
  return approached(speed, wanted, r.lag, std::fabs(wanted) < std::fabs(speed) ? braking : r.acceleration, seconds);
}

JointResponse promised_response(const MachineModel& machine, std::size_t joint) {
  return {machine.command_latency, machine.joint[joint].acceleration_max, machine.joint[joint].velocity_max};
}

TwoWayResponse command_responses_of(const MachineModel& machine, std::size_t joint, double reach_m, double payload_kg) {
  const JointResponse promised = promised_response(machine, joint);
  if (!machine.responses) return {promised, promised};
  const MachineModel::StepResponses& known = *machine.responses;
  const double loaded = std::clamp(payload_kg / known.payload_kg, 0.0, 1.0);
  const auto response = [&](const MachineModel::StepResponse& from) {
    return JointResponse{from.dead_time, rate_at(known, from.speeding, reach_m, loaded), promised.velocity_max, from.lag, from.stop_lag,
                         rate_at(known, from.slowing, reach_m, loaded), from.gain};
  };
  return {response(known.joint[joint].up), response(known.joint[joint].down)};
}

TwoWayResponse responses_of(const MachineModel& machine, std::size_t joint, double reach_m, double payload_kg) {
  TwoWayResponse response = command_responses_of(machine, joint, reach_m, payload_kg);
  if (!machine.responses) return response;  // the promised latency is a bound, and has room for a cycle
  response.up.dead_time += machine.cycle;
  response.down.dead_time += machine.cycle;
  return response;
}

JointResponse response_of(const MachineModel& machine, std::size_t joint) {
  if (!machine.responses) return promised_response(machine, joint);
  const MachineModel::StepResponses& known = *machine.responses;
  return responses_of(machine, joint, 0.5 * (known.reach.front() + known.reach.back()), 0.5 * known.payload_kg).up;
}

}  // namespace berm::app
