// Every segment between points on, beside and between cell borders, in the middle of the map and over its corners, against the segment cut by
// each cell in fractions.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/scanline_raster.h"
#include "map_cells.hpp"

namespace berm::core_test {
namespace {

constexpr std::int64_t kNow = 5'000'000;
constexpr std::int32_t kGeneration = 1'000'000;

// A fraction of the way; below > 0.
struct Fraction {
  std::int64_t above, below;
};
bool less(const Fraction& a, const Fraction& b) { return a.above * b.below < b.above * a.below; }

// The part of the way over an interval; none when from > to.
struct Part {
  Fraction from{0, 1}, to{1, 1};
  bool none() const { return less(to, from); }
  void cut(std::int64_t v0, std::int64_t v1, std::int64_t low, std::int64_t high) {
    if (v0 == v1) {
      if (v0 < low || v0 > high) to = {-1, 1};
      return;
    }
    const bool up = v1 > v0;
    const std::int64_t below = up ? v1 - v0 : v0 - v1;
    const Fraction first{up ? low - v0 : v0 - high, below}, last{up ? high - v0 : v0 - low, below};
    if (less(from, first)) from = first;
    if (less(last, to)) to = last;
  }
};

// Whether v is at least the height there; whether it is less than 1 mm above it.
bool at_least(std::int64_t v, const sk_point& p, const sk_point& q, const Fraction& t) {
  return v * t.below >= std::int64_t{p.z_mm} * t.below + std::int64_t{q.z_mm - p.z_mm} * t.above;
}
bool just_above(std::int64_t v, const sk_point& p, const sk_point& q, const Fraction& t) { return !at_least(v - 1, p, q, t); }

class RasterBorders : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  void SetUp() override {
    for (int k = -2; k <= 1; ++k) {  // the cells about the centre, as far as they are in the map, and a ring around them
      for (const auto& [centre, cells] : {std::pair{GetParam().first, &ix_}, std::pair{GetParam().second, &iy_}}) {
        const int index = (centre + 15600) / 300 + k;
        if (index >= 0 && index < SK_MAP_CELLS) cells->push_back(index);
      }
    }
  }

  void check(const sk_point& p, const sk_point& q) {
    const std::int32_t count = sk_raster_segment(map_.get(), &p, &q, kNow, kGeneration);
    std::int32_t raised = 0;
    for (const int iy : iy_)
      for (const int ix : ix_) {
        const Cell cell = cell_of(*map_, iy, ix);
        if (cell.seen_us == kNow) ++raised;
        check_cell(p, q, iy, ix, cell);
        put(*map_, iy, ix, {SK_HEIGHT_MAX_MM, SK_HEIGHT_MAX_MM, 0, -1});
      }
    ASSERT_EQ(count, raised) << "cells raised elsewhere, or counted twice";
  }

 private:
  void check_cell(const sk_point& p, const sk_point& q, int iy, int ix, const Cell& cell) const {
    const std::int64_t x = low_of_cell_mm(ix), y = low_of_cell_mm(iy);
    Part over;
    over.cut(p.x_mm, q.x_mm, x, x + 300);
    over.cut(p.y_mm, q.y_mm, y, y + 300);
    if (!over.none()) {
      ASSERT_EQ(cell.seen_us, kNow) << ix << " " << iy;
      ASSERT_TRUE(at_least(cell.height_mm, p, q, over.from) && at_least(cell.height_mm, p, q, over.to)) << ix << " " << iy << " " << cell;
    }
    if (cell.seen_us != kNow) return;
    // the part in the cell's column along the longer axis; the cell lies less than 1 mm beside it
    const bool along_x = std::abs(q.x_mm - p.x_mm) >= std::abs(q.y_mm - p.y_mm);
    Part column, beside;
    if (along_x) column.cut(p.x_mm, q.x_mm, x, x + 300);
    else column.cut(p.y_mm, q.y_mm, y, y + 300);
    ASSERT_FALSE(column.none()) << ix << " " << iy;
    beside = column;
    if (along_x) beside.cut(p.y_mm, q.y_mm, y - 1, y + 301);
    else beside.cut(p.x_mm, q.x_mm, x - 1, x + 301);
    ASSERT_TRUE(less(beside.from, beside.to) || (!beside.none() && !over.none())) << ix << " " << iy;
    ASSERT_TRUE(just_above(cell.height_mm, p, q, column.from) || just_above(cell.height_mm, p, q, column.to)) << ix << " " << iy << " " << cell;
    ASSERT_EQ(cell.previous_mm, cell.height_mm);
    ASSERT_EQ(cell.began_us, kNow);
  }

  std::unique_ptr<sk_height_map> map_ = cleared_map();
  std::vector<int> ix_, iy_;
};

// verifies: SK-RS-2, SK-RS-3, SK-RS-5, SK-RS-6, SK-RS-8, SK-RS-9
TEST_P(RasterBorders, EverySegment) {
  const int offsets[] = {-301, -300, -299, -137, -1, 0, 1, 150, 299, 300, 301};
  const int heights[][2] = {{7, 7}, {-5, 8}, {1000, -2000}};
  long segments = 0;
  for (const int px : offsets)
    for (const int py : offsets)
      for (const int qx : offsets)
        for (const int qy : offsets)
          for (const auto& z : heights) {
            const auto& [x, y] = GetParam();
            check({x + px, y + py, z[0]}, {x + qx, y + qy, z[1]});
            if (HasFatalFailure()) FAIL() << "from " << px << " " << py << " " << z[0] << " to " << qx << " " << qy << " " << z[1];
            ++segments;
          }
  EXPECT_EQ(segments, 11 * 11 * 11 * 11 * 3);
}

INSTANTIATE_TEST_SUITE_P(Places, RasterBorders,
                         testing::Values(std::pair{0, 0}, std::pair{-9000, 4500}, std::pair{15600, 15600}, std::pair{-15600, -15600},
                                         std::pair{15600, -300}));

}  // namespace
}  // namespace berm::core_test
