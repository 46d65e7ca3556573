#include "motion/reach_preview.hpp"

#include <algorithm>
#include <cmath>

#include "motion/arm_kinematics.hpp"

namespace berm::app {

namespace {

// s from a reading on in which a joint may gain speed; commands are no faster than what is previewed, but for what is measured wrong.
double gaining(const MachineModel& machine) { return machine.state_latency + machine.command_latency + machine.cycle; }

// s from a reading on until the command going out now has had its time, if it is the last that the machine hears before it brakes by itself.
double obeyed_for(const MachineModel& machine) {
  return machine.state_latency + machine.command_latency + std::max(machine.cycle, heartbeat_silence) + kernel_sends_within;
}

// On the chord between the table's speeds, as the kernel takes it.
double brake_angle(const BrakingTable& table, std::size_t joint, double reach_m, double speed, double velocity_max) {
  std::size_t row = 0;
  while (row + 1 < table.reach.size() && table.reach[row] < reach_m) ++row;
  const auto& columns = table.angle[joint][row];
  const double at = std::clamp(speed / velocity_max, 0.0, 1.0) * static_cast<double>(columns.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), columns.size() - 2);
  return columns[below] + (at - static_cast<double>(below)) * (columns[below + 1] - columns[below]);
}

// Points along a part's outline at most spacing apart, in its link's frame.
std::vector<PlanePoint> outline_points(const Prism& part, double spacing) {
  std::vector<PlanePoint> points;
  const std::size_t n = part.outline.size();
  points.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto& from = part.outline[i];
    const auto& to = part.outline[(i + 1) % n];
    const double dx = to[0] - from[0], dy = to[1] - from[1];
    const bool near = std::fabs(dx) + std::fabs(dy) < spacing;  // then hypot is no larger either, and takes longer
    const int pieces = near ? 1 : std::max(1, static_cast<int>(std::ceil(std::hypot(dx, dy) / spacing)));
    for (int k = 0; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      points.push_back({from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])});
    }
  }
  return points;
}

// Calls visit(point) for the points of a part where a pose has them.
template <typename Visit>
void for_points(const MachineModel& machine, const Prism& part, const std::vector<PlanePoint>& points, const Joints& q, Visit visit) {
  const ArmPoints arm = forward(machine, q);
  const PlanePoint base = part.link == boom ? arm.boom_pin : part.link == stick ? arm.stick_pin : arm.bucket_pin;
  const double attitude = part.link == boom ? q[boom] : part.link == stick ? arm.stick_attitude : arm.bucket_attitude;
  const double c = std::cos(attitude), s = std::sin(attitude);
  for (const PlanePoint& p : points) visit(PlanePoint{base.r + p.r * c - p.z * s, base.z + p.r * s + p.z * c});
}

// Calls visit(pose) for poses whose links' attitudes run through the sums of the joints' intervals, each on its own: a cover, as the kernel's.
template <typename Visit>
void for_attitudes(const ReachIntervals& box, int bucket_samples, Visit visit) {
  const auto sample = [](double low, double high, int k) { return low + 0.5 * k * (high - low); };
  const double stick_low = box.low[boom] + box.low[stick], stick_high = box.high[boom] + box.high[stick];
  for (int kb = 0; kb < 3; ++kb)
    for (int ks = 0; ks < 3; ++ks)
      for (int kk = 0; kk < bucket_samples; ++kk) {
        const double boom_at = sample(box.low[boom], box.high[boom], kb), stick_at = sample(stick_low, stick_high, ks);
        const double bucket_at = sample(stick_low + box.low[bucket], stick_high + box.high[bucket], kk);
        visit(Joints{0.0, boom_at, stick_at - boom_at, bucket_at - stick_at});
      }
}

constexpr double corners_only = 10.0;  // m: longer than any side

double reach_over(const MachineModel& machine, const ReachIntervals& box) {
  constexpr double cover_slack = 0.1;  // the kernel's cover is a polygon of few edges
  double reach = 0.0;
  for (const Prism& part : machine.parts) {
    if (part.link == boom) continue;
    const std::vector<PlanePoint> corners = outline_points(part, corners_only);
    double ahead = 0.0;
    for_attitudes(box, part.link == bucket ? 3 : 1, [&](const Joints& q) {
      for_points(machine, part, corners, q, [&](const PlanePoint& p) { ahead = std::max(ahead, std::fabs(p.r)); });
    });
    reach = std::max(reach, std::hypot(ahead, part.half_width));
  }
  return reach + cover_slack;
}

}  // namespace

double stop_travel(const MachineModel& machine, std::size_t joint, double reach_m, double velocity) {
  const JointLimits& limits = machine.joint[joint];
  const double start = velocity + limits.velocity_error;
  const double end = std::min(start + limits.acceleration_max * gaining(machine), limits.velocity_max);
  if (end <= 0.0) return limits.angle_error;
  // Up to that speed as fast as it can, and on at it.
  const double gain = std::min(end - start, limits.acceleration_max * gaining(machine));
  const double before_braking = std::max(end * obeyed_for(machine) - gain * gain / (2.0 * limits.acceleration_max), 0.0);
  return limits.angle_error + before_braking + brake_angle(machine.braking, joint, reach_m, end, limits.velocity_max);
}

