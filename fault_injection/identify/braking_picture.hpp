// The braking table as a picture: stop angle over speed, a panel a joint; what was measured as points, the bounds as steps, by reach.
#pragma once

#include <string>

#include "identify/result_text.hpp"

namespace berm::identify {

// Throws std::runtime_error naming the path.
void write_braking_picture(const std::string& path, const Result& result, const config::MachineFile& machine, const std::vector<BenchRecord>& runs);

}  // namespace berm::identify
