// A whole identification of the joint models: the runs, the fits, the files.
#pragma once

#include "identify/identification.hpp"

namespace berm::identify {

// Of all joints; allowance, joints and columns of the options are not used. Throws std::exception with one line (run::ToldAlready with none) and then
// leaves no file behind.
void identify_steps(const Options& options);

}  // namespace berm::identify
