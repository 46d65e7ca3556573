// Step responses as a picture: speed over time, a panel a joint and direction, measured and fitted, empty and loaded.
#pragma once

#include <string>
#include <vector>

#include "identify/step_run.hpp"
#include "identify/step_text.hpp"

namespace berm::identify {

// Of the first seed. Throws std::runtime_error naming the path.
void write_step_picture(const std::string& path, const StepResult& result, const config::MachineFile& machine, const std::vector<StepRun>& runs);

}  // namespace berm::identify
