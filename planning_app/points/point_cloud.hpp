// Points of a recording in the order in which they were measured, and where they come from.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace berm::app {

// One return. Metres in the file's frame; scanline counts from 0 and never falls from one point of a file to the next; seconds of the file's own clock.
struct ScanPoint {
  float x, y, z;
  std::uint32_t scanline;
  double time_s;
};

// A recording as read, with its provenance. Every coordinate and time is finite.
struct PointCloud {
  std::vector<ScanPoint> points;
  std::string file;                          // as the reader was given it
  std::string format;                        // "pcd", "pcap" or "lms"
  bool scanlines = true;                     // false: the file says none, and all points bear the number 0
  bool times = true;                         // false: the file says none, and all points bear the time 0
  std::array<double, 3> viewpoint{0, 0, 0};  // the scanner's optical centre in the file's frame, metres
};

// What every reader throws: one line that names the file, the field and the limit that is not kept.
class PointFileError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

}  // namespace berm::app
