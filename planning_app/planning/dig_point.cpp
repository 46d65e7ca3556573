#include "planning/dig_point.hpp"

#include <algorithm>
#include <cmath>

#include "motion/joint_model.hpp"
#include "planning/dig_candidate.hpp"

namespace berm::app {

namespace {

constexpr double attack_usual = radians(-92.0);    // teeth down
constexpr double attacks[] = {attack_usual, radians(-84.0)};  // more curled its back would press on the soil that the teeth leave
constexpr double start_step = 0.4;                 // m
constexpr int starts = 3;
constexpr double likely = 1.05;                    // of the depth of the candidate before
constexpr double hopeless = 0.5;                   // s dearer than the cheapest so far: nearer starts are dearer still
constexpr double finer_step = 0.01;                // m deeper, where the steps of the dig itself show a little less than the model's longer ones
constexpr int finer_tries = 4;
constexpr double worth_a_search = 0.5;             // of the wanted volume: where the longest drag brings less no other brings it

// In seconds, as if the machine's power, and the passes that a lack of volume costs, were time.
double cost_of(const DigNeeds& needs, const DigPlan& plan) {
  constexpr double lack_s = 45.0;          // a bucket that is not full costs more than its share of a pass: the truck may need another
  constexpr double power = 60e3;           // W, at the bucket
  return lack_s * std::max(0.0, needs.volume - plan.volume) / needs.volume + plan.energy / power + plan.seconds;
}

double energy_of(const DigNeeds& needs, const DigOutcome& outcome) {
  constexpr double reference_depth = 0.5;  // m: the soil resists the more the deeper the cut
  return needs.effort * outcome.lifted / (needs.volume * reference_depth);
}

// The shallowest depth that brings the wanted volume, to a centimetre or two hundredths of it; or the deepest. From a guess on by false position, of which one end may not stay for good (Illinois).
struct Depth { double depth; DigOutcome outcome; int tried; };
std::optional<Depth> depth_for(const DigForwardModel& model, DigParameters dig, const DigNeeds& needs, double guess) {
  constexpr double to = 0.01, to_share = 0.02;   // m; of the wanted volume
  constexpr double coarse = 1.003;               // the model's steps are longer than those of the dig itself: so much more
  constexpr int most = 8;
  const double wanted = coarse * needs.volume;
  double low = 0.0, below = -wanted;
  dig.depth = std::min(guess, needs.deepest);
  auto outcome = model.outcome(dig);
  Depth found{dig.depth, {}, 1};
  if (outcome && outcome->volume < wanted && dig.depth < needs.deepest) {
    low = dig.depth, below = outcome->volume - wanted;
    found = {needs.deepest, {}, 2};
    dig.depth = needs.deepest;
    outcome = model.outcome(dig);
  }
  if (!outcome) return std::nullopt;
  found.outcome = *outcome;
  double high = found.depth, above = outcome->volume - wanted;
  bool was_high = false, was_low = false;
  while (above > 0.0 && high - low > to && found.outcome.volume > (1.0 + to_share) * wanted && found.tried < most) {
    dig.depth = std::clamp(low + (high - low) * -below / (above - below), low + 0.05 * (high - low), high - 0.05 * (high - low));
    outcome = model.outcome(dig);
    if (!outcome) return std::nullopt;
    ++found.tried;
    const double off = outcome->volume - wanted;
    if (off >= 0.0) {
      high = dig.depth, above = off, found.depth = dig.depth, found.outcome = *outcome;
      if (was_high) below *= 0.5;
    } else {
      low = dig.depth, below = off;
      if (was_low) above *= 0.5;
    }
    was_high = off >= 0.0, was_low = !was_high;
  }
  return found;
}

}  // namespace

DigPlan plan_dig(const MachineModel& machine, const SiteModel& site, const DigFloor& floor, const DigGround& ground, const DigNeeds& needs, const DigBounds& bounds) {
  const DigForwardModel model(machine, site, floor, ground, needs, bounds);
  const double farthest = std::min(bounds.farthest_start, site.dig_radius_start);
  const double nearest = std::min(farthest, bounds.nearest_start);
  const double swings = needs.dump_bearing ? wrapped(*needs.dump_bearing - bounds.bearing) : 0.0;
  const TwoWayResponse response = responses_of(machine, swing, farthest, needs.payload);
  const double swing_s = time_to_reach(swings > 0.0 ? response.up : response.down, 0.0, swings);
  DigPlan best;
  int tried = 0;
  const auto take = [&](const DigParameters& dig, const DigOutcome& outcome) {
    DigPlan plan;
    plan.bearing = bounds.bearing;
    plan.depth = dig.depth;
    plan.volume = outcome.volume;
    plan.start_radius = dig.start;
    plan.attack = dig.attack;
    plan.start_height = model.surface(dig.start);
    plan.energy = energy_of(needs, outcome);
    plan.seconds = outcome.seconds + swing_s;
    plan.cost = cost_of(needs, plan);
    const double cost = plan.cost;
    if ((!best.drag.empty() && cost >= best.cost) || (outcome.volume > 0.0 && !model.permitted(dig))) return cost;
    plan.drag = model.drag(dig);
    best = std::move(plan);
    return cost;
  };
  double guess = needs.deepest;
  bool goes_on = true;
  for (int k = 0; k < starts && goes_on; ++k) {
    const double start = farthest - k * start_step;
    if (k > 0 && start < nearest - 1e-9) break;
    double least = INFINITY;
    for (const double attack : attacks) {
      DigParameters dig{start, attack, needs.deepest};
      const auto depth = depth_for(model, dig, needs, guess);
      if (!depth) continue;
      tried += depth->tried;
      guess = likely * depth->depth;
      dig.depth = depth->depth;
      least = std::min(least, take(dig, depth->outcome));
      goes_on = depth->outcome.volume >= worth_a_search * needs.volume;
      if (!goes_on) break;
    }
    goes_on = goes_on && (best.drag.empty() || least < best.cost + hopeless);
  }
  if (best.drag.empty()) take({farthest, attack_usual, needs.deepest}, {});  // nothing is permitted: lacks all
  const bool enough = best.volume >= needs.volume;
  for (int k = 0; k < finer_tries; ++k) {
    const auto path = DigPath::solve(machine, best.drag);
    if (path && best.volume > 0.0) best.volume = model.volume(*path);
    if (!enough || best.volume >= needs.volume) break;
    best.depth += finer_step;
    best.drag = model.drag({best.start_radius, best.attack, best.depth});
  }
  best.candidates = tried;
  return best;
}

}  // namespace berm::app
