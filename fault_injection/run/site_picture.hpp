// The picture of a run: the site from above and in the swing plane from the side, with the kernel's height map, the swept volume of the fastest
// swing and the path of the bucket.
#pragma once

#include <string>
#include <vector>

#include "run/recorder.hpp"
#include "run/svg.hpp"

namespace berm::run {

struct MoverPath { std::string name; std::vector<Point2> points; };

struct SitePictureInput {
  std::string title;
  MapSnapshot map;
  SliceSnapshot swept;
  std::vector<BucketPoint> path;
  std::vector<StopEvent> stops;
  std::vector<MoverPath> movers;              // from the ground truth, for the reader only
  std::vector<std::vector<Point2>> dig_zones; // outlines, base frame
  std::vector<Point2> truck_bed;              // outline, as the app recognised the last one
  double dig_bearing_rad = 0.0, truck_bearing_rad = 0.0;  // the two profiles of the side view
  struct { double boom_pin_x, boom_pin_z, boom, stick, bucket; } arm{};
};

void write_site_picture(const std::string& path, const SitePictureInput& input);

}  // namespace berm::run
