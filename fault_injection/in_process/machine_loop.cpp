#include "in_process/machine_loop.hpp"

#include <algorithm>
#include <cmath>

namespace berm::in_process {

namespace {
constexpr double still = 0.004;  // rad/s
constexpr int looks_before_run = 10;  // cycles: two of the panel's frames
}

MachineLoop::MachineLoop(const plant::PlantProfile& profile, const plant::WorldConfig& world, std::uint64_t seed, const Start& start,
                         std::unique_ptr<Supervisor> supervisor)
    : payload_kg_(start.payload_kg), scans_(start.scans), supervisor_(std::move(supervisor)), world_(world, profile.shape, seed, start.trucks),
      dynamics_(profile.dynamics, profile.shape, seed, {start.joints, {}}), controller_(profile), frames_(profile, seed),
      servo_{plant::PanServo(profile.shape.scanner[0]), plant::PanServo(profile.shape.scanner[1])} {}

void MachineLoop::advance(const Answer& answer) {
  ++cycle_;
  const double t = time_s(), now = t - cycle_s;
  controller_.decide(now, resting_);
  const plant::JointState before = dynamics_.state();
  const plant::PanState pan_before = pan_;
  dynamics_.step(cycle_s, controller_.drive(), controller_.command(), plant::DigForces{}, payload_kg_);
  for (std::size_t i = 0; i < servo_.size(); ++i) {
    const plant::PanGoal goal = controller_.pan(i, now, servo_[i].angle());
    servo_[i].step(cycle_s, goal.goal, goal.rate);
    pan_.angle[i] = servo_[i].angle();
    pan_.velocity[i] = servo_[i].velocity();
  }
  world_.step(t, cycle_s, dynamics_.state(), before);
  arrived_ = Arrived{};
  if (scans_) world_.scan(t, cycle_s, before, dynamics_.state(), pan_before, pan_, arrived_.scans);
  if (supervisor_->needs_scans()) world_.scan_lidars(t, cycle_s, before, dynamics_.state(), arrived_.lidars);
  const auto& speed = dynamics_.state().velocity;
  resting_ = std::all_of(speed.begin(), speed.end(), [](double v) { return std::fabs(v) < still; });

  plant::MachineSnapshot snapshot;
  snapshot.joints = dynamics_.state();
  snapshot.payload_kg = payload_kg_;
  snapshot.pilot_unlocked = controller_.pilot_unlocked();
  // The run switch goes on when the kernel has stood by for a moment: one that was on before counts for nothing.
  stood_by_cycles_ += supervisor_->state().kernel_state == BERM_STATE_STANDBY;
  snapshot.panel.run = stood_by_cycles_ > looks_before_run;
  snapshot.truck_parked = world_.truck_parked();
  snapshot.truck_leaving = world_.truck_leaving();
  const bool has_request = cycle_ > 1;
  if (has_request) asked_ = answer(supervisor_->state());
  arrived_.frames = frames_.frames(cycle_, snapshot);
  for (const auto& frame : supervisor_->step(cycle_, arrived_, has_request ? &asked_ : nullptr)) controller_.receive(frame, t);
}

}  // namespace berm::in_process
