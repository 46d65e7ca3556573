#include "planning/pass_simulation.hpp"

#include <cmath>

#include "motion/script_tempo.hpp"

namespace berm::app {

namespace {

constexpr double arrived = radians(1.0);
constexpr double emptying = 0.5;                   // s with the bucket open
constexpr double opened = radians(8.0);            // before the open bucket
constexpr double empties_before = radians(40.0);   // of the open bucket, when what is left no longer holds up the swing

}  // namespace

PassSimulation::PassSimulation(const MachineModel& machine)
    : machine_(&machine), arm_(machine), model_{arm_.model(swing), arm_.model(boom), arm_.model(stick), arm_.model(bucket)} {}

void PassSimulation::begin(const Script& script, const ArmController& arm, const Joints& angle, const Joints& velocity, const PassCourse& course) {
  script_ = script;
  arm_ = arm;
  course_ = course;
  angle_ = angle;
  velocity_ = velocity;
  for (std::size_t j = 0; j < joints; ++j) {
    model_[j] = arm_.model(j);
    model_[j].place(angle[j], velocity[j]);
  }
  open_s_ = 0.0;
  cycle_ = 0;
}

std::uint32_t PassSimulation::events() {
  const bool opens = script_.of(bucket).reached(RuleMark::opens), open = opens && angle_[bucket] > course_.dump_bucket - opened;
  open_s_ = open ? open_s_ + machine_->cycle : open_s_;
  const std::uint32_t pours = opens && angle_[bucket] > course_.dump_bucket - empties_before ? event_empties : event_none;
  return event_weighed | event_scanned | pours | (open_s_ >= emptying ? event_emptied : event_none);
}

void PassSimulation::evaluate() {
  const std::uint32_t happened = events();
  if (cycle_ % script_every == 0) script_.evaluate(angle_, happened);
  const bool empty = returns() || course_.carried_kg <= 0.0;
  arm_.brake_swing(empty ? course_.brake_empty : 0.0);
  const double carried_kg = empty ? 0.0 : course_.carried_kg;
  arm_.carries(carried_kg);
  if (cycle_ % script_every == 0)
    for (std::size_t j = 0; j < joints; ++j) model_[j].respond(responses_of(*machine_, j, reach_of(*machine_, angle_), carried_kg));
}

bool PassSimulation::advance() {
  const Joints goals = script_.goals();
  const Joints command = arm_.toward(goals, course_.shares.of(script_.paces()), tempos_of(script_, {course_.shares.swing, 1.0, 1.0, 1.0}), angle_, velocity_);
  arm_.sent(command);
  bool standing = script_.at_last();
  for (std::size_t j = 0; j < joints; ++j) {
    standing = standing && std::fabs(angle_[j] - goals[j]) < arrived && std::fabs(velocity_[j]) < radians(1.0);
    model_[j].advance(command[j]);
    angle_[j] = model_[j].angle();
    velocity_[j] = model_[j].velocity();
  }
  ++cycle_;
  return !standing;
}

std::optional<Skyline::Blocking> PassSimulation::blocking(const Skyline& skyline, const ReachIntervals& box, double slack) const {
  auto found = skyline.blocking(box, Skyline::Ranges::left_to_guard, slack);
  if (found && !extends() && found->what != Skyline::Blocking::What::ground) found.reset();
  return found;
}

}  // namespace berm::app
