#include "app/joint_watch.hpp"

#include "motion/reach_preview.hpp"

namespace berm::app {

JointWatch::JointWatch(const MachineModel& machine) : machine_(&machine) {
  for (std::size_t j = 0; j < joints; ++j) {
    const TwoWayResponse response = command_responses_of(machine, j, 0.0, 0.0);
    error_.emplace_back(response, machine.cycle);
    braking_.emplace_back(response, machine.cycle);
  }
}

void JointWatch::step(const Observation& o, const Task& task, const ProgressLog& log) {
  const double reach = reach_of(*machine_, o.angle);
  for (std::size_t j = 0; j < joints; ++j) {
    const TwoWayResponse response = command_responses_of(*machine_, j, reach, task.payload_kg);
    error_[j].step(response, o.commanded[j], o.angle[j], o.velocity[j], o.running() && task.free);
    if (!o.running() || !task.free) braking_[j].forget();
    if (!braking_[j].slows()) loaded_[j] = task.loaded;
    const auto goal = task.goals ? std::optional((*task.goals)[j]) : std::nullopt;
    auto braking = braking_[j].step(response, o.commanded[j], o.angle[j], o.velocity[j], goal);
    if (braking && !machine_->responses) braking->over_model = 0.0;  // what the machine file promises is a bound and no model: every joint runs beyond it
    if (!braking || !limits_.judge(j, loaded_[j], *braking)) continue;
    ++overruns_;
    log.event("overrun", {{"time_s", o.time_s}, {"joint", joint_names[j]}, {"direction", braking->positive ? "up" : "down"}, {"loaded", loaded_[j]},
                          {"speed_deg_s", degrees(braking->peak)}, {"over_goal_deg", degrees(braking->over_goal)}, {"over_model_deg", degrees(braking->over_model)},
                          {"pace", (braking->positive ? limits_.paces(loaded_[j]).up : limits_.paces(loaded_[j]).down)[j]}});
  }
}

Joints JointWatch::prediction_rms() const {
  Joints rms{};
  for (std::size_t j = 0; j < joints; ++j) rms[j] = error_[j].root_mean_square();
  return rms;
}

Joints JointWatch::prediction_largest() const {
  Joints largest{};
  for (std::size_t j = 0; j < joints; ++j) largest[j] = error_[j].largest();
  return largest;
}

}  // namespace berm::app
