#include "io/supervision.hpp"

#include <algorithm>
#include <cstdlib>

#include "contract/berm_contract.h"

namespace berm::kernel {

namespace {

// Longest time until every joint stands when these were the last speeds heard and the stop is sent once the frames are found stale.
std::int64_t time_to_stand_us(const std::int32_t (&velocity_urad_s)[4], const berm_parameters& p) {
  const std::int64_t delay_us = static_cast<std::int64_t>(p.state_latency_us) + p.state_frame_age_us + p.cycle_us + p.command_latency_us;
  std::int64_t brake_us = 0;
  for (int j = 0; j < SK_JOINTS; ++j) {
    const std::int64_t max = p.velocity_max_urad_s[j];
    const std::int64_t speed = std::abs(velocity_urad_s[j]) + p.velocity_error_urad_s[j] + p.acceleration_max_urad_s2[j] * delay_us / 1000000 + 1;
    const std::int64_t column = std::min<std::int64_t>((speed * (BERM_BRAKE_SPEEDS - 1) + max - 1) / max, BERM_BRAKE_SPEEDS - 1);
    brake_us = std::max<std::int64_t>(brake_us, p.brake_time_us[j][BERM_BRAKE_REACHES - 1][column]);
  }
  return delay_us + brake_us;
}

std::uint8_t fault_of(const FrameIntake& frames, const RangeSensors& sensors, bool clock_fault, const berm_parameters& p, std::int64_t now_us) {
  if (clock_fault) return BERM_STOP_CLOCK;
  if (!frames.state_heard()) return BERM_STOP_NONE;  // still in INIT
  if (!frames.joints_fresh(now_us) || !frames.machine_fresh(now_us)) return BERM_STOP_STATE_FRAME;
  if (frames.base().learned && !sk_base_fresh(&frames.base(), &p, now_us)) return BERM_STOP_STATE_FRAME;
  if (!frames.machine_healthy()) return BERM_STOP_MACHINE_FAULT;
  if (sensors.silent(now_us, p.scanner_silent_us)) return BERM_STOP_SCANNER_SILENT;
  if (sensors.sight.blocked()) return BERM_STOP_SENSOR_BLOCKED;
  return BERM_STOP_NONE;
}

std::uint8_t latch_of(const FrameIntake& frames, const AppPulse& app, const berm_parameters& p, std::int64_t now_us) {
  if (frames.estop_pressed()) return BERM_STOP_EMERGENCY;
  if (frames.base().moved) return BERM_STOP_BASE_MOVED;
  // A panel or spotter that falls silent is one whose stop would not be heard.
  const bool operator_lost = frames.operator_heard() && !frames.operator_fresh(now_us);
  if (frames.operator_stop() || frames.spotter_stop() || operator_lost || frames.spotter_lost(now_us)) return BERM_STOP_OPERATOR;
  return app.holds(now_us, p.request_silent_us) ? BERM_STOP_APP_SILENT : BERM_STOP_NONE;
}

}  // namespace

bool StandstillWatch::check(const std::int32_t (&velocity_urad_s)[4], bool fresh, const berm_parameters& parameters, std::int64_t now_us) {
  if (!fresh) {
    moving_ = stands_us_ < 0 || now_us < stands_us_;
    if (moving_) moved_us_ = now_us;
    return !moving_;
  }
  stands_us_ = now_us + time_to_stand_us(velocity_urad_s, parameters);
  moving_ = false;
  for (const std::int32_t v : velocity_urad_s) moving_ = moving_ || std::abs(v) > parameters.standstill_urad_s;
  if (moving_ || moved_us_ < 0) moved_us_ = now_us;
  return now_us - moved_us_ >= parameters.standstill_us;
}

bool inputs_ready(const FrameIntake& frames, const RangeSensors& sensors, const berm_parameters& parameters, std::int64_t now_us) {
  return frames.state_heard() && frames.base().learned && frames.joints_fresh(now_us) && frames.machine_fresh(now_us) && frames.operator_heard() && frames.operator_fresh(now_us) &&
         sensors.all_heard() && !sensors.silent(now_us, parameters.scanner_silent_us) && !sensors.sight.blocked();
}

void supervise(const FrameIntake& frames, const RangeSensors& sensors, const AppPulse& app, bool clock_fault, const berm_parameters& parameters,
               sk_stop_input& in) {
  in.fault_reason = fault_of(frames, sensors, clock_fault, parameters, in.now_us);
  in.fault_category_0 = false;  // with valves that centre and brakes that hold, braking under control is the shorter way to standstill
  in.latch_reason = latch_of(frames, app, parameters, in.now_us);
  in.latch_category_0 = in.latch_reason == BERM_STOP_EMERGENCY;
}

}  // namespace berm::kernel
