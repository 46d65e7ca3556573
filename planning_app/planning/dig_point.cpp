#include "planning/dig_point.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr double profile_step = 0.1;               // m along r
constexpr double entry_height = 0.35;              // the drag begins this far above the surface
constexpr double attitude_entry = radians(-92.0);  // teeth down
constexpr double attitude_end = radians(-172.0);   // curled, mouth up

struct Profile {
  std::vector<double> r, z;  // from the start inward
};

Profile drag_profile(const SiteModel& site, const SurfaceProfile& surface, double end_radius) {
  Profile raw;
  for (double r = site.dig_radius_start; r > end_radius - 0.5 * profile_step; r -= profile_step) {
    raw.r.push_back(r);
    raw.z.push_back(surface.at(r));
  }
  Profile smooth = raw;  // a drag need not follow every clod
  for (std::size_t i = 1; i + 1 < raw.z.size(); ++i) smooth.z[i] = (raw.z[i - 1] + raw.z[i] + raw.z[i + 1]) / 3.0;
  return smooth;
}

double shape(std::size_t i, std::size_t n) {
  const double u = static_cast<double>(i) / static_cast<double>(n - 1);
  return std::sin(std::numbers::pi * std::clamp(u, 0.0, 1.0));
}

double tip_height(const Profile& p, std::size_t i, double depth, double lowest) {
  return std::max(std::min(lowest, p.z[i] + entry_height), p.z[i] - depth * shape(i, p.z.size()));
}

std::vector<DigWaypoint> drag_of(const Profile& p, double depth, const DigBounds& bounds, const DigFloor& floor) {
  std::vector<DigWaypoint> w;
  const std::size_t n = p.r.size();
  const auto lowest = [&](double r, double attitude) { return std::max(bounds.floor, floor.at(r, attitude)); };
  w.push_back({p.r[0], std::max(p.z[0] + entry_height, lowest(p.r[0], attitude_entry)), attitude_entry});
  for (std::size_t i = 0; i < n; ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(n - 1);
    // Teeth down at first; most of the curl comes late, when the bucket fills.
    const double attitude = attitude_entry + (attitude_end - attitude_entry) * u * u * (3.0 - 2.0 * u) * 0.85;
    const double least = lowest(p.r[i], attitude);
    w.push_back({p.r[i], std::max(tip_height(p, i, depth, least), least), attitude});
  }
  w.push_back({p.r[n - 1], std::max(p.z[n - 1], lowest(p.r[n - 1], attitude_end)) + 0.25, attitude_end});
  return w;
}

// In seconds, as if the machine's power, and the passes that a lack of volume costs, were time. Swing and drag are left out: with them only the columns
// near the truck are dug, into a hole, and trucks need more passes.
double cost_of(const DigNeeds& needs, const DigPlan& plan) {
  constexpr double lack_s = 45.0;          // a bucket that is not full costs more than its share of a pass: the truck may need another
  constexpr double power = 60e3;           // W, at the bucket
  constexpr double reference_depth = 0.5;  // m: the soil resists the more the deeper the cut
  return lack_s * std::max(0.0, needs.volume - plan.volume) / needs.volume + needs.effort * plan.depth / reference_depth / power;
}

}  // namespace

DigPlan plan_dig(const MachineModel& machine, const SiteModel& site, const DigFloor& floor, const DigGround& ground, const DigNeeds& needs, const DigBounds& bounds) {
  const SurfaceProfile surface(ground, bounds.bearing, needs.bucket_width);
  const Profile profile = drag_profile(site, surface, bounds.end_radius);
  DigPlan plan;
  const auto volume = [&](double depth) {
    const auto path = DigPath::solve(machine, drag_of(profile, depth, bounds, floor));
    return path ? cut_volume(machine, surface, needs.bucket_width, *path) : 0.0;
  };
  double low = 0.0, high = needs.deepest;
  if (volume(high) > needs.volume)
    for (int i = 0; i < 7; ++i) {  // to a centimetre
      const double mid = 0.5 * (low + high);
      (volume(mid) < needs.volume ? low : high) = mid;
    }
  plan.bearing = bounds.bearing;
  plan.depth = high;
  plan.volume = volume(high);
  plan.start_height = profile.z.front();
  plan.drag = drag_of(profile, high, bounds, floor);
  plan.cost = cost_of(needs, plan);
  return plan;
}

}  // namespace berm::app
