#include "config/compile_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace berm::config {

namespace {

constexpr double kMicro = 1e6, kMilli = 1e3;  // of shares: per mille
constexpr double kSlack = 1e-6;  // a decimal that is meant to be whole stays whole

// Which way each field is rounded, and why that is the safe way: CONFIG.md, IF-CF-9 to IF-CF-13.

std::int32_t up(double value, double scale) { return static_cast<std::int32_t>(std::ceil(value * scale - kSlack)); }
std::int32_t down(double value, double scale) { return static_cast<std::int32_t>(std::floor(value * scale + kSlack)); }
std::int32_t near(double value, double scale) { return static_cast<std::int32_t>(std::lround(value * scale)); }

void compile_joints(const MachineFile& m, berm_parameters& p) {
  for (std::size_t j = 0; j < kJoints; ++j) {
    const auto& joint = m.joint[j];
    p.joint_low_urad[j] = up(joint.low, kMicro);                            // inwards
    p.joint_high_urad[j] = down(joint.high, kMicro);
    p.velocity_max_urad_s[j] = down(joint.velocity_max, kMicro);            // commands are clamped to it
    p.acceleration_max_urad_s2[j] = up(joint.acceleration_max, kMicro);
    p.creep_velocity_urad_s[j] = down(joint.creep_velocity, kMicro);
    p.angle_error_urad[j] = up(joint.angle_error, kMicro);
    p.velocity_error_urad_s[j] = up(joint.velocity_error, kMicro);
    for (std::size_t r = 0; r < BERM_BRAKE_REACHES; ++r) {
      for (std::size_t k = 0; k < BERM_BRAKE_SPEEDS; ++k) {
        p.brake_angle_urad[j][r][k] = up(m.braking.angle[j][r][k], kMicro);
        p.brake_time_us[j][r][k] = up(m.braking.time[j][r][k], kMicro);
      }
    }
  }
  for (std::size_t r = 0; r < BERM_BRAKE_REACHES; ++r) p.brake_reach_mm[r] = down(m.braking.reach[r], kMilli);
}

void compile_parts(const MachineFile& m, berm_parameters& p) {
  p.parts = static_cast<std::int32_t>(m.part.size());
  for (std::size_t i = 0; i < m.part.size(); ++i) {
    const auto& part = m.part[i];
    p.part[i].link = part.link;
    p.part[i].half_width_mm = up(part.half_width, kMilli);
    p.part[i].vertices = static_cast<std::int32_t>(part.outline.size());
    for (std::size_t v = 0; v < part.outline.size(); ++v)
      for (std::size_t axis = 0; axis < 2; ++axis) p.part[i].vertex_mm[v][axis] = near(part.outline[v][axis], kMilli);  // whole already
  }
}

void compile_sensors(const MachineFile& m, berm_parameters& p) {
  for (std::size_t i = 0; i < m.scanner.size(); ++i) {
    const auto& s = m.scanner[i];
    p.scanner[i] = {near(s.position[0], kMilli), near(s.position[1], kMilli), near(s.position[2], kMilli),
                    up(s.pan_low, kMicro),       down(s.pan_high, kMicro),    down(s.pan_rate_max, kMicro)};
  }
  p.lidars = static_cast<std::int32_t>(m.lidar.size());
  for (std::size_t i = 0; i < m.lidar.size(); ++i) {
    const auto& l = m.lidar[i];
    p.lidar[i] = {near(l.position[0], kMilli), near(l.position[1], kMilli), near(l.position[2], kMilli),
                  near(l.roll, kMicro),        near(l.pitch, kMicro),       near(l.yaw, kMicro)};
  }
  const auto& k = m.kernel;
  p.scanner_silent_us = down(k.scanner_silent, kMicro);
  p.spurious_range_mm = up(k.spurious_range, kMilli);        // fewer returns dropped
  p.range_min_mm = down(k.range_min, kMilli);                // fewer returns dropped
  p.range_max_mm = up(k.range_max, kMilli);
  p.self_margin_mm = down(k.self_margin, kMilli);            // fewer returns dropped
}

void compile_rules(const MachineFile& m, const SiteFile& site, berm_parameters& p) {
  const auto& k = m.kernel;
  p.margin_mm = up(k.margin, kMilli);
  p.fresh_us = down(k.fresh, kMicro);
  p.generation_us = std::min(up(k.generation, kMicro), p.fresh_us);  // old heights stay longer
  p.dig_swing_limit_urad_s = down(k.dig_swing_limit, kMicro);
  p.request_age_us = down(k.request_age, kMicro);
  p.request_hold_us = down(k.request_hold, kMicro);
  p.request_silent_us = down(k.request_silent, kMicro);
  p.state_frame_age_us = down(k.state_frame_age, kMicro);
  p.machine_state_age_us = down(k.machine_state_age, kMicro);
  p.operator_age_us = down(k.operator_age, kMicro);
  p.cycle_us = up(k.cycle, kMicro);
  p.standstill_urad_s = down(k.standstill_speed, kMicro);
  p.standstill_us = up(k.standstill, kMicro);
  p.base_tilt_urad = down(k.base_tilt, kMicro);
  p.base_tilt_hard_urad = down(k.base_tilt_hard, kMicro);
  p.base_azimuth_urad = down(k.base_azimuth, kMicro);
  p.base_frame_age_us = down(k.base_frame_age, kMicro);
  p.dig_zones = static_cast<std::int32_t>(site.dig_zone.size());
  for (std::size_t i = 0; i < site.dig_zone.size(); ++i) {  // inwards
    const auto& z = site.dig_zone[i];
    p.dig_zone[i] = {up(z.x_low, kMilli), up(z.y_low, kMilli), down(z.x_high, kMilli), down(z.y_high, kMilli), up(z.floor, kMilli), down(z.ceiling, kMilli)};
  }
}

void compile_tail(const TailFile& t, berm_parameters& p) {
  p.tail_watched = t.watched ? 1 : 0;
  p.tail_radius_mm = up(t.radius, kMilli);
  p.tail_half_width_mm = up(t.half_width, kMilli);
  p.tail_low_mm = down(t.underside, kMilli);
  p.tail_high_mm = up(t.top, kMilli);
  p.tail_clearance_mm = up(t.clearance, kMilli);
  p.tail_fresh_us = down(t.fresh, kMicro);
}

void compile_workspace(const WorkspaceFile& w, const SiteFile& site, berm_parameters& p) {
  p.workspace_watched = w.watched ? 1 : 0;
  p.workspace_radius_mm = up(w.radius, kMilli);
  p.workspace_rise_mm = down(w.rise, kMilli);
  p.workspace_neighbour_mm = down(w.neighbour, kMilli);  // fewer rises explained
  p.workspace_slope_mm = up(w.slope, kMilli);            // fewer rises explained
  p.workspace_wait_us = down(w.wait, kMicro);
  p.workspace_period_us = down(w.period, kMicro);
  p.workspace_dwell_us = up(w.dwell, kMicro);
  p.workspace_learn_us = down(w.learn, kMicro);          // less is taken for ground
  p.workspace_learn_speed_permille = down(w.learn_speed, kMilli);
  p.workspace_foreign = w.foreign;
  p.workspace_lidar_wait_us = down(w.lidar_wait, kMicro);
  p.workspace_lidar_period_us = down(w.lidar_period, kMicro);
  p.workspace_follows = w.follows ? 1 : 0;
  p.workspace_histogram = w.histogram ? 1 : 0;
  p.workspace_separation = w.separation;
  p.workspace_approach_mm_s = up(w.approach_speed, kMilli);
  p.workspace_intrusion_mm = up(w.intrusion_distance, kMilli);
  p.lanes = static_cast<std::int32_t>(site.truck_lane.size());
  for (std::size_t i = 0; i < site.truck_lane.size(); ++i) {  // inwards: while open it is not watched
    const auto& z = site.truck_lane[i];
    p.lane[i] = {up(z.x_low, kMilli), up(z.y_low, kMilli), down(z.x_high, kMilli), down(z.y_high, kMilli)};
  }
}

void compile_sight(const SightFile& s, berm_parameters& p) {
  p.sight_blind_permille = down(s.blind, kMilli);
  p.dust_slow_permille = down(s.dust_slow, kMilli);
  p.dust_stop_permille = down(s.dust_stop, kMilli);
  p.dust_speed_permille = down(s.dust_speed, kMilli);
  p.dust_dwell_us = up(s.dust_dwell, kMicro);
}

void compile_overpass(const SiteFile& site, berm_parameters& p) {
  p.pass_over_mm = down(site.pass_over, kMilli);
  p.ground_zones = static_cast<std::int32_t>(site.ground_zone.size());
  for (std::size_t i = 0; i < site.ground_zone.size(); ++i) {  // outwards: it forbids
    const auto& z = site.ground_zone[i];
    p.ground_zone[i] = {down(z.x_low, kMilli), down(z.y_low, kMilli), up(z.x_high, kMilli), up(z.y_high, kMilli), down(z.pass_over, kMilli)};
  }
  p.truck_zones = static_cast<std::int32_t>(site.truck_zone.size());
  for (std::size_t i = 0; i < site.truck_zone.size(); ++i) {  // inwards: it permits
    const auto& z = site.truck_zone[i];
    p.truck_zone[i] = {up(z.x_low, kMilli), up(z.y_low, kMilli), down(z.x_high, kMilli), down(z.y_high, kMilli), down(z.ceiling, kMilli)};
  }
}

}  // namespace

