#include "io/motion_watch.hpp"

#include <algorithm>

#include "contract/berm_contract.h"
#include "geometry/reach.hpp"

namespace berm::kernel {

MotionWatch::MotionWatch(const berm_parameters& parameters)
    : parameters_(parameters), window_us_(std::int64_t{parameters.command_latency_us} + parameters.state_latency_us + parameters.cycle_us) {
  lose();
}

void MotionWatch::lose() {
  heard_us_ = -1;
  for (sk_motion_joint& joint : joint_) sk_motion_begin(&joint);
  for (sk_agreement& joint : agreement_) sk_agreement_begin(&joint);
}

std::int32_t MotionWatch::row_of(const MotionQuery& query, const sk_reach_box& box) const {
  bool bounded = true;  // else the machine is faster than its table, and the box is none
  for (int j = BERM_BOOM; j < SK_JOINTS; ++j)
    bounded = bounded && box.low_urad[j] <= query.angle_urad[j] && query.angle_urad[j] <= box.high_urad[j];
  const std::int32_t reach_mm = bounded ? max_reach_mm(parameters_, box) : -1;
  const std::int32_t row = reach_mm < 0 ? -1 : sk_brake_row(&parameters_, reach_mm);
  return row < 0 ? BERM_BRAKE_REACHES - 1 : row;
}

std::uint8_t MotionWatch::agree(const MotionQuery& query) {
  std::int32_t fault = BERM_STOP_NONE;
  const auto latency_us = static_cast<std::int32_t>(std::min<std::int64_t>(parameters_.state_latency_us + query.late_us, SK_AGREE_LATENCY_MOST_US));
  for (int j = 0; j < SK_JOINTS; ++j) {
    const sk_agreement_reading reading = {query.now_us, j, query.angle_urad[j], query.velocity_urad_s[j], latency_us};
    const std::int32_t result = sk_agreement_step(&agreement_[j], &parameters_, reading);
    if (fault == BERM_STOP_NONE) fault = result;
  }
  return static_cast<std::uint8_t>(fault);
}

std::uint8_t MotionWatch::check(const MotionQuery& query, const sk_reach_box& box, std::int64_t angle_us, std::int64_t velocity_us) {
  if (heard_us_ < 0) heard_us_ = query.now_us;
  if (angle_us <= angle_us_ || velocity_us <= velocity_us_) return BERM_STOP_NONE;
  angle_us_ = angle_us;
  velocity_us_ = velocity_us;
  const std::uint8_t disagreement = agree(query);
  // Commands of a kernel before this one, or brakes of a machine that heard none, may have been at work until then.
  if (query.now_us - heard_us_ <= window_us_) return disagreement;
  const std::int32_t row = row_of(query, box);
  std::int32_t fault = BERM_STOP_NONE;  // before a disagreement: it removes power at once
  for (int j = 0; j < SK_JOINTS; ++j) {
    const sk_motion_reading reading = {query.now_us, j, row, query.angle_urad[j], query.velocity_urad_s[j], query.under_way_high_urad_s[j]};
    const std::int32_t result = sk_motion_step(&joint_[j], &parameters_, reading, query.under_way_low_urad_s[j]);
    if (fault == BERM_STOP_NONE) fault = result;
  }
  return fault == BERM_STOP_NONE ? disagreement : static_cast<std::uint8_t>(fault);
}

}  // namespace berm::kernel
