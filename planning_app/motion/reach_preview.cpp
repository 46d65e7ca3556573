#include "motion/reach_preview.hpp"

#include <algorithm>
#include <cmath>

#include "motion/arm_kinematics.hpp"

namespace berm::app {

namespace {

double brake_angle(const BrakingTable& table, std::size_t joint, double reach_m, double speed, double velocity_max) {
  std::size_t row = 0;
  while (row + 1 < table.reach.size() && table.reach[row] < reach_m) ++row;
  const auto& columns = table.angle[joint][row];
  const double last = static_cast<double>(columns.size() - 1);
  const double column = std::clamp(std::ceil(speed / velocity_max * last - 1e-9), 0.0, last);
  return columns[static_cast<std::size_t>(column)];
}

// Calls visit(point) for points along a part's outline at most spacing apart.
template <typename Visit>
void along_outline(const MachineModel& machine, const Prism& part, const Joints& q, double spacing, Visit visit) {
  const ArmPoints arm = forward(machine, q);
  const PlanePoint base = part.link == boom ? arm.boom_pin : part.link == stick ? arm.stick_pin : arm.bucket_pin;
  const double attitude = part.link == boom ? q[boom] : part.link == stick ? arm.stick_attitude : arm.bucket_attitude;
  const double c = std::cos(attitude), s = std::sin(attitude);
  const std::size_t n = part.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto& from = part.outline[i];
    const auto& to = part.outline[(i + 1) % n];
    const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / spacing)));
    for (int k = 0; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      const double x = from[0] + t * (to[0] - from[0]), z = from[1] + t * (to[1] - from[1]);
      visit(PlanePoint{base.r + x * c - z * s, base.z + x * s + z * c});
    }
  }
}

}  // namespace

double stop_travel(const MachineModel& machine, std::size_t joint, double reach_m, double velocity) {
  const JointLimits& limits = machine.joint[joint];
  const double latency = machine.state_latency + machine.command_latency + machine.cycle;
  const double start = velocity + limits.velocity_error;
  const double end = std::clamp(start + limits.acceleration_max * latency, 0.0, limits.velocity_max);
  const double before_braking = 0.5 * (std::max(start, 0.0) + end) * latency;
  const double braking = end > 0.0 ? brake_angle(machine.braking, joint, reach_m, end, limits.velocity_max) : 0.0;
  return limits.angle_error + before_braking + braking;
}

double within_range(const MachineModel& machine, std::size_t joint, double reach_m, double angle, double wanted) {
  const JointLimits& limits = machine.joint[joint];
  constexpr double spare = radians(3.5);  // a column of the braking table, and a joint that answers faster than its model
  const double room = (wanted > 0.0 ? limits.high - angle : angle - limits.low) - spare;
  constexpr int steps = 16;
  for (int k = steps; k > 0; --k) {
    const double speed = std::fabs(wanted) * k / steps;
    if (stop_travel(machine, joint, reach_m, speed) <= room) return std::copysign(speed, wanted);
  }
  return 0.0;
}

ReachIntervals preview(const MachineModel& machine, const Joints& angle, const Joints& velocity) {
  ReachIntervals box;
  box.reach = reach_of(machine, angle) + 0.3;  // the intervals themselves lengthen the reach a little
  for (std::size_t j = 0; j < joints; ++j) {
    box.high[j] = angle[j] + stop_travel(machine, j, box.reach, velocity[j]);
    box.low[j] = angle[j] - stop_travel(machine, j, box.reach, -velocity[j]);
  }
  const JointLimits& s = machine.joint[swing];
  const double latency = machine.state_latency + machine.command_latency + machine.cycle;
  box.swing_speed = std::fabs(velocity[swing]) + s.velocity_error + s.acceleration_max * latency;
  return box;
}

LowerEdge::LowerEdge(const MachineModel& machine, const ReachIntervals& box) {
  z_.fill(none);
  constexpr double spacing = 0.19;  // under a bin
  const auto sample = [&](std::size_t j, int k) { return box.low[j] + 0.5 * k * (box.high[j] - box.low[j]); };
  for (int kb = 0; kb < 3; ++kb)
    for (int ks = 0; ks < 3; ++ks)
      for (int kk = 0; kk < 3; ++kk) {
        const Joints q{0.0, sample(boom, kb), sample(stick, ks), sample(bucket, kk)};
        for (const Prism& part : machine.parts) {
          if (part.link == boom) continue;
          if (part.link == stick && kk != 0) continue;
          half_width_ = std::max(half_width_, part.half_width);
          along_outline(machine, part, q, spacing, [&](const PlanePoint& p) {
            reach_ = std::max(reach_, p.r);
            nearest_ = std::min(nearest_, p.r);
            const int bin = static_cast<int>(p.r / bin_m);
            if (p.r >= 0.0 && bin < bins) z_[static_cast<std::size_t>(bin)] = std::min(z_[static_cast<std::size_t>(bin)], p.z);
          });
        }
      }
}

double LowerEdge::lowest() const { return *std::min_element(z_.begin(), z_.end()); }

LowerEdge lower_edge(const MachineModel& machine, const Joints& pose) {
  ReachIntervals box;
  box.low = box.high = pose;
  return LowerEdge(machine, box);
}

double bucket_underside(const MachineModel& machine, const Joints& pose) {
  double lowest = LowerEdge::none;
  for (const Prism& part : machine.parts)
    if (part.link == bucket) along_outline(machine, part, pose, 10.0, [&](const PlanePoint& p) { lowest = std::min(lowest, p.z); });
  return lowest;
}

double reach_of(const MachineModel& machine, const Joints& pose) {
  double reach = 0.0;
  for (const Prism& part : machine.parts)
    along_outline(machine, part, pose, 10.0, [&](const PlanePoint& p) { reach = std::max(reach, std::hypot(p.r, part.half_width)); });
  return reach;
}

}  // namespace berm::app
