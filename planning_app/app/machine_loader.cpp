#include "app/machine_loader.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

static_assert(config::kJoints == joints);

MachineModel machine_model(const config::MachineFile& file) {
  MachineModel m;
  m.boom_pin_x = file.boom_pin_x;
  m.boom_pin_z = file.boom_pin_z;
  m.boom_length = file.boom;
  m.stick_length = file.stick;
  m.bucket_length = file.bucket;
  m.own_body_radius = file.own_body_radius;
  for (std::size_t j = 0; j < joints; ++j) {
    const config::JointFile& from = file.joint[j];
    m.joint[j] = {from.low, from.high, from.velocity_max, from.acceleration_max, from.creep_velocity, from.angle_error, from.velocity_error};
  }
  m.state_latency = file.state_latency;
  m.command_latency = file.command_latency;
  m.cycle = file.kernel.cycle;
  m.braking.reach = file.braking.reach;
  m.braking.angle = file.braking.angle;
  for (const config::PartFile& part : file.part) m.parts.push_back({static_cast<std::size_t>(part.link), part.half_width, part.outline});
  for (std::size_t i = 0; i < m.scanner.size(); ++i) {
    const config::ScannerFile& from = file.scanner[i];
    m.scanner[i] = {from.position[0], from.position[1], from.position[2], from.pan_low, from.pan_high, from.pan_rate_max};
  }
  m.margin = file.kernel.margin;
  m.fresh = file.kernel.fresh;
  m.dig_swing_limit = file.kernel.dig_swing_limit;
  return m;
}

namespace {

// How far from the bed's centre, to this side along it, the truck zones hold its centre line: to the centimetre, no farther than a truck is long.
double zone_reach(const config::SiteFile& file, double side) {
  constexpr double step = 0.01, longest = 15.0;
  const config::TruckPlaceFile& t = file.truck;
  const auto held = [&](double u) {
    const double x = t.centre[0] + u * std::cos(t.yaw), y = t.centre[1] + u * std::sin(t.yaw);
    return std::any_of(file.truck_zone.begin(), file.truck_zone.end(),
                       [&](const config::TruckZoneFile& z) { return x >= z.x_low && x <= z.x_high && y >= z.y_low && y <= z.y_high; });
  };
  double reach = 0.0;
  while (reach < longest && held(side * (reach + step))) reach += step;
  return reach;
}

}  // namespace

SiteModel site_model(const config::SiteFile& file) {
  SiteModel s;
  for (const config::DigZoneFile& z : file.dig_zone) s.dig_zones.push_back({z.x_low, z.y_low, z.x_high, z.y_high, z.floor, z.ceiling});
  const config::TruckPlaceFile& t = file.truck;
  s.truck = {t.centre[0], t.centre[1], t.yaw, t.length, t.width, t.height, t.wall_top, t.target_kg};
  if (!file.truck_zone.empty()) {
    s.truck.zone_low = -zone_reach(file, -1.0);
    s.truck.zone_high = zone_reach(file, 1.0);
  }
  s.dig_swing_left = std::max(file.dig.swing[0], file.dig.swing[1]);
  s.dig_swing_right = std::min(file.dig.swing[0], file.dig.swing[1]);
  s.dig_radius_start = std::max(file.dig.radius[0], file.dig.radius[1]);
  s.dig_radius_end = std::min(file.dig.radius[0], file.dig.radius[1]);
  return s;
}

}  // namespace berm::app
