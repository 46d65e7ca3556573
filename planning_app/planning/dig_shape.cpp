#include "planning/dig_shape.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr double range_guard = radians(7.5);      // a standing joint's stop travel stays inside its range

// How far the bucket's shell reaches below its tip at an attitude, m.
double shell_under_tip(const MachineModel& machine, double attitude) {
  constexpr double shell_side = -0.05;  // the outline's other side is the heaped load
  double under = 0.0;
  for (const Prism& part : machine.parts)
    for (const auto& point : part.outline)
      if (part.link == bucket && point[1] > shell_side)
        under = std::max(under, -((point[0] - machine.bucket_length) * std::sin(attitude) + point[1] * std::cos(attitude)));
  return under;
}

}  // namespace

double bank_over(const SurfaceProfile& surface, const ArmPoints& now) {
  constexpr double nearer = 0.5;  // m
  return surface.at(now.tip.r - nearer) - now.tip.z;
}

std::vector<DigWaypoint> way_out(const MachineModel& machine, const SurfaceProfile& surface, const ArmPoints& now) {
  constexpr double over_surface = 0.15, inward = 0.05, lift = 0.80, step = 0.05, highest_rise = 2.5, most_inward = 0.5;
  constexpr int curl_steps = 6;
  constexpr double rise_sooner = 0.4;  // than the curl: clear of the wall behind the bucket
  const double up = now.tip.r - inward, under = shell_under_tip(machine, now.bucket_attitude);
  const double last = std::min(now.bucket_attitude, curled), rise = std::max(0.0, shell_under_tip(machine, last) - under);
  std::vector<DigWaypoint> way{{now.tip.r, now.tip.z, now.bucket_attitude}};
  double z = now.tip.z;
  for (int k = 1; k <= curl_steps; ++k) {
    const double attitude = now.bucket_attitude + (last - now.bucket_attitude) * k / curl_steps;
    z = std::max({z, now.tip.z + shell_under_tip(machine, attitude) - under, now.tip.z + rise * std::pow(static_cast<double>(k) / curl_steps, rise_sooner)});
    way.push_back({up, z, attitude});
  }
  z = std::max(z, surface.at(up) + over_surface);
  const auto curls = [&](double r, double height) { return inverse_tip(machine, {r, height}, curled, range_guard).has_value(); };
  double r = up, top = z + lift;
  while (top < z + lift + highest_rise && !curls(up - most_inward, top)) top += step;
  while (r > SurfaceProfile::first && !curls(r, top)) r -= step;
  way.push_back({r, std::max(top, surface.at(r) + over_surface + lift), curled});
  return way;
}

void lower_ground(DigGround& ground, double bearing, double bucket_width, const SurfaceProfile& after) {
  const SurfaceProfile before(ground, bearing, bucket_width);
  const double half = 0.45 * bucket_width, c = std::cos(bearing), s = std::sin(bearing);
  for (double r = SurfaceProfile::first; r < SurfaceProfile::last; r += 0.5 * DigGround::cell) {
    if (after.at(r) > before.at(r) - 0.02) continue;
    for (double across = -half; across <= half; across += 0.5 * DigGround::cell) ground.lower_to(r * c - across * s, r * s + across * c, after.at(r));
  }
}

DigShape shape_after(const MachineModel& machine, DigGround ground, double bearing, double bucket_width, const DigPath& path, double volume, double start_r) {
  constexpr double unchanged = 0.02;  // m
  constexpr double pace = 0.06;       // m along a path
  const SurfaceProfile before(ground, bearing, bucket_width);
  CutModel cut(machine, before, bucket_width);
  double s = 0.0;
  for (; s < path.length() && cut.volume() < volume; s += pace) cut.reach(path.at(s));
  if (const auto out = DigPath::solve(machine, way_out(machine, before, forward(machine, path.at(s)))))
    for (double way = 0.0; way < out->length(); way += pace) cut.reach(out->at(way));
  lower_ground(ground, bearing, bucket_width, cut.surface());
  ground.settle();
  const SurfaceProfile after(ground, bearing, bucket_width);
  double inner = SurfaceProfile::first;
  while (inner < start_r && std::fabs(after.at(inner) - before.at(inner)) < unchanged) inner += SurfaceProfile::step;
  DigShape shape;
  for (double r = start_r; r > inner - 0.5 * SurfaceProfile::step; r -= SurfaceProfile::step) shape.push_back({r, after.at(r)});
  return shape;
}

}  // namespace berm::app
