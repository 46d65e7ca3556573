// What stands between a sensor and the site at one moment: dust in the air, and what lies on its window; or that it is silent, or stands still.
#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "plant/world/solids.hpp"

namespace berm::plant {

// Dust in a box of the world; extinction of one way, 1/m.
struct DustCloud { BoxSolid box; double extinction = 0.0; };

struct SensorAir {
  double dust = 0.0;     // probability of an additional echo
  double lost = 0.0;     // probability that the dust alone comes back
  bool covered = false;  // something lies on the window,
  std::array<double, 2> turn{0.0, 2 * std::numbers::pi};  // over this part of the sensor's turn
  bool silent = false;   // sends nothing
  bool stalled = false;  // a lidar's head stands, and it goes on sending
  std::vector<DustCloud> clouds;  // what samples with a waveform look through

  [[nodiscard]] bool dusty() const { return dust > 0.0 || lost > 0.0; }
  [[nodiscard]] bool covers(double turned) const { return covered && turned >= turn[0] && turned < turn[1]; }
};

}  // namespace berm::plant
