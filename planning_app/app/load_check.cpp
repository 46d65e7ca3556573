#include "app/load_check.hpp"

#include <algorithm>

#include "motion/angles.hpp"

namespace berm::app {

namespace {

constexpr double weighing_s = 0.5;                // five weighings
constexpr double blind_s = 6.0;                   // from when it was up, without a weighing: the pressures have to do, and without them it has to go
constexpr double longest_s = 20.0;                // however it goes
constexpr double pause_s = 0.2;
constexpr double steepest = radians(-55.0);
constexpr double full_kg_per_rad = 900.0;         // about what a full bucket loses, by the scale of its load
constexpr double resting = radians(-163.0);       // before this tilt nothing slides
constexpr double full_kg = 1600.0, full_slides = radians(-158.0), empty_at = radians(-58.0);  // by the scale of the load, and evenly between: when it begins
constexpr double slides_sooner = radians(10.0);   // a soil that rests less steeply
constexpr double closing_s = 1.2, closes_fast_s = 1.0;  // the tilt's time constant, above the weighing's delay
constexpr double slowest = radians(3.0), fastest = radians(45.0), with_arm = radians(38.0);  // the last: the arm stays ahead of the bucket
constexpr double slides_kg = 40.0, not_yet = radians(15.0);  // by the scale of the load: less gone is noise, and a small load lies still up to a steep tilt
constexpr double under_way_s = 1.2;               // from the tilt to the weighing that shows what it let go, and what slides after it
constexpr double under_way_share = 0.004;         // of the truck's target, at most: it may not come, and in a small truck it would be missed

// Up to this tilt a load of so much lies still. In simulation it began to slide 3 degrees before the line at most (33 parts of 367 to 1604 kg, sandy clay).
double lies_still_until(double lifted_kg, double load_scale) {
  const double lacks = 1.0 - lifted_kg / (full_kg * load_scale);
  return std::max(resting, full_slides + lacks * (empty_at - full_slides) - slides_sooner);
}

// Of a load that has begun to slide; excess: what is still to go. fast: what goes on sliding when the tilt ends is little for this truck.
double sliding_rate(double excess_kg, double kg_per_rad, double slow, bool fast) {
  return std::clamp(excess_kg / (kg_per_rad * (fast ? closes_fast_s : closing_s)), slow, fast ? with_arm : fastest);
}

}  // namespace

void LoadCheck::begin(double time_s, bool needed) {
  lifted_ = -1.0;
  keeps_rest_ = false;
  began_s_ = last_s_ = time_s;
  enter(needed ? Stage::blind : Stage::passed, time_s);
}

void LoadCheck::enter(Stage stage, double time_s) {
  stage_ = stage;
  stage_s_ = time_s;
  mean_.reset();
  recent_ = {};
}

void LoadCheck::decide(double lifted_kg, const Lifted& now, const TruckFill& fill, const ProgressLog& log) {
  lifted_ = lifted_kg;
  rest_ = lifted_ - fill.allowed_kg(lifted_, std::min(now.stays_kg, lifted_));
  if (rest_ > 0.0) log.event("part", {{"time_s", now.time_s}, {"payload_kg", lifted_}, {"keeps_kg", rest_}, {"loaded_kg", fill.loaded_kg()}});
  enter(rest_ > 0.0 ? Stage::pours : Stage::passed, now.time_s);
}

double LoadCheck::step(const Lifted& now, const TruckFill& fill, const ProgressLog& log) {
  constexpr double nothing = -1.0;
  // While the kernel stops the machine nothing is asked here: that time does not count.
  if (const double gap = now.time_s - last_s_; gap > pause_s) {
    began_s_ += gap;
    stage_s_ += gap;
  }
  last_s_ = now.time_s;
  if (now.time_s - began_s_ > longest_s) {
    keeps_rest_ = keeps_rest_ || stage_ == Stage::pours;
    enter(Stage::passed, now.time_s);
  }
  const double since = now.time_s - stage_s_;
  switch (stage_) {
    case Stage::blind:
      if (now.payload_kg >= 0.0) enter(Stage::weighs, now.time_s);
      else if (now.lifts) began_s_ = stage_s_ = now.time_s;
      else if (since > blind_s && now.carried_kg >= 0.0) decide(now.carried_kg, now, fill, log);
      else if (since > blind_s) enter(Stage::passed, now.time_s);
      return nothing;
    case Stage::weighs:
      mean_.add(now.payload_kg);
      if (since < weighing_s || !mean_.known()) return nothing;
      decide(mean_.kg(), now, fill, log);
      return nothing;
    case Stage::pours: {
      if (!now.over_bed) return nothing;
      recent_.add(now.payload_kg >= 0.0 ? now.payload_kg : now.pressed_kg);
      const double kg_per_rad = full_kg_per_rad * load_scale_;
      const double still_in = recent_.kg() > 0.0 ? recent_.kg() : lifted_, rest = std::max(0.0, rest_ - now.beside_kg), excess = still_in - rest;
      const double slow = lifted_ - still_in < slides_kg * load_scale_ ? not_yet : slowest;
      const double under_way_kg = std::min(slowest * kg_per_rad * under_way_s, under_way_share * fill.target_kg());
      if (excess <= under_way_kg || now.attitude >= steepest) {
        keeps_rest_ = true;
        rest_ = rest;
        enter(Stage::passed, now.time_s);
        return nothing;
      }
      if (now.attitude < lies_still_until(lifted_, load_scale_)) return fastest;
      const bool fast = under_way_kg < under_way_share * fill.target_kg();  // not held to a small truck's share
      if (fast && now.attitude < lies_still_until(rest, load_scale_)) return with_arm;
      return sliding_rate(excess, kg_per_rad, slow, fast);
    }
    case Stage::passed: return nothing;
  }
  return nothing;
}

}  // namespace berm::app
