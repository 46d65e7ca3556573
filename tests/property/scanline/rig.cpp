#include "rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "app/machine_loader.hpp"
#include "config/compile_parameters.hpp"
#include "config/site_file.hpp"
#include "plant/machine/plant_profile.hpp"

namespace berm::test {

namespace {

constexpr double cycle_s = 0.01;

plant::JointState joints_of(const Motion& motion, double t) {
  plant::JointState s;
  s.angle = motion(t).joint;
  const auto later = motion(t + 1e-4).joint;
  for (std::size_t j = 0; j < s.angle.size(); ++j) s.velocity[j] = (later[j] - s.angle[j]) / 1e-4;
  return s;
}

}  // namespace

config::MachineFile zx200_file() { return config::load_machine_file(BERM_CONFIG_DIR "/machines/zx200.toml"); }

ScanRig::ScanRig(const std::string& scenario, std::uint64_t seed, Motion motion, const plant::BasePose& base)
    : file_(zx200_file()), parameters_(config::compile_parameters(file_, config::load_site_file(BERM_CONFIG_DIR "/sites/bench.toml"))),
      machine_(app::machine_model(file_)), motion_(std::move(motion)),
      scenario_(plant::load_scenario(BERM_SCENARIOS "/" + scenario + ".toml", BERM_PLANT_PROFILES)), intake_(parameters_),
      map_(std::make_unique<sk_height_map>()), blocks_(std::make_unique<kernel::ScanBlocks>()), segment_(std::make_unique<berm_state_segment>()),
      publisher_((std::memset(static_cast<void*>(segment_.get()), 0, sizeof *segment_), *segment_), parameters_, true) {
  sk_map_clear(map_.get());
  const plant::PlantProfile profile = plant::load_plant_profile(scenario_.machine_file);
  world_ = std::make_unique<plant::World>(scenario_.world, profile.shape, seed, 1);
  world_->stand(base);
}

void ScanRig::advance() {
  const double before = time_s();
  ++cycle_;
  const double t = time_s();
  const auto now_us = static_cast<std::int64_t>(cycle_) * 10000;
  const plant::JointState from = joints_of(motion_, before), to = joints_of(motion_, t);
  plant::PanState pan_from, pan_to;
  pan_from.angle = motion_(before).pan;
  pan_to.angle = motion_(t).pan;
  world_->step(t, cycle_s, to, from);
  std::vector<berm_scan_packet> packets;
  world_->scan(t, cycle_s, from, to, pan_from, pan_to, packets);
  berm_decision decision{};
  decision.cycle = cycle_;
  decision.time_us = now_us;
  for (std::size_t j = 0; j < to.angle.size(); ++j) {
    decision.joint_angle_urad[j] = static_cast<std::int32_t>(std::lround(to.angle[j] * 1e6));
    decision.joint_velocity_urad_s[j] = static_cast<std::int32_t>(std::lround(to.velocity[j] * 1e6));
  }
  joints_.push(now_us, decision.joint_angle_urad);
  blocks_->count = 0;
  for (const berm_scan_packet& packet : packets) intake_.take(packet, joints_, now_us, *map_, *blocks_);
  intake_.flush(joints_, now_us, *map_, *blocks_);
  publisher_.scans(*blocks_);
  publisher_.decision(decision);
}

Motion drawn_motion(std::uint64_t seed, const config::MachineFile& machine) {
  std::mt19937_64 random(seed);
  const auto draw = [&](double low, double high) { return low + (high - low) * static_cast<double>(random() >> 11) * 0x1.0p-53; };
  const double middle = draw(0.0, 1.2), wide = draw(0.1, 0.8), fastest = draw(0.3, 1.0) * machine.joint[0].velocity_max, phase = draw(0.0, 6.0);
  const std::array<double, 3> arm{draw(0.7, 0.9), draw(-1.9, -1.4), draw(-1.9, -1.4)};
  std::array<double, 2> pan_middle{}, pan_wide{}, pan_rate{};
  for (std::size_t i = 0; i < 2; ++i) {
    const config::ScannerFile& s = machine.scanner[i];
    pan_middle[i] = 0.5 * (s.pan_low + s.pan_high);
    pan_wide[i] = draw(0.2, 0.5) * (s.pan_high - s.pan_low);
    pan_rate[i] = draw(0.1, 1.0) * s.pan_rate_max / pan_wide[i];
  }
  return [=](double t) {
    Stance s;
    s.joint = {middle + wide * std::sin(fastest / wide * t + phase), arm[0] + 0.05 * std::sin(2.0 * t), arm[1] + 0.1 * std::sin(1.5 * t), arm[2]};
    for (std::size_t i = 0; i < 2; ++i) s.pan[i] = pan_middle[i] + pan_wide[i] * std::sin(pan_rate[i] * t);
    return s;
  };
}

}  // namespace berm::test
