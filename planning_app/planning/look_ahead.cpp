#include "planning/look_ahead.hpp"

#include <algorithm>
#include <array>

namespace berm::app {

namespace {

constexpr std::array<PaceShares, 5> slower{{{0.75, 1.0}, {0.5, 1.0}, {0.25, 1.0}, {1.0, 0.5}, {0.5, 0.5}}};
constexpr PaceShares slowest_swing{0.25, 1.0}, standing_swing{0.0, 1.0};
constexpr int cycles_a_step = 125;    // of the simulation
// What is sooner no pace changes any more: dead time and lag. It is the guard's.
constexpr double guards_s = 0.3;
constexpr double after_block_s = 1.0, longest_s = 5.0;
// Plans are clear by Skyline::own_slack, and joints are off their models: what a plan loses of that is no block yet.
constexpr double alarm_slack = 0.0, proof_slack = 0.05;
constexpr double alarm_swing_off = radians(1.5);
constexpr double vain_pause_s = 0.5;
constexpr int sure = 2;               // looks in a row

}  // namespace

LookAhead::LookAhead(const MachineModel& machine, const ScriptSet& scripts) : machine_(&machine), scripts_(&scripts), simulation_(machine) { later_.reserve(16); }

void LookAhead::begin() {
  shares_ = {};
  stage_ = Stage::waits;
  blocked_looks_ = clear_looks_ = 0;
}

// So long that a block that is only put off is met: what is slowed comes to it later.
double LookAhead::proof_s(double share) const { return std::clamp(first_.seconds / share + after_block_s, ahead_s, longest_s); }

void LookAhead::simulate(const Now& now, const Script& script, const PaceShares& shares, const Demand& demand, Stage stage) {
  PassCourse course = now.course;
  course.shares = tried_ = shares;
  simulation_.begin(script, *now.arm, now.angle, now.velocity, course);
  demand_ = demand;
  stage_ = stage;
}

LookAhead::Judged LookAhead::go_on(const Now& now) {
  for (int k = 0; k < cycles_a_step; ++k) {
    if (simulation_.seconds() > demand_.to_s) return Judged::clear;
    simulation_.evaluate();
    if (simulation_.to_be_checked() && simulation_.seconds() >= demand_.from_s) {
      ReachIntervals box = simulation_.box();
      box.low[swing] += demand_.swing_off;
      box.high[swing] -= demand_.swing_off;
      if (const auto by = simulation_.blocking(*now.skyline, box, demand_.slack)) {
        found_ = {simulation_.seconds(), *by, now.pass != nullptr ? part_of(simulation_.script(), now.pass->task, now.pass->thresholds, simulation_.angle()[swing]) : PassPart::to_dig};
        return Judged::blocked;
      }
    }
    if (!simulation_.advance()) return Judged::clear;
  }
  return Judged::goes_on;
}

std::optional<LookAhead::Change> LookAhead::slow(const Now& now, const PaceShares& shares) {
  stage_ = Stage::waits;
  if (shares == shares_) return std::nullopt;
  if (!slows()) slows_from_s_ = now.time_s;
  shares_ = shares;
  return Change{Change::What::slowed, first_, {}};
}

// The next candidate: rules that wait longer, then slower paces.
void LookAhead::try_next(const Now& now) {
  ++candidate_;
  if (stage_ == Stage::tries_later && candidate_ < later_.size()) {
    Script script = *now.script;
    script.wait_as(pass_script(*scripts_, *machine_, now.pass->task, now.pass->poses, later_[candidate_].thresholds));
    simulate(now, script, shares_, {guards_s, proof_s(1.0), proof_slack, 0.0}, Stage::tries_later);
    return;
  }
  if (stage_ == Stage::tries_later) candidate_ = 0;
  // No faster than it goes already.
  while (candidate_ < slower.size() && (slower[candidate_].swing > shares_.swing || slower[candidate_].arm > shares_.arm || slower[candidate_] == shares_)) ++candidate_;
  if (candidate_ < slower.size())
    simulate(now, *now.script, slower[candidate_], {guards_s, proof_s(std::min(slower[candidate_].swing, slower[candidate_].arm)), proof_slack, 0.0}, Stage::tries_slower);
  else
    simulate(now, *now.script, standing_swing, {guards_s, ahead_s, alarm_slack, alarm_swing_off}, Stage::tries_standing);
}

std::optional<LookAhead::Change> LookAhead::judged(const Now& now, Judged found) {
  const bool clear = found == Judged::clear;
  switch (stage_) {
    case Stage::waits: break;
    case Stage::looks:
      blocked_looks_ = clear ? 0 : blocked_looks_ + 1;
      if (clear && slows()) {
        first_ = {};
        simulate(now, *now.script, {}, {guards_s, longest_s, proof_slack, 0.0}, Stage::tries_full);
      } else if (blocked_looks_ < sure) {
        stage_ = Stage::waits;
      } else {
        blocked_looks_ = clear_looks_ = 0;
        first_ = found_;
        later_.clear();
        if (now.pass != nullptr) later_rules(*now.script, now.pass->task, now.pass->thresholds, now.angle, found_.part, now.pass->poses.carry[boom], later_);
        candidate_ = static_cast<std::size_t>(-1);
        stage_ = Stage::tries_later;
        try_next(now);
      }
      break;
    case Stage::tries_later:
      if (clear) {
        stage_ = Stage::waits;
        return Change{Change::What::later, first_, later_[candidate_]};
      }
      try_next(now);
      break;
    case Stage::tries_slower:
      if (clear) return slow(now, tried_);
      try_next(now);
      break;
    case Stage::tries_standing:
      // It is met however slowly the swing comes; the slower, the more time there is to see it better. If it is met by a standing swing too no pace of it helps.
      if (clear) return slow(now, {std::min(shares_.swing, slowest_swing.swing), shares_.arm});
      stage_ = Stage::waits;
      next_s_ = now.time_s + vain_pause_s;
      break;
    case Stage::tries_full:
      clear_looks_ = clear ? clear_looks_ + 1 : 0;
      stage_ = Stage::waits;
      if (clear_looks_ >= sure) {
        begin();
        return Change{};
      }
      break;
  }
  return std::nullopt;
}

std::optional<LookAhead::Change> LookAhead::step(const Now& now) {
  if (stage_ == Stage::waits) {
    if (now.time_s < next_s_) return std::nullopt;
    next_s_ = now.time_s + period_s;
    simulate(now, *now.script, shares_, {guards_s, ahead_s, alarm_slack, alarm_swing_off}, Stage::looks);
  }
  const Judged found = go_on(now);
  return found == Judged::goes_on ? std::nullopt : judged(now, found);
}

}  // namespace berm::app
