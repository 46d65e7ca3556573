#include "validate/commander.hpp"

#include <algorithm>
#include <numbers>

namespace berm::validate {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double lead_near = 45 * degree, lead_far = 85 * degree;  // pan ahead of the swing
constexpr double azimuth_rate = 45 * degree;  // 1/s, over the ground: 30 scanlines a second then lie less than a cell apart out to 11 m

}  // namespace

Commander::Commander(const config::MachineFile& machine, const Trial& trial, double reach_m, bool looks_first)
    : machine_(machine), trial_(trial), driver_(machine, reach_m), swinging_(!looks_first) {}

void Commander::pans(const berm_state& state, berm_request& request) {
  const double side = trial_.to[0] > trial_.from[0] ? 1.0 : -1.0;
  bool seen = true;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& mount = machine_.scanner[i];
    const double pan = state.pan_angle_urad[i] * 1e-6;
    low_seen_[i] = low_seen_[i] || pan < mount.pan_low + 3.0 * degree;
    high_seen_[i] = high_seen_[i] || pan > mount.pan_high - 3.0 * degree;
    seen = seen && low_seen_[i] && high_seen_[i];
    const bool leads = (side > 0.0) == (i == 0);
    double low = mount.pan_low, high = mount.pan_high;
    if (swinging_) {
      low = std::clamp(leads ? std::min(side * lead_near, side * lead_far) : -45 * degree, mount.pan_low, mount.pan_high);
      high = std::clamp(leads ? std::max(side * lead_near, side * lead_far) : 45 * degree, mount.pan_low, mount.pan_high);
    }
    if (pan > high - 1.5 * degree) up_[i] = false;
    if (pan < low + 1.5 * degree) up_[i] = true;
    request.pan_goal_urad[i] = static_cast<std::int32_t>((up_[i] ? high : low) * 1e6);
    const double rate = azimuth_rate - (up_[i] ? 1.0 : -1.0) * state.joint_velocity_urad_s[0] * 1e-6;
    request.pan_rate_urad_s[i] = static_cast<std::int32_t>(std::clamp(rate, 1.0 * degree, mount.pan_rate_max) * 1e6);
  }
  if (seen && state.kernel_state == BERM_STATE_RUN) swinging_ = true;
}

berm_request Commander::answer(const berm_state& state) {
  berm_request r{};
  r.phase = BERM_PHASE_SWING_TO_TRUCK;
  pans(state, r);
  if (swinging_) {
    std::array<double, 4> speed{};
    for (std::size_t j = 0; j < speed.size(); ++j) speed[j] = driver_.speed(j, trial_.to[j], j == 0 ? trial_.swing_speed : driver_.arm_limit(j), state);
    in_process::put_speeds(speed, machine_, r);
  }
  in_process::seal(r, ++sequence_, state);
  return r;
}

bool Commander::arrived(const berm_state& state) const { return swinging_ && in_process::JointDriver::arrived(trial_.to, state); }

}  // namespace berm::validate
