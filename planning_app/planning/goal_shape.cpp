#include "planning/goal_shape.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {
constexpr double nothing = -std::numeric_limits<double>::infinity();
}  // namespace

double goal_part_height(const SiteModel& site, double x, double y) {
  for (auto part = site.goal.rbegin(); part != site.goal.rend(); ++part)
    if (x >= part->x_low && x <= part->x_high && y >= part->y_low && y <= part->y_high)
      return part->level + part->slope_x * (x - 0.5 * (part->x_low + part->x_high)) + part->slope_y * (y - 0.5 * (part->y_low + part->y_high));
  return nothing;
}

GoalProfile::GoalProfile(const MachineModel& machine, const SiteModel& site, double bearing, double width) : tip_along_(machine.bucket_length) {
  if (site.goal.empty()) return;
  constexpr int across_steps = 4;  // of half a bucket's width
  const double c = std::cos(bearing), s = std::sin(bearing);
  for (double r = SurfaceProfile::first; r < SurfaceProfile::last + 0.5 * SurfaceProfile::step; r += SurfaceProfile::step) {
    double z = nothing;
    for (int k = -across_steps; k <= across_steps; ++k) {
      const double across = 0.5 * width * k / across_steps;
      z = std::max(z, goal_part_height(site, r * c - across * s, r * s + across * c));
    }
    z_.push_back(z);
  }
  shell_ = BucketShell(machine).points();
}

double GoalProfile::at(double r) const {
  if (z_.empty()) return nothing;
  const double place = std::clamp((r - SurfaceProfile::first) / SurfaceProfile::step, 0.0, static_cast<double>(z_.size() - 1));
  return std::max(z_[static_cast<std::size_t>(place)], z_[static_cast<std::size_t>(std::ceil(place))]);
}

double GoalProfile::least_tip(double r, double attitude) const {
  double z = at(r);
  const double c = std::cos(attitude), s = std::sin(attitude);
  for (const auto& [along, across] : shell_) {
    const double from_tip = along - tip_along_;
    z = std::max(z, at(r + from_tip * c - across * s) - (from_tip * s + across * c));
  }
  return z;
}

double GoalProfile::lowest(double nearest, double farthest, double floor) const {
  if (z_.empty()) return floor;
  double z = std::numeric_limits<double>::infinity();
  for (double r = nearest; r <= farthest + 1e-9; r += SurfaceProfile::step) z = std::min(z, std::max(floor, at(r)));
  return std::max(floor, z);
}

}  // namespace berm::app
