// For how long the guard has held a motion back: it cuts what is wanted, and nothing gets anywhere. Cut to nothing is not asked for: beside what blocks it the
// machine trembles in and out of the guard's margins.
#pragma once

#include "app/stillness.hpp"

namespace berm::app {

class HoldWatch {
public:
  static constexpr double gap = 0.5;        // s without a cut, after which nothing is held any more
  static constexpr double patience = 12.0;  // s; then it is for the kernel to decide, and what moves ends no hold

  // Once a cycle in which a motion is wanted; cut: the guard lets less of it out.
  void step(double time_s, const Joints& angle, bool cut);

  double seconds() const { return seconds_; }  // 0 where nothing is held
  bool given_up() const { return seconds_ > patience; }

private:
  Stillness still_;
  double cut_s_ = -1e9, seconds_ = 0.0;
};

}  // namespace berm::app
