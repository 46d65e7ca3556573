// Machine, world and whoever supervises, in one loop of virtual time: the plant's own parts, in the order of its process.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "in_process/supervisor.hpp"
#include "plant/machine/joint_dynamics.hpp"
#include "plant/machine/machine_controller.hpp"
#include "plant/machine/pan_servo.hpp"
#include "plant/machine/plant_profile.hpp"
#include "plant/machine/state_frames.hpp"
#include "plant/process/world_config.hpp"
#include "plant/world/world.hpp"

namespace berm::in_process {

class MachineLoop {
 public:
  static constexpr double cycle_s = 0.01;
  struct Start {
    std::array<double, 4> joints{};  // rad: swing, boom, stick, bucket
    double payload_kg = 0.0;         // throughout
    int trucks = 0;
    bool scans = true;               // whether the panning scanners are simulated
  };
  // The request that answers a published state.
  using Answer = std::function<berm_request(const berm_state&)>;

  MachineLoop(const plant::PlantProfile& profile, const plant::WorldConfig& world, std::uint64_t seed, const Start& start,
              std::unique_ptr<Supervisor> supervisor);

  // One cycle. The first has no request.
  void advance(const Answer& answer);

  double time_s() const { return static_cast<double>(cycle_) * cycle_s; }  // of the newest cycle
  std::uint64_t cycle() const { return cycle_; }
  const plant::JointState& joints() const { return dynamics_.state(); }
  plant::World& world() { return world_; }
  const Supervisor& supervisor() const { return *supervisor_; }
  const berm_state& state() const { return supervisor_->state(); }
  const berm_request& asked() const { return asked_; }
  const std::vector<berm_scan_packet>& scans() const { return arrived_.scans; }  // of the newest cycle

 private:
  double payload_kg_;
  bool scans_;
  std::unique_ptr<Supervisor> supervisor_;
  plant::World world_;
  plant::JointDynamics dynamics_;
  plant::MachineController controller_;
  plant::StateFrames frames_;
  std::array<plant::PanServo, 2> servo_;
  plant::PanState pan_;
  Arrived arrived_;
  berm_request asked_{};
  std::uint64_t cycle_ = 0;
  bool resting_ = true;
  int stood_by_cycles_ = 0;
};

}  // namespace berm::in_process
