#include "app/machine_loader.hpp"

#include <algorithm>
#include <cmath>

#include "can/berm_can.h"

namespace berm::app {

static_assert(config::kJoints == joints);
static_assert(heartbeat_silence * 1e6 == BERM_CAN_SILENCE_US && kernel_sends_within * 1e6 == BERM_CAN_SEND_LATE_US);

namespace {

MachineModel::StepResponse step_response(const config::StepResponseFile& from) { return {from.dead_time, from.lag, from.stop_lag, from.gain, from.speeding, from.slowing}; }

MachineModel::StepResponses step_responses(const config::ResponseFile& from) {
  MachineModel::StepResponses out{from.payload, from.reach, {}};
  for (std::size_t j = 0; j < joints; ++j) out.joint[j] = {step_response(from.joint[j][0]), step_response(from.joint[j][1])};
  return out;
}

}  // namespace

MachineModel machine_model(const config::MachineFile& file) {
  MachineModel m;
  m.boom_pin_x = file.boom_pin_x;
  m.boom_pin_z = file.boom_pin_z;
  m.boom_length = file.boom;
  m.stick_length = file.stick;
  m.bucket_length = file.bucket;
  m.own_body_radius = file.own_body_radius;
  m.bucket_payload_kg = file.bucket_payload;
  for (std::size_t j = 0; j < joints; ++j) {
    const config::JointFile& from = file.joint[j];
    m.joint[j] = {from.low, from.high, from.velocity_max, from.acceleration_max, from.creep_velocity, from.angle_error, from.velocity_error};
  }
  for (std::size_t c = 0; c < m.cylinder.size(); ++c) m.cylinder[c] = {file.cylinder[c].bottom, file.cylinder[c].rod};
  m.state_latency = file.state_latency;
  m.command_latency = file.command_latency;
  m.cycle = file.kernel.cycle;
  m.braking.reach = file.braking.reach;
  m.braking.angle = file.braking.angle;
  if (file.response) m.responses = step_responses(*file.response);
  for (const config::PartFile& part : file.part) m.parts.push_back({static_cast<std::size_t>(part.link), part.half_width, part.outline});
  for (std::size_t i = 0; i < m.scanner.size(); ++i) {
    const config::ScannerFile& from = file.scanner[i];
    m.scanner[i] = {from.position[0], from.position[1], from.position[2], from.pan_low, from.pan_high, from.pan_rate_max};
  }
  m.margin = file.kernel.margin;
  m.fresh = file.kernel.fresh;
  m.dig_swing_limit = file.kernel.dig_swing_limit;
  m.range_min = file.kernel.range_min;
  m.range_max = file.kernel.range_max;
  m.spurious_range = file.kernel.spurious_range;
  m.self_margin = file.kernel.self_margin;
  return m;
}

SiteModel site_model(const config::SiteFile& file) {
  SiteModel s;
  for (const config::DigZoneFile& z : file.dig_zone) s.dig_zones.push_back({z.x_low, z.y_low, z.x_high, z.y_high, z.floor, z.ceiling});
  const config::TruckPlaceFile& t = file.truck;
  s.place = {t.centre[0], t.centre[1], t.yaw, t.target_kg};
  for (const config::TruckZoneFile& z : file.truck_zone) s.truck_zones.push_back({z.x_low, z.y_low, z.x_high, z.y_high, z.ceiling});
  s.pass_over = file.pass_over;
  for (const config::GroundZoneFile& z : file.ground_zone) s.ground_zones.push_back({z.x_low, z.y_low, z.x_high, z.y_high, z.pass_over});
  s.dig_swing_left = std::max(file.dig.swing[0], file.dig.swing[1]);
  s.dig_swing_right = std::min(file.dig.swing[0], file.dig.swing[1]);
  s.dig_radius_start = std::max(file.dig.radius[0], file.dig.radius[1]);
  s.dig_radius_end = std::min(file.dig.radius[0], file.dig.radius[1]);
  s.dig_floor = file.dig.floor;
  s.bench_height = file.dig.bench_height;
  for (const config::GoalPartFile& part : file.dig.goal) s.goal.push_back({part.x_low, part.y_low, part.x_high, part.y_high, part.level, part.slope[0], part.slope[1]});
  return s;
}

}  // namespace berm::app
