#include "planning/pass_search.hpp"

#include <algorithm>
#include <cmath>

#include "planning/pass_simulation.hpp"

namespace berm::app {

namespace {

constexpr double hover_lowest = 0.20, hover_step = 0.35;  // m over the bench's level, of the search
constexpr double lowers_after = 0.8;                       // at most, of where the arm reaches out over the dig
// s before the swing stands that the bucket begins to open: of one that is level nothing slides in the first half second; one that cannot be held level pours at once.
constexpr double soonest_lead = 1.0, soonest_lead_tilted = 0.5, latest_lead = 0.0, lead_step = 0.05;

}  // namespace

PassSearch::PassSearch(const ScriptSet& scripts, const MachineModel& machine, const Skyline& skyline, const PassTask& task, const PassPoses& poses)
    : scripts_(&scripts), machine_(machine), skyline_(skyline), task_(task), poses_(poses) {
  // It is there when the load slides. Far out, where the bucket cannot be held level, soil slides as soon as it opens.
  const bool level = forward(machine, poses.spill).bucket_attitude < attitude_rests;
  lead_ = level ? soonest_lead : soonest_lead_tilted;
  set_reach_over_bed();
  thresholds_.open_stick = poses.spill[stick] - (level ? radians(14.0) : radians(6.0));
  thresholds_.pour_bucket = poses.spill[bucket] + (attitude_pour - attitude_spill);
  const double rise = poses.carry[boom] - task.lifted_from[boom];
  thresholds_.fold_boom = task.lifted_from[boom] + 0.45 * std::max(0.0, rise);
}

// The bucket opens while the swing lands, and the stick is then at the spill point: the swing's last stretch is v = sqrt(2 a d).
void PassSearch::set_reach_over_bed() {
  const double reach = reach_of(machine_, poses_.carry);
  const double brake = limits_of(machine_, swing, reach_of(machine_, poses_.spill)).deceleration;
  const auto way = [&](double seconds) { return 0.5 * brake * seconds * seconds; };
  const auto paced_time = [&](Joint joint) {
    JointResponse response = response_of(machine_, joint);
    response.velocity_max = scripts_->pass.pace_of(joint, RuleMark::extends) * limits_of(machine_, joint, reach).velocity;
    return time_to_reach(response, poses_.carry[joint], poses_.spill[joint]);
  };
  thresholds_.open_offset = std::clamp(way(lead_), radians(2.0), radians(14.0));
  thresholds_.extend_offset = std::clamp(way(lead_ + std::max(paced_time(stick), paced_time(boom))), radians(3.0), radians(45.0));
}

void PassSearch::step() {
  switch (stage_) {
    case Stage::swing_out: start_of_swing(); break;
    case Stage::sooner_out: sooner_swing(); break;
    case Stage::over_bed: reach_out_over_bed(); break;
    case Stage::swing_back: reach_out_over_dig(); break;
    case Stage::hover: hover_lower(); break;
    case Stage::lower: lower_sooner(); break;
    case Stage::done: break;
  }
}

void PassSearch::next(Stage stage) {
  stage_ = stage;
  candidate_ = 0;
}

// Candidates lie the closer the sooner the swing begins, for most are found clear soon.
void PassSearch::start_of_swing() {
  constexpr int candidates = 9;
  const double low = std::min(task_.lifted_from[boom] + radians(1.0), poses_.carry[boom] - radians(1.5));
  const double high = poses_.carry[boom] - radians(1.5);
  const double share = static_cast<double>(candidate_) / (candidates - 1);
  too_soon_ = candidate_ == 0 ? low : thresholds_.swing_start_boom;
  thresholds_.swing_start_boom = low + (high - low) * share * share;
  thresholds_.hover_offset = 0.0;
  clear_out_ = simulate(thresholds_).clear_out;
  if (clear_out_) {
    next(candidate_ > 0 ? Stage::sooner_out : Stage::over_bed);
  } else if (++candidate_ == candidates) {
    // Nothing is known of what comes after the lift.
    lead_ = latest_lead;
    set_reach_over_bed();
    next(Stage::swing_back);
  }
}

// Between the first candidate that is clear and the one before.
void PassSearch::sooner_swing() {
  constexpr int halvings = 3;
  PassThresholds sooner = thresholds_;
  sooner.swing_start_boom = 0.5 * (too_soon_ + thresholds_.swing_start_boom);
  if (simulate(sooner).clear_out) thresholds_ = sooner;
  else too_soon_ = sooner.swing_start_boom;
  if (++candidate_ == halvings) next(Stage::over_bed);
}

void PassSearch::reach_out_over_bed() {
  clear_over_bed_ = simulate(thresholds_).clear_over_bed;
  if (clear_over_bed_ || lead_ < latest_lead + 0.5 * lead_step) {
    next(Stage::swing_back);
    return;
  }
  lead_ -= lead_step;
  set_reach_over_bed();
}

void PassSearch::reach_out_over_dig() {
  constexpr int candidates = 10;
  constexpr double soonest = radians(50.0), share = 0.7;  // of the candidate before
  constexpr double latest_lower = radians(2.0);
  thresholds_.hover_offset = soonest * std::pow(share, candidate_);
  thresholds_.lower_offset = std::min(latest_lower, lowers_after * thresholds_.hover_offset);
  const Outcome outcome = simulate(thresholds_);
  const bool passes = outcome.clear_back && outcome.finished;
  if (!passes && ++candidate_ < candidates) return;
  clear_ = clear_out_ && clear_over_bed_ && passes;
  seconds_ = outcome.seconds;
  next(passes && task_.lower_at_end ? Stage::hover : Stage::done);
}

// The lowest that is clear.
void PassSearch::hover_lower() {
  const double above = hover_lowest + hover_step * candidate_++;
  if (above >= hover_highest) {
    next(Stage::lower);
    return;
  }
  const auto hover = hover_pose(machine_, task_, above);
  if (!hover) return;
  const PassPoses higher = poses_;
  poses_.hover = *hover;
  const Outcome outcome = simulate(thresholds_);
  if (outcome.clear_back && outcome.finished && outcome.seconds < seconds_) {
    seconds_ = outcome.seconds;
    next(Stage::lower);
  } else {
    poses_ = higher;
  }
}

// The soonest that is clear.
void PassSearch::lower_sooner() {
  constexpr double soonest = radians(20.0), share = 0.9;  // of the candidate before
  PassThresholds sooner = thresholds_;
  sooner.lower_offset = std::min(soonest, lowers_after * thresholds_.hover_offset) * std::pow(share, candidate_++);
  if (sooner.lower_offset <= thresholds_.lower_offset) {
    next(Stage::done);
    return;
  }
  const Outcome outcome = simulate(sooner);
  if (!outcome.clear_back || !outcome.finished || outcome.seconds >= seconds_) return;
  thresholds_ = sooner;
  seconds_ = outcome.seconds;
  next(Stage::done);
}

PassSearch::Outcome PassSearch::simulate(const PassThresholds& thresholds) const {
  constexpr double most_seconds = 30.0;
  constexpr double most_beyond_dig = radians(60.0);  // a stop may carry the swing past the dig only over ground that the scanners sweep
  const double side = task_.truck_bearing >= task_.next_bearing ? 1.0 : -1.0;
  Script script = pass_script(*scripts_, machine_, task_, poses_, thresholds);
  script.start();
  PassSimulation motion(machine_);
  motion.begin(script, ArmController(machine_), task_.lifted_from, {}, {machine_.bucket_payload_kg, task_.brake_empty, poses_.dump[bucket]});
  const bool only_out = stage_ <= Stage::over_bed;  // nothing is asked of the way back yet
  Outcome outcome;
  while (motion.seconds() < most_seconds) {
    motion.evaluate();
    if (motion.to_be_checked()) {
      const bool returning = motion.returns(), extends = motion.extends();
      const ReachIntervals box = motion.box();
      const double beyond = side > 0.0 ? task_.next_bearing - box.low[swing] : box.high[swing] - task_.next_bearing;
      if (motion.blocking(skyline_, box) || (returning && beyond > most_beyond_dig)) {
        (returning ? outcome.clear_back : extends ? outcome.clear_over_bed : outcome.clear_out) = false;
        if (!returning && only_out) return outcome;
      }
      if (only_out && (returning || (extends && stage_ != Stage::over_bed))) return outcome;
    }
    outcome.finished = !motion.advance();
    outcome.seconds = motion.seconds();
    if (outcome.finished) break;
  }
  return outcome;
}

}  // namespace berm::app
