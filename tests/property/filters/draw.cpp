#include "draw.hpp"

#include <algorithm>
#include <cmath>

namespace berm::kernel::test {

namespace {

double bearing_of(Spot of, Spot from, double about) { return std::remainder(std::atan2(of.y - from.y, of.x - from.x) - about, 2 * 3.14159265358979323846); }

bool clear_of_body(const std::vector<Spot>& footprint, double radius) {
  // The nearest point of a convex footprint far larger than nothing: its edges, finely.
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Spot a = footprint[i], b = footprint[(i + 1) % footprint.size()];
    for (int k = 0; k < 20; ++k)
      if (std::hypot(a.x + (b.x - a.x) * k / 20, a.y + (b.y - a.y) * k / 20) < radius) return false;
  }
  return true;
}

}  // namespace

double seen_under(const std::vector<Spot>& footprint, Spot from) {
  if (footprint.empty()) return 0.0;
  const double about = std::atan2(footprint[0].y - from.y, footprint[0].x - from.x);
  double low = 0.0, high = 0.0;
  for (const Spot& corner : footprint) {
    const double b = bearing_of(corner, from, about);
    low = std::min(low, b);
    high = std::max(high, b);
  }
  return high - low;
}

void Placed::pass(double rate, std::mt19937_64& random) const {
  const double reach = half_angle + 2.0 * rate * kLinePeriod + degrees(0.5);
  const double way = random() % 2 == 0 ? reach : -reach;
  sweep->pan(scanner, pan - way, pan + way, rate, uniform(random, 0.0, kSamplesPerTurn));
}

Placed draw_thing(const berm_parameters& parameters, double distance, double diameter, double z_low, double z_high, std::mt19937_64& random) {
  for (;;) {
    Placed placed;
    placed.scanner = static_cast<int>(random() % 2);
    placed.pan = degrees(uniform(random, 35.0, 120.0)) * (placed.scanner == 0 ? 1.0 : -1.0);
    placed.sweep = std::make_unique<Sweep>(parameters, uniform(random, -3.1, 3.1));
    const Spot axis = placed.sweep->at(placed.scanner, placed.pan, distance);
    Prism thing = cylinder_around(axis, diameter, z_high);
    if (random() % 4 != 0) {
      const double yaw = uniform(random, -3.1, 3.1), along = diameter + uniform(random, 0.0, 1.0), across = diameter + uniform(random, 0.0, 0.5);
      const double u = uniform(random, -0.5, 0.5) * (along - diameter), v = uniform(random, -0.5, 0.5) * (across - diameter);
      thing = box({axis.x + u * std::cos(yaw) - v * std::sin(yaw), axis.y + u * std::sin(yaw) + v * std::cos(yaw)}, yaw, along, across, 0.0, z_high);
    }
    thing.z_low = z_low;
    if (!in_map(thing.footprint) || !clear_of_body(thing.footprint, parameters.own_body_radius_mm * 1e-3 + 0.1)) continue;
    const Spot head = placed.sweep->head(placed.scanner);
    for (const Spot& corner : thing.footprint) placed.half_angle = std::max(placed.half_angle, std::fabs(bearing_of(corner, head, placed.sweep->bearing(placed.pan))));
    placed.sweep->scene.thing = {thing};
    return placed;
  }
}

}  // namespace berm::kernel::test
