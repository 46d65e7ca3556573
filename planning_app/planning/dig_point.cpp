#include "planning/dig_point.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr double profile_step = 0.1;               // m along r
constexpr double bearing_step = radians(6.0);
constexpr double entry_height = 0.35;              // the drag begins this far above the surface
constexpr double attitude_entry = radians(-92.0);  // teeth down
constexpr double attitude_end = radians(-172.0);   // curled, mouth up

struct Profile {
  std::vector<double> r, z;  // from the start inward
};

Profile drag_profile(const SiteModel& site, const SurfaceProfile& surface) {
  Profile raw;
  for (double r = site.dig_radius_start; r > site.dig_radius_end - 0.5 * profile_step; r -= profile_step) {
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

double lowest_tip(const SiteModel& site, double guard) {
  double lowest = -1e9;
  for (const DigZone& z : site.dig_zones) lowest = std::max(lowest, z.floor + guard);
  return lowest;
}

double tip_height(const Profile& p, std::size_t i, double depth, double lowest) {
  return std::max(std::min(lowest, p.z[i] + entry_height), p.z[i] - depth * shape(i, p.z.size()));
}

std::vector<DigWaypoint> drag_of(const Profile& p, double depth, double lowest) {
  std::vector<DigWaypoint> w;
  const std::size_t n = p.r.size();
  const auto floor_limited = [&](double z) { return std::max(z, lowest); };
  w.push_back({p.r[0], floor_limited(p.z[0] + entry_height), attitude_entry});
  for (std::size_t i = 0; i < n; ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(n - 1);
    // Teeth down at first; most of the curl comes late, when the bucket fills.
    const double attitude = attitude_entry + (attitude_end - attitude_entry) * u * u * (3.0 - 2.0 * u) * 0.85;
    w.push_back({p.r[i], floor_limited(tip_height(p, i, depth, lowest)), attitude});
  }
  w.push_back({p.r[n - 1], floor_limited(p.z[n - 1]) + 0.25, attitude_end});
  return w;
}

}  // namespace

DigPlan plan_dig(const MachineModel& machine, const SiteModel& site, const TerrainMap& terrain, const DigNeeds& needs, double bearing) {
  const double lowest = lowest_tip(site, needs.floor_guard);
  const SurfaceProfile surface(terrain, bearing, needs.bucket_width);
  const Profile profile = drag_profile(site, surface);
  const auto volume = [&](double depth) {
    const auto path = DigPath::solve(machine, drag_of(profile, depth, lowest));
    return path ? cut_volume(machine, surface, needs.bucket_width, *path) : 0.0;
  };
  double low = 0.0, high = needs.deepest;
  if (volume(high) > needs.volume)
    for (int i = 0; i < 7; ++i) {  // to a centimetre
      const double mid = 0.5 * (low + high);
      (volume(mid) < needs.volume ? low : high) = mid;
    }
  DigPlan plan;
  plan.bearing = bearing;
  plan.depth = high;
  plan.volume = volume(high);
  plan.start_height = profile.z.front();
  plan.drag = drag_of(profile, high, lowest);
  return plan;
}

DigPlan choose_dig(const MachineModel& machine, const SiteModel& site, const TerrainMap& terrain, const DigNeeds& needs, double last_bearing) {
  const double width = site.dig_swing_left - site.dig_swing_right;
  const int count = std::max(1, static_cast<int>(std::lround(width / bearing_step)) + 1);
  DigPlan best;
  double best_cost = INFINITY;
  for (int k = 0; k < count; ++k) {
    const double bearing = count == 1 ? site.dig_swing_left - 0.5 * width : site.dig_swing_left - width * k / (count - 1);
    DigPlan plan = plan_dig(machine, site, terrain, needs, bearing);
    // A lack of volume costs most, then depth; overlapping the last cut costs, moving from left to right is free.
    const double lack = std::max(0.0, needs.volume - plan.volume) / needs.volume;
    const double overlap = std::max(0.0, 1.0 - std::fabs(bearing - last_bearing) / radians(9.0));
    const double leftward = bearing > last_bearing ? 0.02 : 0.0;
    const double cost = 10.0 * lack + plan.depth + 0.15 * overlap + leftward;
    if (cost < best_cost) {
      best_cost = cost;
      best = std::move(plan);
    }
  }
  return best;
}

}  // namespace berm::app
