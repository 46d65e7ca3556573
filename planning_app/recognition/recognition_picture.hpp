// A sweep from above with the opening that was recognised in it.
#pragma once

#include <string>

#include "recognition/truck_recogniser.hpp"

namespace berm::app {

// SVG: the points, coloured by height; the opening with its front side red and an ellipse of two standard deviations at each corner; or the reason
// why none was found. Throws PointFileError when the file cannot be written.
void write_recognition_picture(const std::string& path, const std::vector<ScanPoint>& points, const std::array<double, 3>& viewpoint,
                               const RecognisedTruck& truck);

}  // namespace berm::app
