// What stands between a sensor and the site at one moment: dust in the air, and what lies on its window.
#pragma once

#include <numbers>

namespace berm::plant {

struct SensorAir {
  double dust = 0.0;     // probability of an additional echo
  double lost = 0.0;     // probability that the dust alone comes back
  bool covered = false;  // something lies on the window, over this part of the sensor's turn:
  double from = 0.0, to = 2 * std::numbers::pi;

  [[nodiscard]] bool dusty() const { return dust > 0.0 || lost > 0.0; }
  [[nodiscard]] bool covers(double turned) const { return covered && turned >= from && turned < to; }
};

}  // namespace berm::plant
