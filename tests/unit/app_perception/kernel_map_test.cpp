#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "perception/kernel_map.hpp"
#include "single_stepped.hpp"

namespace {

using namespace berm::app;
namespace test = berm::test;

struct Published {
  Published() : at(std::make_unique<berm_state_segment>()) {
    std::memset(static_cast<void*>(at.get()), 0, sizeof *at);
    at->cell_mm = 300;
    at->map_origin_mm = -15600;
  }
  void cell(double x, double y, std::uint8_t status, std::int32_t height_mm) {
    const int ix = static_cast<int>(std::floor((x + 15.6) / 0.3)), iy = static_cast<int>(std::floor((y + 15.6) / 0.3));
    at->map_status[iy][ix] = status;
    at->map_height_mm[iy][ix] = height_mm;
  }
  std::unique_ptr<berm_state_segment> at;
};

// verifies: IF-CT-17 (a height that is UNKNOWN means nothing)
TEST(KernelMap, SaysWhatTheKernelWillCheck) {
  Published published;
  published.cell(5.0, 2.0, BERM_CELL_OBSERVED, 700);
  published.cell(6.0, 2.0, BERM_CELL_STALE, -400);
  published.cell(1.0, 1.0, BERM_CELL_OWN_BODY, 0);
  KernelMap map;
  map.take(*published.at);
  const Ground blocked = map.ground(KernelMap::Unseen::blocked), level = map.ground(KernelMap::Unseen::level);
  EXPECT_DOUBLE_EQ(blocked(5.0, 2.0), 0.7);
  EXPECT_DOUBLE_EQ(level(5.0, 2.0), 0.7);
  EXPECT_TRUE(std::isinf(blocked(6.0, 2.0)));   // stale
  EXPECT_DOUBLE_EQ(level(6.0, 2.0), -0.4);
  EXPECT_TRUE(std::isinf(blocked(8.0, -3.0)));  // never seen
  EXPECT_DOUBLE_EQ(level(8.0, -3.0), 0.0);
  EXPECT_DOUBLE_EQ(blocked(1.0, 1.0), 0.0);
  EXPECT_TRUE(std::isinf(blocked(16.0, 0.0)));  // out of the map
}

// The kernel writes a height, of which every byte differs, before each instruction of the reader.
// verifies: IF-CT-17 (a reader: each cell is one load)
TEST(KernelMap, ACellThatIsWrittenMeanwhileIsReadAsOne) {
  constexpr std::int32_t one = -0x01020304, other = 0x01020304;
  struct Seen {
    double level[2];
  };
  const auto segment = test::shared<berm_state_segment>();
  const auto seen = test::shared<Seen>();
  segment->cell_mm = 300;
  segment->map_origin_mm = -15600;
  std::int32_t* const written[2] = {&segment->map_height_mm[0][1], &segment->map_height_mm[1][0]};
  segment->map_status[0][1] = segment->map_status[1][0] = BERM_CELL_OBSERVED;
  KernelMap map;
  test::single_stepped(
      [&] {
        map.take(*segment);
        const Ground level = map.ground(KernelMap::Unseen::level);
        seen->level[0] = level(-15.15, -15.45);
        seen->level[1] = level(-15.45, -15.15);
      },
      [&](long step) {
        for (std::int32_t* const cell : written) __atomic_store_n(cell, step % 2 == 0 ? one : other, __ATOMIC_RELAXED);
      });
  for (const double level : seen->level) EXPECT_TRUE(level == one * 1e-3 || level == other * 1e-3) << level;
}

TEST(KernelMap, BeforeAnythingIsPublishedNothingMayBePassed) {
  const KernelMap map;
  EXPECT_TRUE(std::isinf(map.ground(KernelMap::Unseen::blocked)(5.0, 0.0)));
}

// Points on the cells' borders and beside them too, where a product by the side's reciprocal may fall to another cell than the quotient: never for
// the kernel's cells of 0.3 m, but for others.
TEST(CellGround, APointIsOfTheCellOfTheQuotientsFloor) {
  constexpr int side = 104;
  constexpr double origin = -15.6;
  std::vector<double> number(side * side);
  for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<double>(i);
  int otherwise = 0;
  for (const double cell : {0.3, 0.1, 0.7}) {
    const CellGround ground(cell, origin, side, number.data(), -1.0);
    const auto index = [&](double v) { return std::floor((v - origin) / cell); };
    const auto inside = [](double i) { return i >= 0 && i < side; };
    for (int i = -20; i <= side + 20; ++i) {
      const double border = i * cell + origin;
      for (const double x : {border, std::nextafter(border, 1e9), std::nextafter(border, -1e9), border + 1e-12, border - 1e-12, border + 0.09}) {
        const double y = origin + 4.5 * cell, ix = index(x);
        ASSERT_EQ(ground(x, y), inside(ix) ? 4 * side + ix : -1.0) << cell << ": " << x;
        ASSERT_EQ(ground(y, x), inside(ix) ? ix * side + 4 : -1.0) << cell << ": " << x;
        otherwise += std::floor((x - origin) * (1.0 / cell)) != ix ? 1 : 0;
      }
    }
    for (const double far : {1e9, -1e9, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
      EXPECT_EQ(ground(far, 0.0), -1.0) << far;
  }
  EXPECT_GT(otherwise, 20) << "the product alone would have done, so this tests nothing";
}

}  // namespace