double within_range(const MachineModel& machine, std::size_t joint, double reach_m, double angle, double wanted) {
  const JointLimits& limits = machine.joint[joint];
  constexpr double spare = radians(3.5);  // for a joint that answers faster than its model
  const double room = (wanted > 0.0 ? limits.high - angle : angle - limits.low) - spare;
  constexpr double noise = radians(1.5);  // of a measured speed
  constexpr int steps = 16;
  for (int k = steps; k > 0; --k) {
    const double speed = std::fabs(wanted) * k / steps;
    if (stop_travel(machine, joint, reach_m, speed + noise) <= room) return std::copysign(speed, wanted);
  }
  return 0.0;
}

ReachIntervals preview(const MachineModel& machine, const Joints& angle, const Joints& velocity) {
  ReachIntervals box;
  const auto joint = [&](std::size_t j, double reach_m) {
    box.high[j] = angle[j] + stop_travel(machine, j, reach_m, velocity[j]);
    box.low[j] = angle[j] - stop_travel(machine, j, reach_m, -velocity[j]);
  };
  // As the kernel does: the last row bounds the arm's intervals, the reach over them gives the row of the swing.
  for (const std::size_t j : {boom, stick, bucket}) joint(j, machine.braking.reach.back());
  box.reach = reach_over(machine, box);
  joint(swing, box.reach);
  const JointLimits& s = machine.joint[swing];
  box.swing_speed = std::fabs(velocity[swing]) + s.velocity_error + s.acceleration_max * gaining(machine);
  return box;
}

namespace {

// Lower convex hull of the points kept by bin, filled in for every bin between its ends.
void close_below(std::array<double, LowerEdge::bins>& z) {
  std::vector<int> hull;
  for (int i = 0; i < LowerEdge::bins; ++i) {
    if (z[static_cast<std::size_t>(i)] == LowerEdge::none) continue;
    while (hull.size() >= 2) {
      const int m = hull.back(), f = hull[hull.size() - 2];
      const double line = z[static_cast<std::size_t>(f)] + (z[static_cast<std::size_t>(i)] - z[static_cast<std::size_t>(f)]) * (m - f) / (i - f);
      if (z[static_cast<std::size_t>(m)] < line) break;
      hull.pop_back();
    }
    hull.push_back(i);
  }
  for (std::size_t k = 0; k + 1 < hull.size(); ++k)
    for (int i = hull[k]; i < hull[k + 1]; ++i) {
      const double from = z[static_cast<std::size_t>(hull[k])], to = z[static_cast<std::size_t>(hull[k + 1])];
      z[static_cast<std::size_t>(i)] = from + (to - from) * (i - hull[k]) / (hull[k + 1] - hull[k]);
    }
}

}  // namespace

LowerEdge::LowerEdge(const MachineModel& machine, const ReachIntervals& box) {
  z_.fill(none);
  constexpr double spacing = 0.19;  // under a bin
  for (const Prism& part : machine.parts) {
    if (part.link == boom) continue;
    half_width_ = std::max(half_width_, part.half_width);
    std::array<double, bins> lowest;
    lowest.fill(none);
    const std::vector<PlanePoint> points = outline_points(part, spacing);
    for_attitudes(box, part.link == bucket ? 3 : 1, [&](const Joints& q) {
      for_points(machine, part, points, q, [&](const PlanePoint& p) {
        reach_ = std::max(reach_, p.r);
        nearest_ = std::min(nearest_, p.r);
        const int bin = static_cast<int>(p.r / bin_m);
        if (p.r >= 0.0 && bin < bins) lowest[static_cast<std::size_t>(bin)] = std::min(lowest[static_cast<std::size_t>(bin)], p.z);
      });
    });
    close_below(lowest);
    for (std::size_t i = 0; i < lowest.size(); ++i) z_[i] = std::min(z_[i], lowest[i]);
  }
}

double LowerEdge::lowest() const { return *std::min_element(z_.begin(), z_.end()); }

bool clears_own_body(const MachineModel& machine, const LowerEdge& edge) {
  constexpr double rim = 0.55;  // the kernel closes the cells that its own body's circle touches, too
  return edge.nearest() >= machine.own_body_radius + rim;
}

LowerEdge lower_edge(const MachineModel& machine, const Joints& pose) {
  ReachIntervals box;
  box.low = box.high = pose;
  return LowerEdge(machine, box);
}

double bucket_underside(const MachineModel& machine, const Joints& pose) {
  double lowest = LowerEdge::none;
  for (const Prism& part : machine.parts)
    if (part.link == bucket)
      for_points(machine, part, outline_points(part, corners_only), pose, [&](const PlanePoint& p) { lowest = std::min(lowest, p.z); });
  return lowest;
}

double bucket_width(const MachineModel& machine) {
  double half = 0.0;
  for (const Prism& part : machine.parts)
    if (part.link == bucket) half = std::max(half, part.half_width);
  return 1.85 * half;  // the prism covers the bucket with some room
}

Extent extent_of(const MachineModel& machine, const Prism& part, const Joints& pose) {
  Extent extent{INFINITY, -INFINITY};
  for_points(machine, part, outline_points(part, corners_only), pose, [&](const PlanePoint& p) {
    extent.near = std::min(extent.near, p.r);
    extent.far = std::max(extent.far, p.r);
  });
  return extent;
}

double reach_of(const MachineModel& machine, const Joints& pose) {
  double reach = 0.0;
  for (const Prism& part : machine.parts)
    for_points(machine, part, outline_points(part, corners_only), pose,
               [&](const PlanePoint& p) { reach = std::max(reach, std::hypot(p.r, part.half_width)); });
  return reach;
}

}  // namespace berm::app
