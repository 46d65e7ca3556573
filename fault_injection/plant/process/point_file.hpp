// Measured points from a Point Cloud Data file, version 0.7: FIELDS x y z of one F each, DATA ascii. Metres, the file's frame.
// Anything else is refused: the planning app's reader, which takes every kind of PCD, is not the plant's to use.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace berm::plant {

using MeasuredPoint = std::array<double, 3>;

// Throws ConfigError ("FILE: field: reason"): unreadable, another kind of PCD, a point that is no three numbers within a million metres, or not as
// many points as POINTS says.
std::vector<MeasuredPoint> read_point_file(const std::string& path);

}  // namespace berm::plant
