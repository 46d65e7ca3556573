#include "config/machine_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/parameter_block.h"
#include "config/strict_table.hpp"

namespace berm::config {

const std::array<const char*, kJoints> kJointNames{"swing", "boom", "stick", "bucket"};

namespace {

// The limits here are those of the kernel's own check of the block, or narrower.
constexpr double kReachMax = 14.99;       // m; the map's half width less a cell
constexpr double kRoundingRoom = 0.003;   // m; each length is rounded to the millimetre
constexpr double kLeastInterval_deg = 0.01;
constexpr double kBrakeShare = 4.0;       // no joint brakes harder than with so many times its largest acceleration
constexpr double kStopRoom = 1e-5;        // share of a stop; its fields are rounded to the microradian and microsecond
constexpr double kLeastCross = 1e-9;      // m2; less is a straight corner in whole millimetres

JointFile read_joint(StrictTable table, double turn_deg) {
  JointFile joint{};
  const auto range = table.interval("range_deg", -turn_deg, turn_deg, kLeastInterval_deg);
  joint.low = radians(range[0]);
  joint.high = radians(range[1]);
  joint.velocity_max = table.degrees("velocity_max_deg_s", 1.0, 180.0);
  joint.acceleration_max = table.number("acceleration_max_rad_s2", 0.01, 20.0);
  joint.creep_velocity = table.degrees("creep_deg_s", 0.1, 15.0);
  if (joint.creep_velocity > joint.velocity_max) table.fail("creep_deg_s", "above velocity_max_deg_s");
  joint.angle_error = table.degrees("angle_error_deg", 0.02, 5.0);
  joint.velocity_error = table.degrees("velocity_error_deg_s", 0.01, 5.0);
  table.finish();
  return joint;
}

// One row for each reach, one column for each speed; neither may fall with growing reach or speed.
std::vector<std::vector<double>> read_matrix(StrictTable& table, const std::string& key, std::size_t rows, double high) {
  const auto flat = table.matrix(key, rows, BERM_BRAKE_SPEEDS, 0.0, high);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t k = 0; k < flat[r].size(); ++k)
      if ((k > 0 && flat[r][k] < flat[r][k - 1]) || (r > 0 && flat[r][k] < flat[r - 1][k]))
        table.fail(key, fmt::format("row {}, column {}: falls with growing {}", r + 1, k + 1, k > 0 && flat[r][k] < flat[r][k - 1] ? "speed" : "reach"));
  return flat;
}

BrakingFile read_braking(StrictTable table) {
  BrakingFile braking;
  braking.provenance = table.text("provenance");
  braking.reach = table.numbers("reach_m", BERM_BRAKE_REACHES, 0.1, 30.0);
  for (std::size_t r = 1; r < braking.reach.size(); ++r)
    if (braking.reach[r] <= braking.reach[r - 1]) table.fail("reach_m", "must rise");
  for (std::size_t j = 0; j < kJoints; ++j) {
    StrictTable joint = table.table(kJointNames[j]);
    braking.angle[j] = read_matrix(joint, "angle_deg", braking.reach.size(), 360.0);
    for (auto& row : braking.angle[j])
      for (double& angle : row) angle = radians(angle);
    braking.time[j] = read_matrix(joint, "time_s", braking.reach.size(), 20.0);
    joint.finish();
  }
  table.finish();
  return braking;
}

PartFile read_part(StrictTable table) {
  PartFile part;
  const std::string link = table.choice("link", {"boom", "stick", "bucket"});
  part.link = link == "boom" ? 1 : link == "stick" ? 2 : 3;
  part.half_width = table.number("half_width", 0.01, 3.0);
  part.outline = table.points("outline", 3, BERM_PART_VERTICES, -15.0, 15.0);
  // The block has whole millimetres; a rounded outline could lie inside what it is to cover, or cease to be convex.
  for (const auto& point : part.outline)
    for (const double x : point)
      if (std::abs(x * 1e3 - std::round(x * 1e3)) > 1e-6) table.fail("outline", fmt::format("{} is not a whole millimetre", x));
  const std::size_t n = part.outline.size();
  for (std::size_t i = 0; i < n; ++i) {  // every other point strictly to the left of each edge
    const auto& a = part.outline[i];
    const auto& b = part.outline[(i + 1) % n];
    for (std::size_t k = 0; k < n; ++k) {
      if (k == i || k == (i + 1) % n) continue;
      const auto& c = part.outline[k];
      if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= kLeastCross)
        table.fail("outline", fmt::format("not convex and counter-clockwise: point {} is not to the left of edge {}", k + 1, i + 1));
    }
  }
  table.finish();
  return part;
}

