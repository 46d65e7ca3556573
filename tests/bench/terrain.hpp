// The ground under the motion, made from the lowest the implements pass over each cell, so that the kind of motion is what its name says.
#pragma once

#include <cstdint>
#include <vector>

#include "config/parameter_block.h"

namespace berm::bench {

enum class Kind { kFree, kNear, kGrazing, kMiddle, kAll };
inline constexpr Kind kKinds[] = {Kind::kFree, Kind::kNear, Kind::kGrazing, Kind::kMiddle, Kind::kAll};
const char* name_of(Kind kind);

// Heights of cells in mm, [iy * cells + ix].
std::vector<std::int32_t> terrain(Kind kind, const berm_parameters& parameters, int cells, int cell_mm);

}  // namespace berm::bench
