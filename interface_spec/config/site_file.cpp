#include "config/site_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "config/parameter_block.h"
#include "config/strict_table.hpp"

namespace berm::config {

namespace {

constexpr double kHighest = 20.0;  // the map's heights end there: nothing is too high to be passed over

constexpr double kLeastSide = 0.01;
constexpr std::size_t kMostGoalParts = 8;

struct Sides {
  std::array<double, 2> x, y;
};

Sides read_sides(StrictTable& table) {
  const auto x = table.interval("x", -15.0, 15.0, kLeastSide);
  return {x, table.interval("y", -15.0, 15.0, kLeastSide)};
}

DigZoneFile read_zone(StrictTable table) {
  const Sides s = read_sides(table);
  const double floor = table.number("floor", -15.0, 5.0);
  const DigZoneFile zone{s.x[0], s.x[1], s.y[0], s.y[1], floor, table.number("ceiling", floor + kLeastSide, 10.0)};
  table.finish();
  return zone;
}

GroundZoneFile read_ground(StrictTable table) {
  const Sides s = read_sides(table);
  const GroundZoneFile zone{s.x[0], s.x[1], s.y[0], s.y[1], table.number("pass_over", -15.0, kHighest)};
  table.finish();
  return zone;
}

TruckZoneFile read_truck_zone(StrictTable table) {
  const Sides s = read_sides(table);
  const TruckZoneFile zone{s.x[0], s.x[1], s.y[0], s.y[1], table.number("ceiling", -10.0, kHighest)};
  table.finish();
  return zone;
}

// Zones of the overpass rule: there may be none of either kind.
void read_overpass(StrictTable& file, SiteFile& site) {
  site.pass_over = file.number("pass_over", -15.0, kHighest);
  for (auto& zone : file.tables("ground_zone")) site.ground_zone.push_back(read_ground(std::move(zone)));
  if (site.ground_zone.size() > BERM_GROUND_ZONES) file.fail("ground_zone", fmt::format("{} zones, up to {} are taken", site.ground_zone.size(), BERM_GROUND_ZONES));
  for (auto& zone : file.tables("truck_zone")) site.truck_zone.push_back(read_truck_zone(std::move(zone)));
  if (site.truck_zone.size() > BERM_TRUCK_ZONES) file.fail("truck_zone", fmt::format("{} zones, up to {} are taken", site.truck_zone.size(), BERM_TRUCK_ZONES));
}

// None where no truck passes through the safety region.
void read_lanes(StrictTable& file, SiteFile& site) {
  for (auto& lane : file.tables("truck_lane")) {
    const Sides s = read_sides(lane);
    lane.finish();
    site.truck_lane.push_back({s.x[0], s.x[1], s.y[0], s.y[1]});
  }
  if (site.truck_lane.size() > BERM_LANES) file.fail("truck_lane", fmt::format("{} lanes, up to {} are taken", site.truck_lane.size(), BERM_LANES));
}

TruckPlaceFile read_truck(StrictTable table) {
  TruckPlaceFile truck{};
  truck.centre = table.array<2>("centre", -15.0, 15.0);
  truck.yaw = table.degrees("yaw_deg", -180.0, 180.0);
  truck.target_kg = table.number("target_kg", 100.0, 200000.0);
  table.finish();
  return truck;
}

// None of it under the floor of the digs.
GoalPartFile read_goal(StrictTable table, double floor) {
  const Sides s = read_sides(table);
  GoalPartFile part{s.x[0], s.x[1], s.y[0], s.y[1], table.number("level", floor, 0.0), {0.0, 0.0}};
  if (table.has("slope")) part.slope = table.array<2>("slope", -0.5, 0.5);
  const double falls = 0.5 * (std::fabs(part.slope[0]) * (s.x[1] - s.x[0]) + std::fabs(part.slope[1]) * (s.y[1] - s.y[0]));
  if (part.level - falls < floor - 1e-9) table.fail("slope", fmt::format("it falls to {:.2f}, under the floor of the digs, {:.2f}", part.level - falls, floor));
  table.finish();
  return part;
}

void read_goals(StrictTable& dig, DigFile& file) {
  for (auto& part : dig.tables("goal")) file.goal.push_back(read_goal(std::move(part), file.floor));
  if (file.goal.size() > kMostGoalParts) dig.fail("goal", fmt::format("{} parts, up to {} are taken", file.goal.size(), kMostGoalParts));
}

}  // namespace

SiteFile load_site_file(const std::string& path) {
  StrictTable file = StrictTable::parse_file(path);
  SiteFile site;
  file.integer("schema", 1, 1);
  site.name = file.text("name");
  for (auto& zone : file.tables("dig_zone")) site.dig_zone.push_back(read_zone(std::move(zone)));
  if (site.dig_zone.empty() || site.dig_zone.size() > BERM_DIG_ZONES)
    file.fail("dig_zone", fmt::format("{} zones, 1 to {} are taken", site.dig_zone.size(), BERM_DIG_ZONES));
  read_overpass(file, site);
  read_lanes(file, site);
  site.truck = read_truck(file.table("truck"));
  StrictTable dig = file.table("dig");
  const auto swing = dig.array<2>("swing_deg", -180.0, 180.0);
  if (swing[0] < swing[1]) dig.fail("swing_deg", "leftmost first");
  site.dig.swing = {radians(swing[0]), radians(swing[1])};
  site.dig.radius = dig.array<2>("radius", 1.0, 15.0);
  if (site.dig.radius[0] <= site.dig.radius[1]) dig.fail("radius", "the drag goes inwards: the start is farther out than the end");
  site.dig.floor = dig.number("floor", -15.0, -0.1);
  site.dig.bench_height = dig.number("bench_height", 0.3, 10.0);
  read_goals(dig, site.dig);
  dig.finish();
  file.finish();
  return site;
}

}  // namespace berm::config
