// Every coordinate that can be drawn on, and beyond; every cell and its neighbours.
#include <gtest/gtest.h>

#include "map_cells.hpp"

namespace berm::core_test {

// verifies: SK-HM-2
TEST(MapIndex, EveryCoordinate) {
  int index = -82, left = 100;  // the next cell begins at -39900
  ASSERT_EQ(low_of_cell_mm(index), -40200);
  for (int v = -40000; v <= 40000; ++v) {
    ASSERT_EQ(sk_map_index(v), index) << v;
    if (--left == 0) {
      ++index;
      left = 300;
    }
  }
}

// verifies: SK-HM-3, SK-HM-4, SK-HM-9
TEST(MapIndex, EveryCellIsAPlaceOfItsOwn) {
  const auto map = cleared_map();
  for (int iy = -3; iy < SK_MAP_CELLS + 3; ++iy)
    for (int ix = -3; ix < SK_MAP_CELLS + 3; ++ix) {
      const bool inside = iy >= 0 && iy < SK_MAP_CELLS && ix >= 0 && ix < SK_MAP_CELLS;
      ASSERT_EQ(sk_map_insert(map.get(), iy, ix, 100 * iy + ix, 1000 + iy, 1), inside) << iy << " " << ix;
    }
  for (int iy = -3; iy < SK_MAP_CELLS + 3; ++iy)
    for (int ix = -3; ix < SK_MAP_CELLS + 3; ++ix) {
      const bool inside = iy >= 0 && iy < SK_MAP_CELLS && ix >= 0 && ix < SK_MAP_CELLS;
      ASSERT_EQ(sk_map_top(map.get(), iy, ix), inside ? 100 * iy + ix : 20000) << iy << " " << ix;
      if (!inside) continue;
      ASSERT_EQ(cell_of(*map, iy, ix), (Cell{100 * iy + ix, 100 * iy + ix, 1000 + iy, 1000 + iy}));
    }
}

}  // namespace berm::core_test
