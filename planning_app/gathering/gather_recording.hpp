// Plays a recording into the gathering, scanline by scanline.
#pragma once

#include <functional>

#include "gathering/gatherer.hpp"
#include "points/point_cloud.hpp"

namespace berm::app {

// For orientations that are found from points, which waver by a degree or two where a scanline has few.
constexpr EpochRule kEpochRuleOfRecordings{5e-4, 0.035};

// mount: from the cloud's frame to the recording's. Scanlines that are no plane through the viewpoint (a cloud without scanlines, a single beam) are
// not looked along: each of their points is merged or kept, and nothing is deleted for them. progress(points done) is called now and then.
// Returns the number of such scanlines.
std::size_t gather_recording(const PointCloud& recording, std::size_t scanner, const Eigen::Isometry3d& mount, PointCloudGatherer& gatherer,
                             const std::function<void(std::size_t)>& progress = {});

}  // namespace berm::app
