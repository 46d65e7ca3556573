#include "plant/process/scenario_world.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <set>

#include "plant/machine/implement_shape.hpp"
#include "plant/process/measured_ground.hpp"

namespace berm::plant {

namespace {

constexpr double kSite = 100.0;    // m; no coordinate lies farther out, ...
constexpr double kGround = 215.0;  // ... but a bench that the machine moves back along for 200 m
constexpr std::size_t kMostMovers = 16;

// The file has angles, the ground rises over runs.
double rise_over_run(StrictTable& t, const char* key, double low_deg, double high_deg) { return std::tan(t.degrees(key, low_deg, high_deg)); }

TerrainConfig read_terrain(StrictTable t) {
  TerrainConfig terrain;
  const auto x = t.array<2>("x", -kGround, kSite), y = t.array<2>("y", -kSite, kSite);
  if (x[0] >= x[1]) t.fail("x", "low must be below high");
  if (y[0] >= y[1]) t.fail("y", "low must be below high");
  terrain.x_low = x[0], terrain.x_high = x[1], terrain.y_low = y[0], terrain.y_high = y[1];
  terrain.cell = t.number("cell", 0.02, 1.0);
  if ((x[1] - x[0]) * (y[1] - y[0]) / (terrain.cell * terrain.cell) > 4e6) t.fail("cell", "gives more than four million cells");
  terrain.roughness = t.number("roughness", 0.0, 0.2);
  if (t.has("measured")) {  // it is the whole ground: a bench or a mound beside it is an unknown key
    terrain.measured = read_measured_ground(t.table("measured"), terrain);
    t.finish();
    return terrain;
  }
  terrain.crest_x = t.number("crest_x", 2.5, kSite);
  terrain.toe_x = t.number("toe_x", 2.5, kSite);
  terrain.crest_y = t.number("crest_y", 1.5, kSite);
  terrain.toe_y = t.number("toe_y", 1.5, kSite);
  if (terrain.toe_x <= terrain.crest_x) t.fail("toe_x", "must be beyond crest_x");
  if (terrain.toe_y <= terrain.crest_y) t.fail("toe_y", "must be beyond crest_y");
  terrain.lower_z = t.number("lower_z", -10.0, 0.0);
  for (StrictTable& m : t.tables("mound")) {
    MoundConfig mound;
    mound.from = m.array<2>("from", -kSite, kSite);
    mound.to = m.array<2>("to", -kSite, kSite);
    mound.top = m.number("top", -10.0, 10.0);
    mound.slope = rise_over_run(m, "slope_deg", 5.0, 70.0);
    m.finish();
    terrain.mounds.push_back(mound);
  }
  t.finish();
  return terrain;
}

SoilConfig read_soil(StrictTable t) {
  SoilConfig soil;
  soil.density_bank = t.number("density_bank_kg_m3", 500.0, 4000.0);
  soil.swell = t.number("swell", 1.0, 2.0);
  soil.repose = rise_over_run(t, "repose_deg", 10.0, 60.0);
  soil.bank_slope = rise_over_run(t, "bank_slope_deg", 20.0, 89.0);
  soil.resistance = t.number("resistance", 0.0, 1.0);
  soil.stick_fraction = t.number("stick_fraction", 0.0, 0.9);
  t.finish();
  return soil;
}

SoilChange read_soil_change(StrictTable t) {
  SoilChange change;
  change.at_s = t.number("at_s", 0.0, 36000.0);
  change.repose = rise_over_run(t, "repose_deg", 10.0, 60.0);
  change.bank_slope = rise_over_run(t, "bank_slope_deg", 20.0, 89.0);
  change.resistance = t.number("resistance", 0.0, 1.0);
  change.stick_fraction = t.number("stick_fraction", 0.0, 0.9);
  t.finish();
  return change;
}

TruckConfig read_truck(StrictTable t) {
  TruckConfig truck;
  const auto centre = t.array<2>("centre", -kSite, kSite);
  truck.x = centre[0], truck.y = centre[1];
  truck.yaw = t.degrees("yaw_deg", -360.0, 360.0);
  truck.length = t.number("length", 1.0, 20.0);
  truck.width = t.number("width", 1.0, 10.0);
  truck.height = t.number("height", 0.2, 5.0);
  truck.wall_top = t.number("wall_top", -8.0, 8.0);
  truck.wall_thickness = t.number("wall_thickness", 0.01, 0.5);
  truck.cab_length = t.number("cab_length", 0.2, 10.0);
  truck.cab_gap = t.number("cab_gap", 0.0, 5.0);
  truck.cab_top = t.number("cab_top", -8.0, 8.0);
  truck.target_kg = t.number("target_kg", 100.0, 500000.0);
  truck.wait_s = t.number("wait_s", 0.0, 36000.0);
  truck.approach_m = t.number("approach_m", 0.0, kSite);
  truck.speed = t.number("speed", 0.1, 20.0);
  truck.place_stddev = t.number("place_stddev", 0.0, 1.0);
  truck.yaw_stddev = t.degrees("yaw_stddev_deg", 0.0, 10.0);
  t.finish();
  return truck;
}

std::string read_name(StrictTable& t, std::set<std::string>& names) {
  std::string name = t.text("name");
  for (const char c : name) {
    if (std::islower(static_cast<unsigned char>(c)) == 0 && std::isdigit(static_cast<unsigned char>(c)) == 0 && c != '_')
      t.fail("name", "may hold a-z, 0-9 and _ only: it becomes a column's name");
  }
  if (name.rfind("truck", 0) == 0 || !names.insert(name).second) t.fail("name", fmt::format("'{}' is taken", name));
  return name;
}

MoverConfig read_mover(StrictTable t, bool vehicle, std::set<std::string>& names) {
  MoverConfig mover;
  mover.name = read_name(t, names);
  mover.vehicle = vehicle;
  mover.height = t.number("height", 0.2, 10.0);
  if (vehicle) {
    mover.length = t.number("length", 0.2, 30.0);
    mover.width = t.number("width", 0.2, 10.0);
  } else {
    mover.radius = t.number("radius", 0.05, 1.0);
  }
  mover.speed = t.number("speed", 0.05, 20.0);
  mover.start_s = t.number("start_s", 0.0, 36000.0);
  if (t.has("start_swing_above_deg")) mover.start_swing_above = t.degrees("start_swing_above_deg", -180.0, 180.0);
  mover.beside_machine = t.has("beside_machine") && t.flag("beside_machine");
  for (StrictTable& w : t.tables("waypoint")) {
    const auto at = w.array<2>("at", -kSite, kSite);
    mover.waypoints.push_back({at[0], at[1], w.number("wait_s", 0.0, 36000.0)});
    w.finish();
  }
  if (mover.waypoints.empty()) t.fail("waypoint", "is missing");
  t.finish();
  return mover;
}

BoxConfig read_box(StrictTable t, std::set<std::string>& names) {
  BoxConfig box;
  box.name = read_name(t, names);
  const auto centre = t.array<2>("centre", -kSite, kSite);
  const auto z = t.array<2>("z", -10.0, 20.0);
  if (z[0] >= z[1]) t.fail("z", "low must be below high");
  box.x = centre[0], box.y = centre[1], box.z_low = z[0], box.z_high = z[1];
  box.length = t.number("length", 0.02, 50.0);
  box.width = t.number("width", 0.02, 50.0);
  box.yaw = t.degrees("yaw_deg", -360.0, 360.0);
  t.finish();
  return box;
}

DigZoneConfig read_dig_zone(StrictTable t) {
  DigZoneConfig zone;
  const auto x = t.array<2>("x", -kSite, kSite), y = t.array<2>("y", -kSite, kSite);
  if (x[0] >= x[1]) t.fail("x", "low must be below high");
  if (y[0] >= y[1]) t.fail("y", "low must be below high");
  zone.x_low = x[0], zone.x_high = x[1], zone.y_low = y[0], zone.y_high = y[1];
  zone.floor = t.number("floor", -10.0, 0.0);
  t.finish();
  return zone;
}

ScannerConfig read_scanner(StrictTable t) {
  ScannerConfig scanner;
  scanner.sample_rate_hz = t.number("sample_rate_hz", 100.0, 50000.0);
  scanner.samples_per_revolution = static_cast<int>(t.integer("samples_per_revolution", 36, 3600));
  const auto range = t.array<2>("range", 0.0, 250.0);
  if (range[0] >= range[1]) t.fail("range", "low must be below high");
  scanner.range_min = range[0], scanner.range_max = range[1];
  scanner.range_stddev = t.number("range_stddev", 0.0, 0.5);
  scanner.outlier_probability = t.number("outlier_probability", 0.0, 1.0);
  scanner.dropout_probability = t.number("dropout_probability", 0.0, 1.0);
  scanner.dust_probability = t.number("dust_probability", 0.0, 1.0);
  scanner.window_percent = t.number("window_percent", 0.0, 100.0);
  scanner.waveform_share = t.number_or("waveform_share", 0.0, 1.0, scanner.waveform_share);
  for (const char* key : {"ranging", "reflectivity"})
    if (t.has(key) && scanner.waveform_share == 0.0) t.fail(key, "is for samples with a waveform: needs a waveform_share above 0");
  if (t.has("ranging")) scanner.ranging = t.choice("ranging", {"last_pulse", "trailing_edge"}) == "last_pulse" ? Ranging::last_pulse : Ranging::trailing_edge;
  scanner.reflectivity = t.number_or("reflectivity", 0.01, 1.0, scanner.reflectivity);
  t.finish();
  return scanner;
}

SensorFault read_sensor_fault(StrictTable t, const char* sensor, int sensors, const char* turn, const std::vector<std::string>& kinds) {
  SensorFault fault;
  fault.sensor = static_cast<std::size_t>(t.integer(sensor, 1, sensors) - 1);
  const std::string kind = t.choice("kind", kinds);
  fault.silent = kind == "silent";
  fault.stalled = kind == "stalled";
  fault.at_s = t.number("at_s", 0.0, 36000.0);
  fault.for_s = t.number("for_s", 0.05, 36000.0);
  if (t.has(turn)) {
    const auto degrees = t.array<2>(turn, 0.0, 360.0);
    if (degrees[0] >= degrees[1]) t.fail(turn, "low must be below high");
    if (kind != "blocked") t.fail(turn, "is for a window that is blocked in part");
    fault.turn = {radians(degrees[0]), radians(degrees[1])};
  }
  t.finish();
  return fault;
}

DustConfig read_dust(StrictTable t) {
  DustConfig dust;
  dust.at_s = t.number("at_s", 0.0, 36000.0);
  dust.for_s = t.number("for_s", 0.05, 36000.0);
  dust.probability = t.number("probability", 0.0, 1.0);
  dust.lost = t.number("lost", 0.0, 1.0);
  if (dust.probability + dust.lost > 1.0) t.fail("lost", "above 1 together with probability");
  t.finish();
  return dust;
}

CloudConfig read_cloud(StrictTable t) {
  CloudConfig cloud;
  const auto centre = t.array<2>("centre", -kSite, kSite);
  const auto z = t.interval("z", -10.0, 50.0, 0.01);
  cloud.x = centre[0], cloud.y = centre[1], cloud.z_low = z[0], cloud.z_high = z[1];
  cloud.length = t.number("length", 0.1, 2 * kSite);
  cloud.width = t.number("width", 0.1, 2 * kSite);
  cloud.yaw = t.degrees("yaw_deg", -360.0, 360.0);
  cloud.extinction = t.number("extinction", 0.001, 20.0);
  cloud.at_s = t.number("at_s", 0.0, 36000.0);
  cloud.for_s = t.number("for_s", 0.05, 36000.0);
  t.finish();
  return cloud;
}

}  // namespace

SoilConfig load_soil(const std::string& path) {
  StrictTable file = StrictTable::parse_file(path);
  file.integer("schema", 1, 1);
  file.text("name");
  const SoilConfig soil = read_soil(file.table("soil"));
  file.finish();
  return soil;
}

WorldConfig read_world(StrictTable& file) {
  WorldConfig world;
  world.terrain = read_terrain(file.table("terrain"));
  world.soil = read_soil(file.table("soil"));
  for (StrictTable& t : file.tables("soil_change")) {
    const SoilChange change = read_soil_change(t);
    if (!world.soil_changes.empty() && change.at_s <= world.soil_changes.back().at_s) file.fail("soil_change", "at_s must rise from one to the next");
    world.soil_changes.push_back(change);
  }
  for (StrictTable& t : file.tables("truck")) world.trucks.push_back(read_truck(t));
  if (world.trucks.empty()) file.fail("truck", "is missing");
  std::set<std::string> names;
  for (StrictTable& t : file.tables("person")) world.movers.push_back(read_mover(t, false, names));
  for (StrictTable& t : file.tables("vehicle")) world.movers.push_back(read_mover(t, true, names));
  if (world.movers.size() > kMostMovers) file.fail("person", fmt::format("at most {} people and vehicles", kMostMovers));
  for (StrictTable& t : file.tables("box")) world.boxes.push_back(read_box(t, names));
  world.dig_zones.clear();
  for (StrictTable& t : file.tables("dig_zone")) world.dig_zones.push_back(read_dig_zone(t));
  if (world.dig_zones.empty()) file.fail("dig_zone", "is missing");
  world.scanner = read_scanner(file.table("scanner"));
  for (StrictTable& t : file.tables("scanner_fault")) world.scanner_faults.push_back(read_sensor_fault(t, "scanner", 2, "mirror_deg", {"blocked", "silent"}));
  for (StrictTable& t : file.tables("lidar_fault")) world.lidar_faults.push_back(read_sensor_fault(t, "lidar", lidars_most, "sector_deg", {"blocked", "silent", "stalled"}));
  for (StrictTable& t : file.tables("dust")) world.dust.push_back(read_dust(t));
  for (StrictTable& t : file.tables("cloud")) {
    if (world.scanner.waveform_share == 0.0) file.fail("cloud", "is seen by samples with a waveform alone: needs a scanner.waveform_share above 0");
    world.clouds.push_back(read_cloud(t));
  }
  return world;
}

}  // namespace berm::plant
