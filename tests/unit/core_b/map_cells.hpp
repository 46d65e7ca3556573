// Cells of a height map one by one.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "core/height_map.h"

namespace berm::core_test {

struct Cell {
  std::int32_t height_mm, previous_mm;
  std::int64_t began_us, seen_us;
};

Cell cell_of(const sk_height_map& map, int iy, int ix);
void put(sk_height_map& map, int iy, int ix, const Cell& cell);
bool operator==(const Cell& a, const Cell& b);
std::ostream& operator<<(std::ostream& out, const Cell& cell);

bool same(const sk_height_map& a, const sk_height_map& b);
std::unique_ptr<sk_height_map> cleared_map();
std::int64_t low_of_cell_mm(std::int64_t index);

}  // namespace berm::core_test
