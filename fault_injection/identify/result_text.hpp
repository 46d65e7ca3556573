// What an identification says: the new machine file's text, the flat JSON object, the table for a person.
#pragma once

#include <string>

#include "identify/bounds.hpp"
#include "identify/measurement.hpp"

namespace berm::identify {

struct Result : Measurement {
  double allowance = 0.1;
  std::vector<std::size_t> joints, columns;
  double largest_state_gap_s = 0.0;
  int stops = 0;
  Bounds bounds;
};

// At most 200 characters; the same for the same input.
std::string provenance(const Result& result);
// The machine file at result.machine_path with what was measured put in its place. Throws std::runtime_error.
std::string machine_text(const Result& result, const config::MachineFile& machine);
std::string json_text(const Result& result, const config::MachineFile& machine);
std::string summary_text(const Result& result, const config::MachineFile& machine);

}  // namespace berm::identify
