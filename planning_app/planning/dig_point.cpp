#include "planning/dig_point.hpp"

#include <algorithm>
#include <cmath>

#include "planning/skyline.hpp"

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

double lowest_tip(const SiteModel& site, double guard) {
  double lowest = -1e9;
  for (const DigZone& z : site.dig_zones) lowest = std::max(lowest, z.floor + guard);
  return lowest;
}

DigPlan plan_dig(const MachineModel& machine, const SiteModel& site, const DigGround& ground, const DigNeeds& needs, double bearing) {
  const double lowest = lowest_tip(site, needs.floor_guard);
  const SurfaceProfile surface(ground, bearing, needs.bucket_width);
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
  plan.end_radius = site.dig_radius_end;
  plan.start_height = profile.z.front();
  plan.drag = drag_of(profile, high, lowest);
  return plan;
}

namespace {

// Whether the bucket stays inside a dig zone on a drag along the bearing.
bool zone_holds(const SiteModel& site, double bearing, double half_width) {
  constexpr double before_end = 0.6, beyond_start = 0.9;  // the curled bucket's lip; its shell
  constexpr double swing_spread = 0.5;                    // m, of a standing swing's reach box at that distance, and a map cell's rest
  half_width += swing_spread;
  const double c = std::cos(bearing), s = std::sin(bearing);
  for (const double r : {site.dig_radius_end - before_end, site.dig_radius_start + beyond_start})
    for (const double across : {-half_width, half_width})
      if (!in_dig_zone(site, r * c - across * s, r * s + across * c)) return false;
  return true;
}

struct Search { DigPlan plan; double cost = INFINITY; };

void consider(const MachineModel& machine, const SiteModel& site, const DigGround& ground, const DigNeeds& needs, double last_bearing, double bearing, Search& best) {
  DigPlan plan = plan_dig(machine, site, ground, needs, bearing);
  // A lack of volume costs most, then depth; overlapping the last cut costs, moving from left to right is free.
  const double lack = std::max(0.0, needs.volume - plan.volume) / needs.volume;
  const double overlap = std::max(0.0, 1.0 - std::fabs(bearing - last_bearing) / radians(9.0));
  const double leftward = bearing > last_bearing ? 0.02 : 0.0;
  const double cost = 10.0 * lack + plan.depth + 0.15 * overlap + leftward;
  if (cost >= best.cost) return;
  best.cost = cost;
  best.plan = std::move(plan);
}

}  // namespace

DigPlan choose_dig(const MachineModel& machine, const SiteModel& site, const DigGround& ground, const DigNeeds& needs, double last_bearing) {
  constexpr double enough = 0.75;       // of the wanted volume
  constexpr int widest = 3;             // steps beyond the site's bearings, where the dig zone allows
  constexpr double further_in = 0.4;    // m, of the drag's end
  const double width = site.dig_swing_left - site.dig_swing_right;
  const int count = std::max(1, static_cast<int>(std::lround(width / bearing_step)) + 1);
  Search best;
  for (int k = 0; k < count; ++k)
    consider(machine, site, ground, needs, last_bearing, count == 1 ? site.dig_swing_left - 0.5 * width : site.dig_swing_left - width * k / (count - 1), best);
  if (best.plan.volume >= enough * needs.volume) return best.plan;
  // What the site names is dug out: to both sides of it, then a little nearer to the machine.
  SiteModel wider = site;
  for (const double in : {0.0, further_in}) {
    wider.dig_radius_end = site.dig_radius_end - in;
    for (int step = in > 0.0 ? -count / 2 : 1; step <= widest; ++step)
      for (const double bearing : {site.dig_swing_left + step * bearing_step, site.dig_swing_right - step * bearing_step})
        if (zone_holds(wider, bearing, 0.5 * needs.bucket_width)) consider(machine, wider, ground, needs, last_bearing, bearing, best);
    if (best.plan.volume >= enough * needs.volume) break;
  }
  return best.plan;
}

}  // namespace berm::app
