// A gathered cloud as a picture.
#pragma once

#include <string>
#include <vector>

#include "points/point_cloud.hpp"

namespace berm::app {

struct PictureView {
  double low_x = 0.0, low_y = 0.0, high_x = 0.0, high_y = 0.0;  // metres; empty: all but the outermost hundredth of the points
};

// Writes a PNG: the cloud from above (x to the right, y up), coloured by height, with a grid. Returns the grid's step in metres.
// Throws PointFileError.
double write_cloud_picture(const std::string& path, const std::vector<ScanPoint>& points, PictureView view = {});

}  // namespace berm::app
