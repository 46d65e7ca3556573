#include "gathering/gather_recording.hpp"

#include "gathering/scan_frame.hpp"

namespace berm::app {

std::size_t gather_recording(const PointCloud& recording, std::size_t scanner, const Eigen::Isometry3d& mount, PointCloudGatherer& gatherer,
                             const std::function<void(std::size_t)>& progress) {
  const Eigen::Vector3d origin(recording.viewpoint[0], recording.viewpoint[1], recording.viewpoint[2]);
  const std::vector<ScanPoint>& points = recording.points;
  std::optional<PlanarScan> before;
  std::size_t unplanned = 0;
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    while (end < points.size() && points[end].scanline == points[begin].scanline) ++end;
    const std::span<const ScanPoint> scanline(points.data() + begin, end - begin);
    // The whole of a cloud without scanlines may look flat from its origin, and is no scan for that.
    auto scan = recording.scanlines ? fit_scan(scanline, origin, before ? &before->frame : nullptr) : std::nullopt;
    if (scan) {
      gatherer.add_scan(scanner, mount * scan->frame, scan->returns, scanline.front().time_s);
      before = std::move(scan);
    } else {
      ++unplanned;
      gatherer.add_points(scanner, mount, origin, scanline, scanline.front().time_s);
    }
    begin = end;
    if (progress) progress(begin);
  }
  return unplanned;
}

}  // namespace berm::app
