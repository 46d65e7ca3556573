// One run of `berm load`: three processes, a recorder, an end.
#pragma once

#include "run/run_options.hpp"
#include "run/run_result.hpp"

namespace berm::run {

// Runs to the end and writes what --out asks for. Throws std::runtime_error when the run could not be made.
RunResult load_trucks(const RunOptions& options);

}  // namespace berm::run
