// What the identification of step responses says: the machine file with its [response], the flat JSON object, the table for a person.
#pragma once

#include <string>
#include <vector>

#include "identify/measurement.hpp"
#include "identify/step_fit.hpp"

namespace berm::identify {

struct StepResult : Measurement {
  std::vector<double> reach_m;                      // of the poses in which the swing was tested
  std::array<std::array<StepFit, 2>, 4> fit;        // [joint][up, down]
  std::size_t records() const;
};

std::string step_provenance(const StepResult& result);
// The machine file at result.machine_path with [response] in the place of the one it had, or at its end. Throws std::runtime_error.
std::string step_machine_text(const StepResult& result);
std::string step_json_text(const StepResult& result, const config::MachineFile& machine);
std::string step_summary_text(const StepResult& result, const config::MachineFile& machine);

}  // namespace berm::identify
