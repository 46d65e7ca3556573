#include "gathering/gather_recording.hpp"

#include <fmt/format.h>

#include <new>

#include "gathering/scan_frame.hpp"

namespace berm::app {

void RecordingPlayer::play_scanline(PointCloudGatherer& gatherer) {
  const std::vector<ScanPoint>& points = recording_->points;
  const Eigen::Vector3d origin(recording_->viewpoint[0], recording_->viewpoint[1], recording_->viewpoint[2]);
  const std::size_t begin = played_;
  std::size_t end = begin + 1;
  while (end < points.size() && points[end].scanline == points[begin].scanline) ++end;
  const std::span<const ScanPoint> scanline(points.data() + begin, end - begin);
  // The whole of a cloud without scanlines may look flat from its origin, and is no scan for that.
  const auto scan = recording_->scanlines ? fit_scan(scanline, origin, before_ ? &*before_ : nullptr) : std::nullopt;
  if (scan) {
    gatherer.add_scan(scanner_, mount_ * scan->frame, scan->returns, scanline.front().time_s);
    before_ = scan->frame;
  } else {
    ++unplanned_;
    gatherer.add_points(scanner_, mount_, origin, scanline, scanline.front().time_s);
  }
  played_ = end;
}

void play_together(std::span<RecordingPlayer> players, PointCloudGatherer& gatherer, const std::function<void(const RecordingPlayer&)>& progress) {
  while (true) {
    RecordingPlayer* next = nullptr;
    for (RecordingPlayer& player : players)
      if (!player.done() && (next == nullptr || player.time_s() < next->time_s())) next = &player;
    if (next == nullptr) return;
    try {
      next->play_scanline(gatherer);
    } catch (const std::bad_alloc&) {
      throw PointFileError(fmt::format("{}: memory: too little to gather point {} of {} beside {} that are kept (--capacity {})",
                                       next->recording().file, next->played() + 1, next->recording().points.size(), gatherer.store().size(),
                                       gatherer.store().capacity()));
    }
    if (progress) progress(*next);
  }
}

std::size_t gather_recording(const PointCloud& recording, std::size_t scanner, const Eigen::Isometry3d& mount, PointCloudGatherer& gatherer) {
  RecordingPlayer player(recording, scanner, mount);
  play_together({&player, 1}, gatherer);
  return player.unplanned();
}

}  // namespace berm::app
