#include "plant/machine/plant_profile.hpp"

#include <fmt/format.h>

#include "plant/machine/strict_table.hpp"

namespace berm::plant {

namespace {

constexpr std::array<const char*, 4> kJointName{"swing", "boom", "stick", "bucket"};

JointConfig read_joint(StrictTable t, bool swing) {
  JointConfig joint;
  const auto range = t.array<2>("range_deg", -360.0, 360.0);
  if (range[0] >= range[1]) t.fail("range_deg", "low must be below high");
  joint.low = radians(range[0]);
  joint.high = radians(range[1]);
  joint.velocity_max = t.degrees("velocity_max_deg_s", 1.0, 200.0);
  joint.acceleration = t.number("acceleration_rad_s2", 0.01, 20.0);
  if (!swing) joint.brake = t.number("brake_rad_s2", 0.01, 50.0);
  joint.dead_time = t.number("dead_time_s", 0.0, 1.0);
  joint.lag = t.number("lag_s", 0.005, 1.0);
  joint.dead_band = t.degrees("dead_band_deg_s", 0.0, 5.0);
  joint.reversal = t.number("reversal_s", 0.0, 1.0);
  joint.ripple = t.number("ripple", 0.0, 0.2);
  t.finish();
  return joint;
}

bool convex(const std::vector<OutlinePoint>& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const OutlinePoint &a = outline[i], &b = outline[(i + 1) % n], &c = outline[(i + 2) % n];
    if ((b.x - a.x) * (c.z - b.z) - (b.z - a.z) * (c.x - b.x) <= 0.0) return false;
  }
  return true;
}

SolidPart read_part(StrictTable t) {
  SolidPart part;
  const std::string link = t.choice("link", {"boom", "stick", "bucket"});
  part.link = link == "boom" ? 1 : link == "stick" ? 2 : 3;
  part.half_width = t.number("half_width", 0.01, 3.0);
  for (const auto& p : t.points("outline", 3, 16, -10.0, 10.0)) part.outline.push_back({p[0], p[1]});
  if (!convex(part.outline)) t.fail("outline", "must be strictly convex and counter-clockwise (x towards z)");
  t.finish();
  return part;
}

AxisBox read_box(StrictTable t) {
  AxisBox box;
  box.low = t.array<3>("low", -10.0, 10.0);
  box.high = t.array<3>("high", -10.0, 10.0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.low[i] >= box.high[i]) t.fail("low", "must be below high in each coordinate");
  }
  t.finish();
  return box;
}

ScannerMount read_scanner(StrictTable t) {
  ScannerMount mount;
  mount.position = t.array<3>("position", -10.0, 10.0);
  const auto range = t.array<2>("pan_range_deg", -180.0, 180.0);
  if (range[0] >= range[1]) t.fail("pan_range_deg", "low must be below high");
  mount.pan_low = radians(range[0]);
  mount.pan_high = radians(range[1]);
  mount.pan_rate_max = t.degrees("pan_rate_max_deg_s", 1.0, 1000.0);
  mount.pan_acceleration = t.number("pan_acceleration_rad_s2", 0.1, 1000.0);
  t.finish();
  return mount;
}

LidarMount read_lidar(StrictTable t) {
  LidarMount mount;
  mount.position = t.array<3>("position", -10.0, 10.0);
  mount.roll = t.degrees("roll_deg", -180.0, 180.0);
  mount.pitch = t.degrees("pitch_deg", -180.0, 180.0);
  mount.yaw = t.degrees("yaw_deg", -180.0, 180.0);
  mount.sector_deg = t.number("sector_deg", 1.0, 180.0);
  mount.dual = t.choice("returns", {"strongest", "dual"}) == "dual";
  mount.outliers = t.flag("outliers");
  t.finish();
  return mount;
}