ScannerFile read_scanner(StrictTable table) {
  ScannerFile scanner{};
  scanner.position = table.array<3>("position", -5.0, 8.0);
  if (scanner.position[0] > 5.0 || scanner.position[1] > 5.0 || scanner.position[2] < 0.0) table.fail("position", "x and y are within -5 .. 5, z within 0 .. 8");
  const auto range = table.interval("pan_range_deg", -180.0, 180.0, kLeastInterval_deg);
  scanner.pan_low = radians(range[0]);
  scanner.pan_high = radians(range[1]);
  scanner.pan_rate_max = table.degrees("pan_rate_max_deg_s", 1.0, 360.0);
  table.finish();
  return scanner;
}

LidarFile read_lidar(StrictTable table) {
  LidarFile lidar{};
  lidar.position = table.array<3>("position", -5.0, 8.0);
  const auto& at = lidar.position;
  if (at[0] > 5.0 || at[1] > 5.0 || at[2] < 0.0) table.fail("position", "x and y are within -5 .. 5, z within 0 .. 8");
  lidar.roll = table.degrees("roll_deg", -180.0, 180.0);
  lidar.pitch = table.degrees("pitch_deg", -180.0, 180.0);
  lidar.yaw = table.degrees("yaw_deg", -180.0, 180.0);
  table.finish();
  return lidar;
}

TailFile read_tail(StrictTable table, double own_body_radius, double kernel_fresh) {
  TailFile tail{};
  tail.watched = table.flag("watched");
  tail.radius = table.number("radius", 0.5, 6.0);
  // Else its own returns would stand in its way.
  if (tail.radius > own_body_radius - kRoundingRoom)
    table.fail("radius", fmt::format("{} is above kinematics.own_body_radius, {}, less {}", tail.radius, own_body_radius, kRoundingRoom));
  tail.half_width = table.number("half_width", 0.1, 6.0);
  if (tail.half_width > tail.radius) table.fail("half_width", "above radius");
  tail.underside = table.number("underside", 0.0, 9.9);
  tail.top = table.number("top", 0.1, 10.0);
  if (tail.top < tail.underside + kRoundingRoom) table.fail("top", "not above underside");
  tail.clearance = table.number("clearance", 0.5, 3.0);
  tail.fresh = table.number("fresh", 0.1, 120.0);
  if (tail.fresh > kernel_fresh) table.fail("fresh", "above kernel.fresh");
  table.finish();
  return tail;
}

WorkspaceFile read_workspace(StrictTable table, double own_body_radius) {
  WorkspaceFile w{};
  w.watched = table.flag("watched");
  w.radius = table.number("radius", 1.0, 15.0);
  if (w.radius < own_body_radius + kRoundingRoom) table.fail("radius", fmt::format("{} is not above kinematics.own_body_radius, {}", w.radius, own_body_radius));
  w.rise = table.number("rise", 0.1, 2.0);
  w.neighbour = table.number("neighbour", 0.1, 2.0);
  w.slope = table.number("slope", 0.1, 5.0);
  w.wait = table.number("wait", 0.0, 10.0);
  w.period = table.number("period", 0.01, 1.0);
  w.dwell = table.number("dwell", 0.0, 60.0);
  w.learn = table.number("learn", 0.0, 120.0);
  w.learn_speed = table.number("learn_speed", 0.05, 1.0);
  w.foreign = static_cast<int>(table.integer("foreign", 0, 100));
  w.lidar_wait = table.number("lidar_wait", 0.0, 10.0);
  w.lidar_period = table.number("lidar_period", 0.01, 1.0);
  w.follows = table.flag("follows");
  w.histogram = table.flag("histogram");
  const std::string separation = table.choice("separation", {"none", "reported", "enforced"});
  w.separation = separation == "none" ? BERM_SEPARATION_NONE : separation == "reported" ? BERM_SEPARATION_REPORTED : BERM_SEPARATION_ENFORCED;
  w.approach_speed = table.number("approach_speed", 0.5, 5.0);
  w.intrusion_distance = table.number("intrusion_distance", 0.0, 3.0);
  table.finish();
  return w;
}

