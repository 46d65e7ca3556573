#include "perception/truck_sweep.hpp"

namespace berm::app {

void TruckSweep::begin(std::size_t scanner) {
  *this = {};
  scanner_ = scanner;
  recording_ = true;
}

void TruckSweep::take(const ScanlinePart& part) {
  if (!recording_ || part.scanner != scanner_) return;
  if (any_ && part.scanline != line_) {
    ++lines_;
    whole_ = points_.size();
  }
  any_ = true;
  if (swing_.size() <= lines_) swing_.push_back(part.swing);
  line_ = part.scanline;
  for (const ScanReturn& s : part.samples()) {
    if (points_.size() >= most_points) break;
    if (s.range <= 0.0) continue;
    ++returns_;
    several_ += s.several_echoes ? 1 : 0;
    if (s.own || s.lone) continue;
    points_.push_back({static_cast<float>(s.x), static_cast<float>(s.y), static_cast<float>(s.z), lines_, s.time_s});
    flagged_.push_back(s.several_echoes);
  }
  if (part.first_index + part.count == part.samples_per_revolution) whole_ = points_.size();  // it ends its turn of the mirror
}

}  // namespace berm::app
