// Putting scanlines into the map: ours with occlusion interpolation, a plain loop that does the same, and OctoMap's updateNode point by point.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/scanline_raster.h"

namespace berm::bench {

// Points of scanlines in the order they are measured; an empty place begins a new line.
struct Scan {
  std::vector<std::vector<sk_point>> line;
  std::size_t points() const;
};

// Over the heights given, as far as the map reaches: a turn of a VLP-16 (rings 2 degrees apart, 0.2 degrees of azimuth), or a sweep of a panning scanner (400
// samples a turn, 1.5 degrees of pan between lines), each above the cab.
enum class Scanner { kVlp16, kPanning };
Scan scan_of(Scanner scanner, const std::vector<std::int32_t>& heights_mm, int cells, int cell_mm);

class OurInsertion {
 public:
  OurInsertion();
  void run(const Scan& scan);
  const sk_height_map& map() const { return *map_; }

 private:
  std::unique_ptr<sk_height_map> map_;
  std::int64_t now_us_ = 0;
};

class PlainInsertion {
 public:
  PlainInsertion(int cells, int cell_mm);
  void run(const Scan& scan);
  float top(int iy, int ix) const;
  // Of each cell of the map that a segment crosses, as often as one does, its middle at the height it is raised to; line by line.
  Scan crossed(const Scan& scan) const;

 private:
  struct Cell {
    float height, previous;
    std::int64_t began_us, seen_us;
  };
  bool has(int iy, int ix) const { return iy >= 0 && ix >= 0 && iy < cells_ && ix < cells_; }
  void raise(int iy, int ix, float z);
  template <class Raise>
  void segment(const sk_point& p, const sk_point& q, const Raise& raise_cell) const;
  int cells_;
  float per_cell_, half_;
  std::int64_t now_us_ = 0;
  std::vector<Cell> cell_;
};

class OctoMapInsertion {
 public:
  explicit OctoMapInsertion(int cell_mm);
  ~OctoMapInsertion();
  void run(const Scan& scan);  // one voxel a point

 private:
  struct Inside;
  std::unique_ptr<Inside> in_;
};

}  // namespace berm::bench
