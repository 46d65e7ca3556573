#include "app/reach_again.hpp"

#include <cmath>

namespace berm::app {

namespace {

constexpr double aside = radians(3.0);    // of the swing's goal; nearer it is over the bed as planned
constexpr double reached = radians(3.0);  // boom and stick

}  // namespace

void ReachAgain::resumed(const Script& script, const Joints& angle) {
  const bool goes = !script.of(swing).reached(RuleMark::returns);
  const bool reaches = script.of(stick).reached(RuleMark::extends) || script.of(boom).reached(RuleMark::extends) || script.of(bucket).reached(RuleMark::opens);
  state_ = goes && reaches && std::fabs(script.goals()[swing] - angle[swing]) > aside ? State::draws_in : State::none;
}

Joints ReachAgain::goals(const Joints& of_script, const Joints& carry, const Joints& angle, bool stands) {
  if (state_ == State::draws_in && stands) state_ = State::reaches_out;
  if (state_ == State::reaches_out && std::fabs(of_script[boom] - angle[boom]) < reached && std::fabs(of_script[stick] - angle[stick]) < reached) state_ = State::none;
  if (state_ == State::none) return of_script;
  Joints out = of_script;
  if (state_ == State::draws_in)
    for (const Joint j : {boom, stick}) out[j] = carry[j];
  out[bucket] = level_bucket(machine_, out[boom] + out[stick]);
  return out;
}

}  // namespace berm::app
