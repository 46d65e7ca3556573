#include "plant/process/horn_listener.hpp"

#include "contract/horn_signals.h"

namespace berm::plant {

namespace {
constexpr double kRounding = 1e-6;       // times are multiples of the cycle in floating point
constexpr double kForgotten_s = 2.0;     // silence after which a first group stands for nothing
}  // namespace

HornSignal HornListener::end_group() {
  const int blasts = blasts_;
  const bool second = asked_;
  blasts_ = 0;
  asked_ = !second && blasts == BERM_HORN_MOVE_BACK_BLASTS;
  if (!second || blasts < 1 || blasts > BERM_HORN_MOVE_BACK_STEPS) return {};
  return {HornSignal::What::move_back, blasts * BERM_HORN_MOVE_BACK_STEP_M};
}

HornSignal HornListener::step(double t, bool sounds) {
  HornSignal signal;
  if (sounds && !sounds_) {
    began_s_ = t;
    told_ = false;
  }
  if (sounds && !told_ && t - began_s_ + kRounding >= BERM_HORN_LONG_S) {
    told_ = true;
    blasts_ = 0;
    asked_ = false;
    signal.what = HornSignal::What::truck_full;
  }
  if (!sounds && sounds_) {
    fell_s_ = t;
    if (!told_) ++blasts_;
  }
  if (!sounds && blasts_ > 0 && t - fell_s_ + kRounding >= BERM_HORN_GROUP_END_S) signal = end_group();
  if (!sounds && asked_ && t - fell_s_ > kForgotten_s) asked_ = false;
  sounds_ = sounds;
  return signal;
}

}  // namespace berm::plant
