#include "map_cells.hpp"

#include <cstring>
#include <ostream>

namespace berm::core_test {

Cell cell_of(const sk_height_map& map, int iy, int ix) {
  return {map.height_mm[iy][ix], map.previous_mm[iy][ix], map.began_us[iy][ix], map.seen_us[iy][ix]};
}

void put(sk_height_map& map, int iy, int ix, const Cell& cell) {
  map.height_mm[iy][ix] = cell.height_mm;
  map.previous_mm[iy][ix] = cell.previous_mm;
  map.began_us[iy][ix] = cell.began_us;
  map.seen_us[iy][ix] = cell.seen_us;
}

bool operator==(const Cell& a, const Cell& b) {
  return a.height_mm == b.height_mm && a.previous_mm == b.previous_mm && a.began_us == b.began_us && a.seen_us == b.seen_us;
}

std::ostream& operator<<(std::ostream& out, const Cell& cell) {
  return out << "height " << cell.height_mm << " previous " << cell.previous_mm << " mm, began " << cell.began_us << " seen " << cell.seen_us << " us";
}

bool same(const sk_height_map& a, const sk_height_map& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

std::unique_ptr<sk_height_map> cleared_map() {
  auto map = std::make_unique<sk_height_map>();
  sk_map_clear(map.get());
  return map;
}

std::int64_t low_of_cell_mm(std::int64_t index) { return -15600 + 300 * index; }

}  // namespace berm::core_test