ImplementShape read_shape(StrictTable& file) {
  ImplementShape shape;
  StrictTable k = file.table("kinematics");
  shape.boom_pin_x = k.number("boom_pin_x", -5.0, 5.0);
  shape.boom_pin_z = k.number("boom_pin_z", 0.0, 10.0);
  shape.boom = k.number("boom", 0.1, 20.0);
  shape.stick = k.number("stick", 0.1, 20.0);
  shape.bucket = k.number("bucket", 0.1, 10.0);
  k.finish();
  StrictTable b = file.table("bucket");
  shape.bucket_half_width = b.number("half_width", 0.1, 3.0);
  shape.bucket_heaped_m3 = b.number("heaped_m3", 0.05, 20.0);
  shape.bucket_payload_max_kg = b.number("payload_max_kg", 10.0, 50000.0);
  b.finish();
  for (StrictTable& t : file.tables("part")) shape.parts.push_back(read_part(t));
  for (int link = 1; link <= 3; ++link) {
    bool present = false;
    for (const SolidPart& part : shape.parts) present = present || part.link == link;
    if (!present) file.fail("part", "boom, stick and bucket each need at least one");
  }
  for (StrictTable& t : file.tables("upper_body")) shape.upper_body.push_back(read_box(t));
  for (StrictTable& t : file.tables("track")) shape.tracks.push_back(read_box(t));
  std::vector<StrictTable> scanners = file.tables("scanner");
  if (scanners.size() != shape.scanner.size()) file.fail("scanner", fmt::format("must be given {} times", shape.scanner.size()));
  for (std::size_t i = 0; i < scanners.size(); ++i) shape.scanner[i] = read_scanner(scanners[i]);
  for (StrictTable& t : file.tables("lidar")) shape.lidar.push_back(read_lidar(t));
  if (shape.lidar.size() > lidars_most) file.fail("lidar", fmt::format("is given more than {} times", lidars_most));
  return shape;
}

DynamicsConfig read_dynamics(StrictTable& file) {
  DynamicsConfig d;
  StrictTable joints = file.table("joint");
  for (std::size_t j = 0; j < 4; ++j) d.joint[j] = read_joint(joints.table(kJointName[j]), j == 0);
  joints.finish();
  StrictTable t = file.table("dynamics");
  d.inertia.upper = t.number("upper_inertia_kg_m2", 100.0, 1e7);
  d.inertia.boom_mass = t.number("boom_mass_kg", 1.0, 1e5);
  d.inertia.boom_radius = t.number("boom_radius", 0.0, 20.0);
  d.inertia.stick_mass = t.number("stick_mass_kg", 1.0, 1e5);
  d.inertia.bucket_mass = t.number("bucket_mass_kg", 1.0, 1e5);
  const auto stick = t.array<2>("stick_centre", -10.0, 10.0);
  const auto bucket = t.array<2>("bucket_centre", -10.0, 10.0);
  d.inertia.stick_centre = {stick[0], stick[1]};
  d.inertia.bucket_centre = {bucket[0], bucket[1]};
  d.swing_drive_torque = t.number("swing_drive_torque_nm", 100.0, 1e7);
  d.swing_brake_torque = t.number("swing_brake_torque_nm", 100.0, 1e7);
  d.boom_lower_brake_loaded = t.number("boom_lower_brake_loaded_rad_s2", 0.01, 50.0);
  d.payload_reference = t.number("payload_reference_kg", 1.0, 50000.0);
  d.flow_limit = t.number("flow_limit", 0.5, 4.0);
  t.finish();
  StrictTable cylinders = file.table("cylinder");
  for (std::size_t c = 0; c < d.cylinder.size(); ++c) {
    const auto sides = cylinders.array<2>(fmt::format("{}_nm_per_kpa", kJointName[c + 1]), 0.01, 1000.0);
    d.cylinder[c] = {sides[0], sides[1]};
  }
  cylinders.finish();
  return d;
}

}  // namespace

PlantProfile load_plant_profile(const std::string& path) {
  StrictTable file = StrictTable::parse_file(path);
  PlantProfile profile;
  file.integer("schema", 1, 1);
  profile.name = file.text("name");
  profile.shape = read_shape(file);
  profile.dynamics = read_dynamics(file);
  StrictTable c = file.table("controller");
  profile.controller.heartbeat_silence = c.number("heartbeat_silence_s", 0.01, 10.0);
  profile.controller.command_silence = c.number("command_silence_s", 0.01, 10.0);
  profile.controller.pan_silence = c.number("pan_silence_s", 0.01, 10.0);
  c.finish();
  StrictTable s = file.table("sensors");
  profile.sensors.angle = s.degrees("angle_deg", 0.0, 5.0);
  profile.sensors.velocity = s.degrees("velocity_deg_s", 0.0, 5.0);
  profile.sensors.payload_relative = s.number("payload_relative", 0.0, 0.5);
  profile.sensors.payload_offset = s.number("payload_offset_kg", 0.0, 500.0);
  profile.sensors.roll_pitch = s.degrees("roll_pitch_deg", 0.0, 5.0);
  s.finish();
  file.finish();
  return profile;
}

}  // namespace berm::plant
