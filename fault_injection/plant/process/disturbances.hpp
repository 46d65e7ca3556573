// When a scenario lets something be wrong with machine, sensors, air or base, or the operator intervenes: what a stop may be due to that is not
// the commander's own motion. People and vehicles are in the trace.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plant/process/scenario.hpp"

namespace berm::plant {

struct Disturbance {
  std::string what;
  double from_s;
  std::optional<double> to_s;  // none: for good
};

// In the order of the tables in FORMAT.md. A base motion that waits for a swing counts from its at_s.
std::vector<Disturbance> disturbances(const Scenario& scenario);

}  // namespace berm::plant
