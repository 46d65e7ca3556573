#include "app/bench_move.hpp"

#include <cmath>

#include "contract/horn_signals.h"

namespace berm::app {

namespace {

constexpr double beat_s = BERM_HORN_SHORT_S + BERM_HORN_GAP_S;
constexpr double again_s = 30.0;  // after a whole signal

bool sounds_in_group(double since_s, int blasts) { return since_s >= 0.0 && since_s < blasts * beat_s && std::fmod(since_s, beat_s) < BERM_HORN_SHORT_S; }

}  // namespace

bool sounds_move_back(double since_s, double distance_m) {
  const double t = std::fmod(since_s, again_s);
  const double second_s = BERM_HORN_MOVE_BACK_BLASTS * beat_s + BERM_HORN_GROUP_GAP_S - BERM_HORN_GAP_S;
  return sounds_in_group(t, BERM_HORN_MOVE_BACK_BLASTS) || sounds_in_group(t - second_s, static_cast<int>(std::lround(distance_m / BERM_HORN_MOVE_BACK_STEP_M)));
}

}  // namespace berm::app
