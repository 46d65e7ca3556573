// Which recordings were made at the same time by one clock, and are played together.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "points/point_cloud.hpp"

namespace berm::app {

enum class ClockRule {
  kByTimes,  // as the recordings' times tell
  kOne,      // one clock made all times
  kOwn,      // each recording has its own
};

struct RecordingTimes {
  std::string file, format;
  bool times = false;  // the file says some, and has points
  double first_s = 0.0, last_s = 0.0;
};
RecordingTimes times_of(const PointCloud& recording);

// Groups of numbers of recordings, each in rising order; the groups by their first. By times: PCD files whose times overlap, in a chain or each with
// each. Not those without times, nor those that begin at 0, which counts from the file's own beginning; nor captures and LMS sessions, whose clocks
// begin anew every hour or at the scanner's start. Throws PointFileError when of kOne a file has no times.
std::vector<std::vector<std::size_t>> played_together(std::span<const RecordingTimes> recordings, ClockRule rule);

}  // namespace berm::app
