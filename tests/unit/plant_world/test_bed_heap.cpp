#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plant/world/bed_heap.hpp"

namespace berm::plant {
namespace {

BedHeap bed() { return BedHeap(4.88, 2.44, 1.22, 0.08, 0.63); }

double settle_all(BedHeap& b, std::vector<Overflow>& over) {
  for (int i = 0; i < 2000 && !b.at_rest(); ++i) b.settle(1000, over);
  double out = 0;
  for (const Overflow& o : over) out += o.loose_volume;
  return out;
}

TEST(BedHeap, OneHeapRestsInTheMiddle) {
  BedHeap b = bed();
  std::vector<Overflow> over;
  b.deposit(0, 0, 1.2);
  EXPECT_EQ(settle_all(b, over), 0);
  EXPECT_NEAR(b.loose_volume(), 1.2, 1e-9);
  EXPECT_LT(b.centre_offset(), 0.06);
  EXPECT_LT(b.grid().highest(), 1.0);
  EXPECT_GT(b.grid().highest(), 0.6);
}

TEST(BedHeap, OffsetAndEvennessAreWhatTheyAre) {
  BedHeap b = bed();
  EXPECT_EQ(b.centre_offset(), 0);
  EXPECT_EQ(b.height_stddev(), 0);
  for (int iy = 0; iy < b.count_y(); ++iy) {
    for (int ix = 0; ix < b.count_x(); ++ix) b.deposit(b.grid().centre_x(ix), b.grid().centre_y(iy), 0.5 * b.grid().cell_area());
  }
  EXPECT_NEAR(b.height_stddev(), 0, 1e-9);
  EXPECT_NEAR(b.centre_offset(), 0, 1e-9);
  BedHeap corner = bed();
  corner.deposit(2.0, 1.0, 0.01);
  EXPECT_NEAR(corner.centre_offset(), std::hypot(2.0, 1.0), 0.08);
}

TEST(BedHeap, TooMuchRunsOverTheWallsAndNothingIsLost) {
  BedHeap b = bed();
  std::vector<Overflow> over;
  b.deposit(0, 0.9, 6.0);
  const double out = settle_all(b, over);
  EXPECT_GT(out, 0.1);
  EXPECT_NEAR((b.loose_volume() + out) / 6.0, 1, 1e-6);
  EXPECT_TRUE(std::all_of(over.begin(), over.end(), [](const Overflow& o) { return std::abs(o.x) > 2.44 || std::abs(o.y) > 1.22; }));
}

TEST(BedHeap, FillsToTheWallsBeforeItRunsOver) {
  BedHeap b = bed();
  std::vector<Overflow> over;
  const double struck = 4.88 * 2.44 * 1.22;
  double out = 0;
  for (int pour = 0; pour < 90; ++pour) {
    b.deposit(-1.6 + 0.4 * (pour % 9), 0, 0.8 * struck / 90);
    out += settle_all(b, over);
  }
  EXPECT_EQ(out, 0);
  EXPECT_NEAR(b.loose_volume(), 0.8 * struck, 1e-9);
}

}  // namespace
}  // namespace berm::plant
