#include "motion/dig_path.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr double error_full_stop = radians(14.0);   // the reference waits when the joints are this far behind

constexpr double guard = radians(7.5);              // keeps a standing joint's stop travel inside its range

std::optional<Joints> pose_with(const MachineModel& machine, const DigWaypoint& w, double attitude) {
  if (attitude > radians(-20.0) || attitude < radians(-200.0)) return std::nullopt;
  return inverse_tip(machine, {w.r, w.z}, attitude, guard);
}

// Between an attitude that is possible and one that is not, the nearest that is, to a hundredth of a degree: in whole degrees a path along a joint's range would
// jump, and whoever follows it wait.
Joints nearest_pose(const MachineModel& machine, const DigWaypoint& w, double possible, double impossible, Joints pose) {
  while (std::fabs(possible - impossible) > radians(0.01)) {
    const double middle = 0.5 * (possible + impossible);
    const auto q = pose_with(machine, w, middle);
    (q ? possible : impossible) = middle;
    if (q) pose = *q;
  }
  return pose;
}

}  // namespace

std::optional<Joints> pose_at(const MachineModel& machine, const DigWaypoint& w) {
  constexpr double step = radians(1.0);
  if (const auto q = pose_with(machine, w, w.attitude)) return q;
  for (int steps = 1; steps <= 80; ++steps)
    for (const double sign : {1.0, -1.0}) {
      const double attitude = w.attitude + sign * steps * step;
      if (const auto q = pose_with(machine, w, attitude)) return nearest_pose(machine, w, attitude, attitude - sign * step, *q);
    }
  return std::nullopt;
}

std::optional<DigPath> DigPath::solve(const MachineModel& machine, const std::vector<DigWaypoint>& waypoints, double apart) {
  DigPath path;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const DigWaypoint& to = waypoints[i];
    const DigWaypoint& from = i == 0 ? to : waypoints[i - 1];
    const double way = std::hypot(to.r - from.r, to.z - from.z) + 0.5 * machine.bucket_length * std::fabs(to.attitude - from.attitude);
    const int pieces = i == 0 ? 1 : std::max(1, static_cast<int>(std::ceil(way / apart)));
    for (int k = 1; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      const auto q = pose_at(machine, {from.r + t * (to.r - from.r), from.z + t * (to.z - from.z), from.attitude + t * (to.attitude - from.attitude)});
      if (!q) return std::nullopt;
      if (i > 0) path.length_ += way / pieces;
      path.samples_.push_back({path.length_, *q});
    }
  }
  if (path.samples_.size() < 2 || path.length_ <= 0.0) return std::nullopt;
  return path;
}

double speed_along(const MachineModel& machine, const Joints& slope, double wanted) {
  constexpr double joint_share = 0.95;  // of a joint's largest speed that the reference may ask for
  for (const std::size_t j : {boom, stick, bucket})
    if (slope[j] != 0.0) wanted = std::min(wanted, joint_share * machine.joint[j].velocity_max / std::fabs(slope[j]));
  return wanted;
}

std::size_t DigPath::segment(double s) const {
  const auto after = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, s, [](double at, const Sample& sample) { return at < sample.s; });
  return static_cast<std::size_t>(after - samples_.begin()) - 1;
}

Joints DigPath::at(double s) const {
  const std::size_t i = segment(s);
  const double t = std::clamp((s - samples_[i].s) / (samples_[i + 1].s - samples_[i].s), 0.0, 1.0);
  Joints q{};
  for (std::size_t j = 0; j < joints; ++j) q[j] = samples_[i].q[j] + t * (samples_[i + 1].q[j] - samples_[i].q[j]);
  return q;
}

Joints DigPath::slope(double s) const {
  const std::size_t i = segment(s);
  Joints d{};
  for (std::size_t j = 0; j < joints; ++j) d[j] = (samples_[i + 1].q[j] - samples_[i].q[j]) / (samples_[i + 1].s - samples_[i].s);
  return d;
}

Joints DigFollower::departed(const MachineModel& machine, const Joints& on_path, const Departure& departure) {
  const ArmPoints arm = forward(machine, on_path);
  if (departure.lift == 0.0 && departure.curl >= arm.bucket_attitude) return on_path;
  return pose_at(machine, {arm.tip.r, arm.tip.z + departure.lift, std::min(arm.bucket_attitude, departure.curl)}).value_or(on_path);
}

Joints DigFollower::step(const MachineModel& machine, ArmController& arm, double held_swing, double speed, const Joints& angle, const Joints& velocity) {
  if (!path_) return {};
  const Joints slope = path_->slope(s_);
  speed = speed_along(machine, slope, speed);
  const Joints on_path = path_->at(s_);
  Joints reference = departed(machine, on_path, departure_);
  // What a changed departure moves the reference by comes on top of its way along the path.
  const Joints before = departed(machine, on_path, last_departure_);
  last_departure_ = departure_;
  const Joints then = arm.predicted(angle, velocity);
  double behind = 0.0;
  for (const std::size_t j : {boom, stick, bucket}) behind = std::max(behind, std::fabs(reference[j] - then[j]));
  const double go = std::clamp(1.0 - behind / error_full_stop, 0.0, 1.0);
  stalled_ = go < 0.15 ? stalled_ + machine.cycle : 0.0;
  Joints reference_velocity{};
  const double ends = finished() ? 0.0 : speed * go;
  for (const std::size_t j : {boom, stick, bucket}) reference_velocity[j] = slope[j] * ends + (reference[j] - before[j]) / machine.cycle;
  s_ = std::min(path_->length(), s_ + ends * machine.cycle);
  reference[swing] = held_swing;
  Joints command = arm.follow(reference, reference_velocity, angle, velocity);
  command[swing] = 0.0;  // the swing stands while the bucket is in the soil
  return command;
}

}  // namespace berm::app
