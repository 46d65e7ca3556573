// A parameter block for people: every field, one a line.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "config/compile_parameters.hpp"

namespace berm::config {

namespace {

class Listing {
 public:
  template <typename Value>
  void row(const std::string& name, const Value& value) { text_ += fmt::format("{:<28}{}\n", name, value); }
  void joints(const char* name, const std::int32_t (&v)[4]) { row(name, fmt::format("swing {} boom {} stick {} bucket {}", v[0], v[1], v[2], v[3])); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void kinematics(const berm_parameters& p, Listing& out) {
  out.row("boom_pin_x_mm", p.boom_pin_x_mm);
  out.row("boom_pin_z_mm", p.boom_pin_z_mm);
  out.row("boom_length_mm", p.boom_length_mm);
  out.row("stick_length_mm", p.stick_length_mm);
  out.row("bucket_length_mm", p.bucket_length_mm);
  out.row("own_body_radius_mm", p.own_body_radius_mm);
  out.joints("joint_low_urad", p.joint_low_urad);
  out.joints("joint_high_urad", p.joint_high_urad);
  out.joints("velocity_max_urad_s", p.velocity_max_urad_s);
  out.joints("acceleration_max_urad_s2", p.acceleration_max_urad_s2);
  out.joints("creep_velocity_urad_s", p.creep_velocity_urad_s);
  out.joints("angle_error_urad", p.angle_error_urad);
  out.joints("velocity_error_urad_s", p.velocity_error_urad_s);
  out.row("state_latency_us", p.state_latency_us);
  out.row("command_latency_us", p.command_latency_us);
}

void braking(const berm_parameters& p, Listing& out) {
  for (std::size_t j = 0; j < kJoints; ++j)
    for (int r = 0; r < BERM_BRAKE_REACHES; ++r) {
      const std::string where = fmt::format("[{} to {} mm]", kJointNames[j], p.brake_reach_mm[r]);
      out.row("brake_angle_urad" + where, fmt::format(" {}", fmt::join(p.brake_angle_urad[j][r], " ")));
      out.row("brake_time_us" + where, fmt::format(" {}", fmt::join(p.brake_time_us[j][r], " ")));
    }
}

void bodies_and_sensors(const berm_parameters& p, Listing& out) {
  for (int i = 0; i < std::clamp(p.parts, 0, BERM_PARTS); ++i) {
    const berm_part& part = p.part[i];
    std::string outline;
    for (int v = 0; v < std::clamp(part.vertices, 0, BERM_PART_VERTICES); ++v) outline += fmt::format(" ({}, {})", part.vertex_mm[v][0], part.vertex_mm[v][1]);
    out.row(fmt::format("part[{}]", i), fmt::format("link {} half width {} mm, x, z in mm:{}", part.link, part.half_width_mm, outline));
  }
  for (int i = 0; i < BERM_SCANNER_MOUNTS; ++i) {
    const berm_scanner_mount& s = p.scanner[i];
    out.row(fmt::format("scanner[{}]", i), fmt::format("at {} {} {} mm, pan {}..{} urad, at most {} urad/s", s.x_mm, s.y_mm, s.z_mm, s.pan_low_urad, s.pan_high_urad,
                                                       s.pan_rate_max_urad_s));
  }
  for (int i = 0; i < std::clamp(p.lidars, 0, BERM_LIDARS); ++i) {
    const berm_lidar_mount& l = p.lidar[i];
    out.row(fmt::format("lidar[{}]", i), fmt::format("at {} {} {} mm, roll {} pitch {} yaw {} urad", l.x_mm, l.y_mm, l.z_mm, l.roll_urad,
                                                     l.pitch_urad, l.yaw_urad));
  }
  out.row("scanner_silent_us", p.scanner_silent_us);
  out.row("spurious_range_mm", p.spurious_range_mm);
  out.row("range_min_mm", p.range_min_mm);
  out.row("range_max_mm", p.range_max_mm);
  out.row("self_margin_mm", p.self_margin_mm);
}

void rules(const berm_parameters& p, Listing& out) {
  out.row("margin_mm", p.margin_mm);
  out.row("fresh_us", p.fresh_us);
  out.row("generation_us", p.generation_us);
  out.row("dig_swing_limit_urad_s", p.dig_swing_limit_urad_s);
  for (int i = 0; i < std::clamp(p.dig_zones, 0, BERM_DIG_ZONES); ++i) {
    const berm_dig_zone& z = p.dig_zone[i];
    out.row(fmt::format("dig_zone[{}]", i), fmt::format("x {}..{} y {}..{} floor {} ceiling {} mm", z.x_low_mm, z.x_high_mm, z.y_low_mm, z.y_high_mm, z.floor_mm, z.ceiling_mm));
  }
  out.row("request_age_us", p.request_age_us);
  out.row("request_hold_us", p.request_hold_us);
  out.row("request_silent_us", p.request_silent_us);
  out.row("state_frame_age_us", p.state_frame_age_us);
  out.row("machine_state_age_us", p.machine_state_age_us);
  out.row("operator_age_us", p.operator_age_us);
  out.row("cycle_us", p.cycle_us);
  out.row("standstill_urad_s", p.standstill_urad_s);
  out.row("standstill_us", p.standstill_us);
  out.row("base_tilt_urad", p.base_tilt_urad);
  out.row("base_tilt_hard_urad", p.base_tilt_hard_urad);
  out.row("base_azimuth_urad", p.base_azimuth_urad);
  out.row("base_frame_age_us", p.base_frame_age_us);
}

void overpass(const berm_parameters& p, Listing& out) {
  out.row("pass_over_mm", p.pass_over_mm);
  for (int i = 0; i < std::clamp(p.ground_zones, 0, BERM_GROUND_ZONES); ++i) {
    const berm_ground_zone& z = p.ground_zone[i];
    out.row(fmt::format("ground_zone[{}]", i), fmt::format("x {}..{} y {}..{} pass over {} mm", z.x_low_mm, z.x_high_mm, z.y_low_mm, z.y_high_mm, z.pass_over_mm));
  }
  for (int i = 0; i < std::clamp(p.truck_zones, 0, BERM_TRUCK_ZONES); ++i) {
    const berm_truck_zone& z = p.truck_zone[i];
    out.row(fmt::format("truck_zone[{}]", i), fmt::format("x {}..{} y {}..{} ceiling {} mm", z.x_low_mm, z.x_high_mm, z.y_low_mm, z.y_high_mm, z.ceiling_mm));
  }
}

void tail(const berm_parameters& p, Listing& out) {
  out.row("tail_watched", p.tail_watched);
  out.row("tail_radius_mm", p.tail_radius_mm);
  out.row("tail_half_width_mm", p.tail_half_width_mm);
  out.row("tail_low_mm", p.tail_low_mm);
  out.row("tail_high_mm", p.tail_high_mm);
  out.row("tail_clearance_mm", p.tail_clearance_mm);
  out.row("tail_fresh_us", p.tail_fresh_us);
}

void workspace(const berm_parameters& p, Listing& out) {
  out.row("workspace_watched", p.workspace_watched);
  out.row("workspace_radius_mm", p.workspace_radius_mm);
  out.row("workspace_rise_mm", p.workspace_rise_mm);
  out.row("workspace_neighbour_mm", p.workspace_neighbour_mm);
  out.row("workspace_slope_mm", p.workspace_slope_mm);
  out.row("workspace_wait_us", p.workspace_wait_us);
  out.row("workspace_period_us", p.workspace_period_us);
  out.row("workspace_dwell_us", p.workspace_dwell_us);
  out.row("workspace_learn_us", p.workspace_learn_us);
  out.row("workspace_learn_speed_permille", p.workspace_learn_speed_permille);
  out.row("workspace_foreign", p.workspace_foreign);
  out.row("workspace_lidar_wait_us", p.workspace_lidar_wait_us);
  out.row("workspace_lidar_period_us", p.workspace_lidar_period_us);
  out.row("workspace_follows", p.workspace_follows);
  out.row("workspace_histogram", p.workspace_histogram);
  out.row("workspace_separation", p.workspace_separation);
  out.row("workspace_approach_mm_s", p.workspace_approach_mm_s);
  out.row("workspace_intrusion_mm", p.workspace_intrusion_mm);
  for (int i = 0; i < std::clamp(p.lanes, 0, BERM_LANES); ++i) {
    const berm_lane& z = p.lane[i];
    out.row(fmt::format("truck_lane[{}]", i), fmt::format("x {}..{} y {}..{} mm", z.x_low_mm, z.x_high_mm, z.y_low_mm, z.y_high_mm));
  }
}

void sight(const berm_parameters& p, Listing& out) {
  out.row("sight_blind_permille", p.sight_blind_permille);
  out.row("dust_slow_permille", p.dust_slow_permille);
  out.row("dust_stop_permille", p.dust_stop_permille);
  out.row("dust_speed_permille", p.dust_speed_permille);
  out.row("dust_dwell_us", p.dust_dwell_us);
}

}  // namespace

std::string describe(const berm_parameters& p) {
  Listing out;
  out.row("version", p.version);
  out.row("cell_mm", p.cell_mm);
  kinematics(p, out);
  braking(p, out);
  bodies_and_sensors(p, out);
  rules(p, out);
  overpass(p, out);
  tail(p, out);
  workspace(p, out);
  sight(p, out);
  out.row("crc32", fmt::format("{:08x}", static_cast<std::uint32_t>(p.crc32)));
  return out.text();
}

}  // namespace berm::config
