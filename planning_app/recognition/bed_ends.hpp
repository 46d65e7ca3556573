// The ends of a bed along a strip: with its sides, height and direction given, what every pair of ends would make of the rays, all at once.
// Each ray says the same for a whole rectangle of pairs (rear end, front end), so all its statements are corners of rectangles, and one running sum
// over a table weighs all pairs (Crow, 1984, summed-area tables, used backwards). The weights are those of bed_model.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "recognition/packed_rays.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

// Strip of the plane of the tops between two side walls of unknown length; its frame is that of the bed. Metres, radians.
struct BedStrip {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // somewhere between the sides; the ends are looked for within kEndReach
  double yaw = 0.0, pitch = 0.0, roll = 0.0;
  double width = 0.0, thickness = 0.0;               // inside; of the walls
  double slack = 0.0;                                // of the height: rays so near below the tops contradict nothing
  bool from_cab = false;                             // u = 0 is the front of a cab, the bed behind it, towards -u
};
constexpr double kEndReach = 7.5;

struct BedEnds {
  BedPose pose;
  int cab_end = 0;       // 1: the cab stands at +u
  double bed = 0.0, cab = 0.0;  // evidence, in rays
};

// The best pairs of ends, the best first, at most `most`, each apart from the others by 0.2 m at an end or more. lengths: of the bed, inside, m.
// share: rays that each given ray stands for.
std::vector<BedEnds> best_ends(const BedStrip& strip, const PackedRays& rays, const SizeRange& lengths, double share, std::size_t most);

}  // namespace berm::app
