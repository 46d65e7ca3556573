#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "perception/kernel_map.hpp"

namespace {

using namespace berm::app;

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

TEST(KernelMap, BeforeAnythingIsPublishedNothingMayBePassed) {
  const KernelMap map;
  EXPECT_TRUE(std::isinf(map.ground(KernelMap::Unseen::blocked)(5.0, 0.0)));
}

}  // namespace
