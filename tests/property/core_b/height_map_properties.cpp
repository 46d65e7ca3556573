// Cells against the list of all that was ever inserted. A failure prints its seed (RC_PARAMS="seed=..." repeats it).
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "draw.hpp"
#include "map_cells.hpp"

namespace berm::core_test {
namespace {

struct Sweep {
  std::int64_t began_us;
  std::vector<std::int32_t> heights_mm;
};

// All that happened to one cell.
class History {
 public:
  void insert(std::int32_t z_mm, std::int64_t now_us, std::int32_t generation_us) {
    if (sweeps_.empty() || now_us - sweeps_.back().began_us >= generation_us) sweeps_.push_back({now_us, {}});
    sweeps_.back().heights_mm.push_back(std::clamp(z_mm, -20000, 20000));
    seen_us_ = now_us;
  }
  bool observed() const { return !sweeps_.empty(); }
  std::int64_t seen_us() const { return seen_us_; }
  std::int32_t top_mm() const {
    std::int32_t top = highest(sweeps_.back());
    if (sweeps_.size() > 1) top = std::max(top, highest(sweeps_[sweeps_.size() - 2]));
    return top;
  }

 private:
  static std::int32_t highest(const Sweep& s) { return *std::max_element(s.heights_mm.begin(), s.heights_mm.end()); }
  std::vector<Sweep> sweeps_;
  std::int64_t seen_us_ = -1;
};

}  // namespace

// verifies: SK-HM-4, SK-HM-8, SK-HM-9, SK-HM-10, SK-HM-11
TEST(HeightMapProperties, TopIsTheHighestOfTheNewestTwoSweeps) {
  EXPECT_TRUE(rc::check("top and stamp follow from what was inserted", [] {
    const auto map = cleared_map();
    constexpr int kSide = 3;  // neighbouring cells, at a drawn place
    const int iy0 = draw(0, SK_MAP_CELLS - kSide), ix0 = draw(0, SK_MAP_CELLS - kSide);
    History history[kSide][kSide];
    std::int64_t now_us = draw<std::int64_t>(0, 1'000'000);
    const std::int32_t generation_us = draw(1, 500'000);
    for (int i = 0; i < 150; ++i) {
      now_us = std::max<std::int64_t>(0, now_us + draw<std::int64_t>(chance(10) ? -100'000 : 0, 60'000));
      const int dy = draw(0, kSide - 1), dx = draw(0, kSide - 1);
      const std::int32_t z_mm = chance(5) ? *rc::gen::arbitrary<std::int32_t>() : draw(-25000, 25000);
      RC_ASSERT(sk_map_insert(map.get(), iy0 + dy, ix0 + dx, z_mm, now_us, generation_us));
      history[dy][dx].insert(z_mm, now_us, generation_us);
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          const History& h = history[y][x];
          RC_ASSERT(map->seen_us[iy0 + y][ix0 + x] == h.seen_us());
          RC_ASSERT(sk_map_top(map.get(), iy0 + y, ix0 + x) == (h.observed() ? h.top_mm() : 20000));
        }
    }
  }));
}

}  // namespace berm::core_test