SightFile read_sight(StrictTable table) {
  SightFile s{};
  s.blind = table.number("blind", 0.05, 1.0);
  s.dust_slow = table.number("dust_slow", 0.001, 1.0);
  s.dust_stop = table.number("dust_stop", 0.001, 1.0);
  if (s.dust_stop < s.dust_slow) table.fail("dust_stop", "below dust_slow");
  s.dust_speed = table.number("dust_speed", 0.05, 1.0);
  s.dust_dwell = table.number("dust_dwell", 0.0, 60.0);
  table.finish();
  return s;
}

KernelFile read_kernel(StrictTable table) {
  KernelFile k{};
  k.cycle = table.number("cycle", 0.001, 0.02);
  k.margin = table.number("margin", 0.1, 2.0);
  k.fresh = table.number("fresh", 0.1, 120.0);
  k.generation = table.number("generation", 0.05, 60.0);
  if (k.generation > k.fresh) table.fail("generation", "above fresh");
  k.dig_swing_limit = table.degrees("dig_swing_limit_deg_s", 0.1, 15.0);
  k.scanner_silent = table.number("scanner_silent", 0.02, 2.0);
  k.spurious_range = table.number("spurious_range", 0.1, 20.0);
  k.range_min = table.number("range_min", 0.1, 5.0);
  k.range_max = table.number("range_max", 10.0, 200.0);
  k.self_margin = table.number("self_margin", 0.0, 1.0);
  k.request_age = table.number("request_age", 0.01, 0.5);
  k.request_hold = table.number("request_hold", 0.01, 0.05);      // the contract's 50 ms
  k.request_silent = table.number("request_silent", 0.05, 0.5);   // the contract's 500 ms
  k.state_frame_age = table.number("state_frame_age", 0.01, 0.2);
  k.machine_state_age = table.number("machine_state_age", 0.05, 1.0);
  k.operator_age = table.number("operator_age", 0.05, 1.0);
  k.standstill_speed = table.degrees("standstill_deg_s", 0.05, 2.0);
  k.standstill = table.number("standstill", 0.05, 2.0);
  k.base_tilt = table.degrees("base_tilt_deg", 0.1, 2.0);
  k.base_tilt_hard = table.degrees("base_tilt_hard_deg", 0.1, 5.0);
  if (k.base_tilt_hard < k.base_tilt) table.fail("base_tilt_hard_deg", "below base_tilt_deg");
  k.base_azimuth = table.degrees("base_azimuth_deg", 0.1, 2.0);
  k.base_frame_age = table.number("base_frame_age", 0.1, 1.0);
  table.finish();
  return k;
}

// No stop shorter than any machine's from its column's speed: a table of noughts would leave the reach box without a way to brake.
void check_stops(const StrictTable& file, const MachineFile& m) {
  constexpr double kDegree = radians(1.0);
  for (std::size_t j = 0; j < kJoints; ++j) {
    const double slowing = kBrakeShare * m.joint[j].acceleration_max;
    const auto refuse_below = [&](const char* key, std::size_t row, std::size_t column, double value, double least) {
      if (value >= least * (1.0 + kStopRoom)) return;
      file.fail(fmt::format("braking.{}.{}", kJointNames[j], key),
                fmt::format("row {}, column {}: {:.4g} is below {:.4g}, a stop at {} times acceleration_max_rad_s2", row + 1, column + 1, value, least, kBrakeShare));
    };
    for (std::size_t r = 0; r < BERM_BRAKE_REACHES; ++r)
      for (std::size_t k = 1; k < BERM_BRAKE_SPEEDS; ++k) {
        const double speed = m.joint[j].velocity_max * static_cast<double>(k) / (BERM_BRAKE_SPEEDS - 1);
        refuse_below("angle_deg", r, k, m.braking.angle[j][r][k] / kDegree, speed * speed / (2.0 * slowing) / kDegree);
        refuse_below("time_s", r, k, m.braking.time[j][r][k], speed / slowing);
      }
  }
}

