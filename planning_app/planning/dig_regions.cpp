#include "planning/dig_regions.hpp"

#include <algorithm>
#include <cmath>

#include "planning/goal_shape.hpp"
#include "planning/skyline.hpp"

namespace berm::app {

namespace {

constexpr double column_step = radians(6.0);  // columns overlap: what slid off a cut's sides is taken with the next
constexpr int widest = 3;                     // columns beyond the site's bearings on either side, where the dig zone allows
constexpr double further_in = 0.4;            // m, of the drag's end
constexpr double swing_s = 12.0;              // for a radian beyond the digs' middle after a dump that lies a radian beyond the bed's: from a far dump to a near dig
constexpr double enough = 0.75;               // of the wanted volume: a bench whose columns yield less is left

// Whether the bucket stays inside a dig zone on a drag along the bearing.
bool zone_holds(const SiteModel& site, const DigBounds& bounds, double half_width) {
  constexpr double before_end = 0.6, beyond_start = 0.9;  // the curled bucket's lip; its shell
  constexpr double swing_spread = 0.5;                    // m, of a standing swing's reach box at that distance, and a map cell's rest
  half_width += swing_spread;
  const double c = std::cos(bounds.bearing), s = std::sin(bounds.bearing);
  for (const double r : {bounds.end_radius - before_end, site.dig_radius_start + beyond_start})
    for (const double across : {-half_width, half_width})
      if (!in_dig_zone(site, r * c - across * s, r * s + across * c)) return false;
  return true;
}

// From the left: the site's own, with widest columns beside them on either side.
std::vector<double> column_bearings(const SiteModel& site) {
  const double width = site.dig_swing_left - site.dig_swing_right;
  const int gaps = static_cast<int>(std::lround(width / column_step));
  std::vector<double> bearings;
  for (int k = widest; k > 0; --k) bearings.push_back(site.dig_swing_left + k * column_step);
  for (int k = 0; k <= gaps; ++k) bearings.push_back(gaps == 0 ? site.dig_swing_left - 0.5 * width : site.dig_swing_left - width * k / gaps);
  for (int k = 1; k <= widest; ++k) bearings.push_back(site.dig_swing_right - k * column_step);
  return bearings;
}

// What of the order a region costs, s. Left to right is free; what slid into the last cut is missing beside it.
double order_cost(const DigRegion& region, const DigRegion& last) {
  constexpr double beside_s = 0.675, leftward_s = 0.09, beside = radians(9.0);
  if (last.bench == 0) return 0.0;
  const double overlap = std::max(0.0, 1.0 - std::fabs(region.bounds.bearing - last.bounds.bearing) / beside);
  return beside_s * overlap + (region.bounds.bearing > last.bounds.bearing ? leftward_s : 0.0);
}

}  // namespace

const char* reach_name(RegionReach reach) {
  static constexpr const char* names[] = {"site", "beside", "nearer"};
  return names[static_cast<std::size_t>(reach)];
}

std::vector<DigRegion> dig_regions(const MachineModel& machine, const SiteModel& site, const DigFloor& floor, const DigNeeds& needs) {
  const double lowest = floor.lowest();
  const int benches = std::max(1, static_cast<int>(std::ceil(-lowest / site.bench_height - 1e-9)));
  const std::vector<double> bearings = column_bearings(site);
  // Down to which a column is dug at its deepest, with the drag of either end.
  std::vector<double> goals;
  for (const double bearing : bearings) goals.push_back(GoalProfile(machine, site, bearing, needs.bucket_width).lowest(site.dig_radius_end, site.dig_radius_start, lowest));
  std::vector<DigRegion> regions;
  for (const RegionReach reach : {RegionReach::site, RegionReach::beside, RegionReach::nearer})
    for (int bench = 1; bench <= benches; ++bench)
      for (int column = 1; column <= static_cast<int>(bearings.size()); ++column) {
        const bool of_site = column > widest && column <= static_cast<int>(bearings.size()) - widest;
        if (reach != RegionReach::nearer && of_site != (reach == RegionReach::site)) continue;
        const double end = site.dig_radius_end - (reach == RegionReach::nearer ? further_in : 0.0);
        const double goal = goals[static_cast<std::size_t>(column - 1)];
        if (bench > 1 && lowest * (bench - 1) / benches <= goal) continue;  // the bench over it is the column's last
        const DigRegion region{bench, column, reach, {bearings[static_cast<std::size_t>(column - 1)], std::max(goal, lowest * bench / benches), end}};
        if (reach == RegionReach::site || zone_holds(site, region.bounds, 0.5 * needs.bucket_width)) regions.push_back(region);
      }
  return regions;
}

RegionDig next_dig(const MachineModel& machine, const SiteModel& site, const DigFloor& floor, const DigGround& ground, const DigNeeds& needs, const DigRegion& last) {
  RegionDig best;
  double best_cost = INFINITY;
  const std::vector<DigRegion> regions = dig_regions(machine, site, floor, needs);
  const double middle = middle_of_digs(site);
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const bool new_group = k > 0 && (regions[k].bench != regions[k - 1].bench || regions[k].reach != regions[k - 1].reach);
    if (new_group && best.plan.volume >= enough * needs.volume) break;
    DigPlan plan = plan_dig(machine, site, floor, ground, needs, regions[k].bounds);
    best.candidates += plan.candidates;
    if (plan.volume < enough * needs.volume) ++best.left;
    // Without the time: that is owed for a column's soil whenever it is dug, and counted here it has those near the truck dug into a hole.
    const double cost = plan.cost + order_cost(regions[k], last) + swing_s * needs.dump_beyond * (middle - regions[k].bounds.bearing);
    if (cost >= best_cost) continue;
    best_cost = cost;
    best.region = regions[k];
    best.plan = std::move(plan);
  }
  return best;
}

}  // namespace berm::app
