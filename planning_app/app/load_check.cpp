#include "app/load_check.hpp"

#include <algorithm>

#include "motion/angles.hpp"

namespace berm::app {

namespace {

constexpr double weighing_s = 0.5;                // five weighings
constexpr double settling_s = 0.7;                // what slides comes to rest
constexpr double blind_s = 6.0;                   // without a weighing: it has to go
constexpr double longest_s = 20.0;                // however it goes
constexpr double pause_s = 0.2;
constexpr double steepest = radians(-55.0);
constexpr double full_kg_per_rad = 900.0;         // about what a full bucket loses, by the scale of its load
constexpr double resting = radians(-163.0);       // before this tilt nothing slides
constexpr double closing_s = 1.2;                 // the tilt's time constant, above the weighing's delay
constexpr double slowest = radians(3.0), fastest = radians(25.0);
constexpr double under_way_s = 0.5;               // from the tilt to the weighing that shows what it let go

}  // namespace

void LoadCheck::begin(double time_s, bool needed) {
  lifted_ = -1.0;
  began_s_ = last_s_ = time_s;
  enter(needed ? Stage::blind : Stage::passed, time_s);
}

void LoadCheck::enter(Stage stage, double time_s) {
  stage_ = stage;
  stage_s_ = time_s;
  mean_.reset();
  recent_ = {};
}

double LoadCheck::step(const Lifted& now, const TruckFill& fill, const ProgressLog& log) {
  constexpr double nothing = -1.0;
  // While the kernel stops the machine nothing is asked here: that time does not count.
  if (const double gap = now.time_s - last_s_; gap > pause_s) {
    began_s_ += gap;
    stage_s_ += gap;
  }
  last_s_ = now.time_s;
  if (now.time_s - began_s_ > longest_s) enter(Stage::passed, now.time_s);
  const double since = now.time_s - stage_s_;
  bool again = false;
  switch (stage_) {
    case Stage::blind:
      if (now.payload_kg >= 0.0) enter(Stage::weighs, now.time_s);
      else if (since > blind_s) enter(Stage::passed, now.time_s);
      return nothing;
    case Stage::weighs:
      mean_.add(now.payload_kg);
      if (since < weighing_s || !mean_.known()) return nothing;
      lifted_ = mean_.kg();
      goal_ = fill.allowed_kg(lifted_, std::min(now.stays_kg, lifted_));
      if (goal_ < lifted_) log.event("trim", {{"time_s", now.time_s}, {"payload_kg", lifted_}, {"allowed_kg", goal_}, {"loaded_kg", fill.loaded_kg()}});
      enter(goal_ < lifted_ ? Stage::tilts : Stage::passed, now.time_s);
      return nothing;
    case Stage::tilts: {
      if (!now.raised) return nothing;
      recent_.add(now.payload_kg);
      const double kg_per_rad = full_kg_per_rad * load_scale_;
      const double excess = (recent_.kg() > 0.0 ? recent_.kg() : lifted_) - goal_;
      const double rate = now.attitude < resting ? fastest : std::clamp(excess / (kg_per_rad * closing_s), slowest, fastest);
      if (excess <= slowest * kg_per_rad * under_way_s || now.attitude > steepest) enter(Stage::settles, now.time_s);
      return stage_ == Stage::tilts ? rate : 0.0;
    }
    case Stage::settles:
      if (since > settling_s) mean_.add(now.payload_kg);
      if (since < settling_s + weighing_s || !mean_.known()) return 0.0;
      lifted_ = std::max(lifted_, mean_.kg());
      again = mean_.kg() - goal_ > fill.tolerance_kg() && now.attitude < steepest;
      enter(again ? Stage::tilts : Stage::passed, now.time_s);
      return 0.0;
    case Stage::passed: return nothing;
  }
  return nothing;
}

}  // namespace berm::app
