// The receivers' own errors on hard targets in clear air, by range: what the trailing edge gives up.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "plant/process/world_config.hpp"

namespace berm::echoes {

struct ClearRow {
  double range_m = 0.0, reflectivity = 0.0;
  plant::Ranging ranging = plant::Ranging::last_pulse;
  double mean_m = 0.0, rms_m = 0.0;  // error of what is ranged
  double none = 0.0;                 // share without a return
};

// Square-on targets about each range, window of this transmission; pulses: for each row.
std::vector<ClearRow> clear_air(double window_percent, std::uint64_t seed, int pulses);
std::string text_of(const std::vector<ClearRow>& rows);
nlohmann::json json_of(const std::vector<ClearRow>& rows);

}  // namespace berm::echoes
