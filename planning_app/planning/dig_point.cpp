#include "planning/dig_point.hpp"

#include <algorithm>
#include <cmath>

#include "motion/joint_model.hpp"
#include "planning/dig_candidate.hpp"

namespace berm::app {

namespace {

constexpr double attack = radians(-92.0);  // teeth down
constexpr int depths = 128;                // steps down to the deepest, less than a centimetre each

// In seconds, as if the machine's power, and the passes that a lack of volume costs, were time.
double cost_of(const DigNeeds& needs, const DigPlan& plan) {
  constexpr double lack_s = 45.0;          // a bucket that is not full costs more than its share of a pass: the truck may need another
  constexpr double power = 60e3;           // W, at the bucket
  return lack_s * std::max(0.0, needs.volume - plan.volume) / needs.volume + plan.energy / power;
}

double energy_of(const DigNeeds& needs, double depth) {
  constexpr double reference_depth = 0.5;  // m: the soil resists the more the deeper the cut
  return needs.effort * depth / reference_depth;
}

// Loaded to where it will be dumped, and back empty.
double swing_seconds(const MachineModel& machine, const DigNeeds& needs, double bearing, double reach) {
  if (!needs.dump_bearing) return 0.0;
  const double way = wrapped(*needs.dump_bearing - bearing);
  const auto one_way = [&](double angle, double kg) {
    const TwoWayResponse response = responses_of(machine, swing, reach, kg);
    return time_to_reach(angle > 0.0 ? response.up : response.down, 0.0, angle);
  };
  return one_way(way, needs.payload) + one_way(-way, 0.0);
}

// Candidates of one region, one for each depth in steps.
class Depths {
public:
  Depths(const DigForwardModel& model, double start, double deepest) : model_(model), start_(start), deepest_(deepest) {}

  DigParameters at(int step) const { return {start_, attack, deepest_ * step / depths}; }
  // The shallowest that brings the volume, or the deepest: more depth brings more. By false position, of which one end may not stay for good (Illinois).
  int for_volume(double wanted) {
    int low = 0, high = depths;
    double below = -wanted, above = volume(high) - wanted;
    if (above <= 0.0) return high;
    bool was_high = false, was_low = false;
    while (high - low > 1) {
      const int step = std::clamp(low + static_cast<int>(std::lround((high - low) * -below / (above - below))), low + 1, high - 1);
      const double off = volume(step) - wanted;
      if (off >= 0.0) {
        high = step, above = off;
        if (was_high) below *= 0.5;
      } else {
        low = step, below = off;
        if (was_low) above *= 0.5;
      }
      was_high = off >= 0.0, was_low = !was_high;
    }
    return high;
  }
  // The deepest that is permitted, down to this one; 0 where none is.
  int permitted(int step) const {
    if (model_.permitted(at(step))) return step;
    int low = 0, high = step;
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      (model_.permitted(at(middle)) ? low : high) = middle;
    }
    return low;
  }
  int tried() const { return tried_; }

private:
  double volume(int step) {
    ++tried_;
    const auto outcome = model_.outcome(at(step));
    return outcome ? outcome->volume : 0.0;
  }

  const DigForwardModel& model_;
  double start_, deepest_;
  int tried_ = 0;
};

}  // namespace

DigPlan plan_dig(const MachineModel& machine, const SiteModel& site, const DigFloor& floor, const DigGround& ground, const DigNeeds& needs, const DigBounds& bounds) {
  const DigForwardModel model(machine, site, floor, ground, needs, bounds);
  Depths candidates(model, site.dig_radius_start, needs.deepest);
  const int step = candidates.permitted(candidates.for_volume(needs.volume));
  const DigParameters dig = candidates.at(step);
  const DigOutcome outcome = step > 0 ? model.outcome(dig).value_or(DigOutcome{}) : DigOutcome{};
  DigPlan plan;
  plan.bearing = bounds.bearing;
  plan.depth = dig.depth;
  plan.volume = outcome.volume;
  plan.start_height = model.surface(dig.start);
  plan.drag = model.drag(dig);
  plan.energy = energy_of(needs, dig.depth);
  plan.dig_seconds = outcome.seconds;
  plan.swing_seconds = swing_seconds(machine, needs, bounds.bearing, dig.start);
  plan.cost = cost_of(needs, plan);
  plan.candidates = candidates.tried();
  return plan;
}

}  // namespace berm::app
