// As Figures 6, 7 and 8 of stentz-1999: one scanline of both receivers in clear air and in dust, and the return of one pulse with its ranges.
#pragma once

#include <string>

#include "echoes/echo_stage.hpp"

namespace berm::echoes {

// SVG. Throws std::runtime_error naming the path.
void write_echo_picture(const std::string& path, const Stage& stage, const StageOptions& options, double extinction);

}  // namespace berm::echoes
