#include "watch/loading_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/machine_loader.hpp"

namespace berm::watch {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double cycle_s = 0.01;
struct Arm { double boom, stick, bucket; };                                  // degrees
constexpr Arm carry{45, -100, -100}, reach_down{25, -75, -70}, curled{30, -95, -100}, over_bed{40, -80, -60};

}  // namespace

struct LoadingMotion::Leg {
  std::uint16_t phase;
  bool at_truck;
  Arm arm;
  double stays_s;
};

// A pass: down to the face, curl, lift, swing, empty, swing back. The pose of a leg is that of its end.
const std::array<LoadingMotion::Leg, 6> LoadingMotion::legs{{
    {BERM_PHASE_DIG, false, reach_down, 0.5},
    {BERM_PHASE_DIG, false, curled, 0.5},
    {BERM_PHASE_LIFT, false, carry, 0.0},
    {BERM_PHASE_SWING_TO_TRUCK, true, carry, 0.0},
    {BERM_PHASE_DUMP, true, over_bed, 1.5},
    {BERM_PHASE_SWING_TO_DIG, false, carry, 0.0},
}};

std::array<double, 4> first_pose(const LoadingPlace& place) {
  return {place.dig_bearing, carry.boom * degree, carry.stick * degree, carry.bucket * degree};
}

double farthest_tip(const config::MachineFile& machine) {
  double farthest = 0.0;
  for (const Arm& arm : {carry, reach_down, curled, over_bed}) {
    const double stick = arm.boom + arm.stick, bucket = stick + arm.bucket;
    const double elbow = machine.boom_pin_x + machine.boom * std::cos(arm.boom * degree);
    const double wrist = elbow + machine.stick * std::cos(stick * degree), tip = wrist + machine.bucket * std::cos(bucket * degree);
    farthest = std::max({farthest, elbow, wrist, tip});
  }
  return farthest;
}

LoadingMotion::LoadingMotion(const config::MachineFile& machine, const LoadingPlace& place)
    : machine_(machine), place_(place), driver_(machine, farthest_tip(machine)), scheduler_(app::machine_model(machine)) {
  scheduler_.begin_full_sweep();
}

std::array<double, 4> LoadingMotion::goal() const {
  if (looking_ && cycles_ == 0 && leg_ == 0) return first_pose(place_);
  const Leg& leg = legs[leg_];
  return {leg.at_truck ? place_.truck_bearing : place_.dig_bearing, leg.arm.boom * degree, leg.arm.stick * degree, leg.arm.bucket * degree};
}

void LoadingMotion::go_on(const berm_state& state) {
  if (state.kernel_state != BERM_STATE_RUN) return;
  if (looking_) {
    if (!scheduler_.full_sweep_done()) return;
    looking_ = false;
    if (leg_ == 0) return;
  } else if (!in_process::JointDriver::arrived(goal(), state)) {
    return;
  }
  stood_s_ += cycle_s;
  if (stood_s_ < legs[leg_].stays_s) return;
  stood_s_ = 0.0;
  leg_ = (leg_ + 1) % legs.size();
  if (leg_ == 0) ++cycles_;
  if (cycles_ == 0 && legs[leg_].phase == BERM_PHASE_DUMP) {  // what stands behind the machine is seen from here
    scheduler_.begin_full_sweep();
    looking_ = true;
  }
}

berm_request LoadingMotion::answer(const berm_state& state) {
  go_on(state);
  // While the kernel learns the ground it lets motions out slowly, and ground grows old on which the looks of their phases do not fall: as the app does then.
  if (!looking_ && (state.sight & (BERM_SIGHT_LEARNS | BERM_SIGHT_LEARNS_LANE)) != 0) scheduler_.begin_full_sweep();
  berm_request r{};
  r.phase = legs[leg_].phase;
  const std::array<double, 4> to = goal();
  std::array<double, 4> speed{};
  for (std::size_t j = 0; j < speed.size(); ++j)
    speed[j] = driver_.speed(j, to[j], j == 0 ? machine_.joint[j].velocity_max : driver_.arm_limit(j), state);
  in_process::put_speeds(speed, machine_, r);
  const auto pans = scheduler_.step(r.phase, place_.dig_bearing, place_.truck_bearing, state.joint_angle_urad[0] * 1e-6,
                                    state.joint_velocity_urad_s[0] * 1e-6, {state.pan_angle_urad[0] * 1e-6, state.pan_angle_urad[1] * 1e-6});
  for (std::size_t i = 0; i < pans.size(); ++i) {
    r.pan_goal_urad[i] = static_cast<std::int32_t>(pans[i].goal * 1e6);
    r.pan_rate_urad_s[i] = static_cast<std::int32_t>(pans[i].rate * 1e6);
  }
  in_process::seal(r, ++sequence_, state);
  return r;
}

}  // namespace berm::watch
