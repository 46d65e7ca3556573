// One sweep of one scanner, scanline by scanline, for the truck recogniser: the returns that are not from the machine itself and that something
// beside them supports. Those with several echoes are among them: the last one is the truck's mostly, and there is no second sweep to ask.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "perception/scanline_processor.hpp"
#include "points/point_cloud.hpp"

namespace berm::app {

class TruckSweep {
public:
  // From now on this scanner's scanlines are kept; what was kept before is forgotten.
  void begin(std::size_t scanner);
  void end() { recording_ = false; }
  // Of every scanner, in measuring order. Parts are taken until the sweep ends or most_points are kept.
  void take(const ScanlinePart& part);

  bool recording() const { return recording_; }
  // Of points, those of scanlines to which nothing will be added: all when the sweep has ended.
  std::size_t whole() const { return recording_ ? whole_ : points_.size(); }
  const std::vector<ScanPoint>& points() const { return points_; }  // base frame
  // Of a point's scanline: the machine's swing angle where the first of its points were measured.
  double swing_of(const ScanPoint& point) const { return swing_[point.scanline]; }
  bool flagged(std::size_t point) const { return flagged_[point]; }
  // Of the samples with a return, the share with an echo before the last: dust, or edges.
  double several_echoes() const { return returns_ == 0 ? 0.0 : static_cast<double>(several_) / static_cast<double>(returns_); }

  static constexpr std::size_t most_points = 200000;  // of 36,000 samples in a sweep of 3 s

private:
  bool recording_ = false;
  std::size_t scanner_ = 0;
  std::vector<ScanPoint> points_;
  std::vector<bool> flagged_;  // by point: an echo before the last
  std::vector<double> swing_;  // by scanline
  bool any_ = false;
  std::uint32_t line_ = 0, lines_ = 0;  // the scanner's number of the newest scanline; how many before it
  std::size_t whole_ = 0;
  std::size_t returns_ = 0, several_ = 0;
};

}  // namespace berm::app