berm_parameters compile_parameters(const MachineFile& m, const SiteFile& site) {
  constexpr std::int32_t kCell_mm = 300;
  berm_parameters p{};
  p.magic = BERM_PARAMETERS_MAGIC;
  p.version = BERM_PARAMETERS_VERSION;
  p.size = static_cast<std::int32_t>(sizeof p);
  p.cell_mm = kCell_mm;
  p.boom_pin_x_mm = near(m.boom_pin_x, kMilli);
  p.boom_pin_z_mm = near(m.boom_pin_z, kMilli);
  p.boom_length_mm = near(m.boom, kMilli);
  p.stick_length_mm = near(m.stick, kMilli);
  p.bucket_length_mm = near(m.bucket, kMilli);
  p.own_body_radius_mm = down(m.own_body_radius, kMilli);
  p.state_latency_us = up(m.state_latency, kMicro);
  p.command_latency_us = up(m.command_latency, kMicro);
  compile_joints(m, p);
  compile_parts(m, p);
  compile_sensors(m, p);
  compile_rules(m, site, p);
  compile_overpass(site, p);
  compile_tail(m.tail, p);
  compile_workspace(m.workspace, site, p);
  compile_sight(m.sight, p);
  p.crc32 = parameters_crc(p);
  return p;
}

}  // namespace berm::config
