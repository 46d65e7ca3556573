// Keeps account of what the app's own guard slowed, and of how much of that for ground that was not seen, or too long ago: what the scanners owed it.
#pragma once

#include <optional>

#include "planning/skyline.hpp"

namespace berm::app {

class GuardAccount {
public:
  // A cycle in which the guard slowed a request; what stood in its way.
  void slowed(const std::optional<Skyline::Blocking>& by, double cycle_s) {
    seconds_ += cycle_s;
    if (by && by->unseen()) unseen_seconds_ += cycle_s;
  }
  double seconds() const { return seconds_; }
  double unseen_seconds() const { return unseen_seconds_; }

private:
  double seconds_ = 0.0, unseen_seconds_ = 0.0;
};

}  // namespace berm::app
