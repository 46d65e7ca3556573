// What stands between a sensor and the site at one moment: dust in the air, and what lies on its window; or that it is silent.
#pragma once

#include <array>
#include <numbers>

namespace berm::plant {

struct SensorAir {
  double dust = 0.0;     // probability of an additional echo
  double lost = 0.0;     // probability that the dust alone comes back
  bool covered = false;  // something lies on the window,
  std::array<double, 2> turn{0.0, 2 * std::numbers::pi};  // over this part of the sensor's turn
  bool silent = false;   // sends nothing

  [[nodiscard]] bool dusty() const { return dust > 0.0 || lost > 0.0; }
  [[nodiscard]] bool covers(double turned) const { return covered && turned >= turn[0] && turned < turn[1]; }
};

}  // namespace berm::plant
