#include "planning/dig_point.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr double profile_step = 0.1;               // m along r
constexpr double bearing_step = radians(6.0);
constexpr double entry_height = 0.35;              // the drag begins this far above the surface
constexpr double bank_slope = 1.35;                // rise over run of a cut face
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

double cut_volume(const Profile& p, double depth, double width, double lowest) {
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < p.r.size(); ++i) {
    const double here = std::max(0.0, p.z[i] - std::max(lowest, tip_height(p, i, depth, lowest)));
    const double next = std::max(0.0, p.z[i + 1] - std::max(lowest, tip_height(p, i + 1, depth, lowest)));
    area += 0.5 * (here + next) * (p.r[i] - p.r[i + 1]);
  }
  return area * width;
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

SurfaceProfile::SurfaceProfile(const TerrainMap& terrain, double bearing, double width) {
  const double c = std::cos(bearing), s = std::sin(bearing);
  const std::size_t count = static_cast<std::size_t>(std::lround((last - first) / step)) + 1;
  constexpr double none = INFINITY;
  std::vector<double> seen(count, none), bound(count, none);
  for (std::size_t i = 0; i < count; ++i) {
    const double r = first + step * static_cast<double>(i);
    double sum = 0.0, bound_sum = 0.0;
    int known = 0, bounded = 0;
    for (int k = -2; k <= 2; ++k) {
      const double across = 0.22 * k * width;
      const double x = r * c - across * s, y = r * s + across * c;
      if (const auto z = terrain.height(x, y)) { sum += *z; ++known; }
      if (const auto z = terrain.bound(x, y)) { bound_sum += *z; ++bounded; }
    }
    if (known > 0) seen[i] = sum / known;
    if (bounded > 0) bound[i] = bound_sum / bounded;
  }
  z_.assign(count, 0.0);
  double before = 0.0;  // the bench, where not even its edge has been seen
  for (std::size_t i = 0; i < count; ++i) {
    double z = seen[i];
    if (z == none) {
      std::size_t next = i;
      while (next < count && seen[next] == none) ++next;
      const double foot = next < count ? std::min(seen[next], before) : -none;
      z = std::min(std::max(before - bank_slope * step, foot), bound[i]);
    }
    z_[i] = before = z;
  }
}

double SurfaceProfile::at(double r) const {
  const double place = std::clamp((r - first) / step, 0.0, static_cast<double>(z_.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(place), z_.size() - 2);
  const double t = place - static_cast<double>(i);
  return (1.0 - t) * z_[i] + t * z_[i + 1];
}

DigPlan plan_dig(const SiteModel& site, const TerrainMap& terrain, const DigNeeds& needs, double bearing) {
  const double lowest = lowest_tip(site, needs.floor_guard);
  const Profile surface = drag_profile(site, SurfaceProfile(terrain, bearing, needs.bucket_width));
  const auto volume = [&](double depth) { return cut_volume(surface, depth, needs.bucket_width, lowest); };
  double low = 0.0, high = needs.deepest;
  if (volume(high) > needs.volume)
    for (int i = 0; i < 20; ++i) {
      const double mid = 0.5 * (low + high);
      (volume(mid) < needs.volume ? low : high) = mid;
    }
  DigPlan plan;
  plan.bearing = bearing;
  plan.depth = high;
  plan.volume = volume(high);
  plan.start_height = surface.z.front();
  plan.drag = drag_of(surface, std::clamp(high + needs.bias, 0.1, 1.4 * needs.deepest), lowest);
  return plan;
}

DigPlan choose_dig(const SiteModel& site, const TerrainMap& terrain, const DigNeeds& needs, double last_bearing) {
  const double width = site.dig_swing_left - site.dig_swing_right;
  const int count = std::max(1, static_cast<int>(std::lround(width / bearing_step)) + 1);
  DigPlan best;
  double best_cost = INFINITY;
  for (int k = 0; k < count; ++k) {
    const double bearing = count == 1 ? site.dig_swing_left - 0.5 * width : site.dig_swing_left - width * k / (count - 1);
    DigPlan plan = plan_dig(site, terrain, needs, bearing);
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