void check_every_link(const StrictTable& file, const std::vector<PartFile>& parts) {
  for (std::size_t link = 1; link < kJoints; ++link)
    if (std::none_of(parts.begin(), parts.end(), [link](const PartFile& part) { return part.link == static_cast<int>(link); }))
      file.fail("part", fmt::format("none covers the {}", kJointNames[link]));
}

}  // namespace

MachineFile load_machine_file(const std::string& path) {
  StrictTable file = StrictTable::parse_file(path);
  MachineFile m;
  file.integer("schema", 1, 1);
  m.name = file.text("name");
  StrictTable kinematics = file.table("kinematics");
  m.boom_pin_x = kinematics.number("boom_pin_x", -3.0, 3.0);
  m.boom_pin_z = kinematics.number("boom_pin_z", 0.0, 5.0);
  m.boom = kinematics.number("boom", 1.0, 12.0);
  m.stick = kinematics.number("stick", 0.5, 8.0);
  m.bucket = kinematics.number("bucket", 0.3, 4.0);
  m.own_body_radius = kinematics.number("own_body_radius", 0.5, 6.0);
  const double reach = m.boom_pin_x + m.boom + m.stick + m.bucket;
  if (reach > kReachMax) kinematics.fail("bucket", fmt::format("boom_pin_x, boom, stick and bucket together are {}, above {}", reach, kReachMax));
  kinematics.finish();
  StrictTable joints = file.table("joint");
  for (std::size_t j = 0; j < kJoints; ++j) m.joint[j] = read_joint(joints.table(kJointNames[j]), j == 0 ? 360.0 : 180.0);
  joints.finish();
  StrictTable cylinders = file.table("cylinder");
  for (std::size_t c = 0; c < m.cylinder.size(); ++c) {
    const auto sides = cylinders.array<2>(fmt::format("{}_nm_per_kpa", kJointNames[c + 1]), 0.01, 1000.0);
    m.cylinder[c] = {sides[0], sides[1]};
  }
  cylinders.finish();
  StrictTable held = file.table("bucket");
  m.bucket_payload = held.number("payload_kg", 50.0, 50000.0);
  held.finish();
  StrictTable latency = file.table("latency");
  m.state_latency = latency.number("state", 0.001, 0.5);
  m.command_latency = latency.number("command", 0.001, 1.0);
  latency.finish();
  m.braking = read_braking(file.table("braking"));
  if (m.braking.reach.back() < reach + kRoundingRoom)
    file.fail("braking.reach_m", fmt::format("the last row ends at {}, the implements reach {}", m.braking.reach.back(), reach));
  check_stops(file, m);
  if (file.has("response")) m.response = read_response(file.table("response"), kJointNames);
  for (auto& part : file.tables("part")) m.part.push_back(read_part(std::move(part)));
  if (m.part.empty() || m.part.size() > BERM_PARTS) file.fail("part", fmt::format("{} parts, 1 to {} are taken", m.part.size(), BERM_PARTS));
  check_every_link(file, m.part);
  auto scanners = file.tables("scanner");
  if (scanners.size() != m.scanner.size()) file.fail("scanner", "exactly two, left and right");
  for (std::size_t i = 0; i < scanners.size(); ++i) m.scanner[i] = read_scanner(std::move(scanners[i]));
  m.kernel = read_kernel(file.table("kernel"));
  for (auto& lidar : file.tables("lidar")) m.lidar.push_back(read_lidar(std::move(lidar)));
  if (m.lidar.size() > BERM_LIDARS) file.fail("lidar", fmt::format("{} lidars, up to {} are taken", m.lidar.size(), BERM_LIDARS));
  m.tail = read_tail(file.table("tail"), m.own_body_radius, m.kernel.fresh);
  m.workspace = read_workspace(file.table("workspace"), m.own_body_radius);
  m.sight = read_sight(file.table("sight"));
  if (m.kernel.cycle > m.state_latency) file.fail("kernel.cycle", fmt::format("{} is above latency.state, {}", m.kernel.cycle, m.state_latency));
  if (m.kernel.cycle > m.command_latency) file.fail("kernel.cycle", fmt::format("{} is above latency.command, {}", m.kernel.cycle, m.command_latency));
  if (m.kernel.dig_swing_limit > m.joint[0].velocity_max) file.fail("kernel.dig_swing_limit_deg_s", "above joint.swing.velocity_max_deg_s");
  file.finish();
  return m;
}

}  // namespace berm::config
