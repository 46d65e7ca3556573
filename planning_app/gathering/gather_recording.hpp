// Plays recordings into the gathering, scanline by scanline.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "gathering/gatherer.hpp"
#include "points/point_cloud.hpp"

namespace berm::app {

// For orientations that are found from points, which waver by a degree or two where a scanline has few.
constexpr EpochRule kEpochRuleOfRecordings{5e-4, 0.035};

// One recording, as far as it has been played; it must outlive this. Scanlines that are no plane through the viewpoint (a cloud without scanlines, a
// single beam) are not looked along: each of their points is merged or kept, and nothing is deleted for them.
class RecordingPlayer {
public:
  // mount: from the cloud's frame to the recording's.
  RecordingPlayer(const PointCloud& recording, std::size_t scanner, const Eigen::Isometry3d& mount)
      : recording_(&recording), scanner_(scanner), mount_(mount) {}

  bool done() const { return played_ == recording_->points.size(); }
  double time_s() const { return recording_->points[played_].time_s; }  // of the next scanline, when not done
  void play_scanline(PointCloudGatherer& gatherer);

  const PointCloud& recording() const { return *recording_; }
  std::size_t played() const { return played_; }        // points
  std::size_t unplanned() const { return unplanned_; }  // scanlines that are no plane

private:
  const PointCloud* recording_;
  std::size_t scanner_;
  Eigen::Isometry3d mount_;
  std::optional<Eigen::Isometry3d> before_;  // the frame of the last scanline that is a plane
  std::size_t played_ = 0, unplanned_ = 0;
};

// Plays all to their ends: always the scanline that comes first by its time, of equal times that of the first player; the scanlines of one recording
// stay in their order. progress(player) is called after each scanline. Throws PointFileError when memory is too small.
void play_together(std::span<RecordingPlayer> players, PointCloudGatherer& gatherer,
                   const std::function<void(const RecordingPlayer&)>& progress = {});

// The same for one recording; returns the number of scanlines that are no plane.
std::size_t gather_recording(const PointCloud& recording, std::size_t scanner, const Eigen::Isometry3d& mount, PointCloudGatherer& gatherer);

}  // namespace berm::app
