// The demonstration machine's parameter block, compiled from its files.
#pragma once

#include "config/parameter_block.h"

namespace berm::core_test {

berm_parameters valid_parameters();

}  // namespace berm::core_test
