// One cell: every state over a small grid of times and heights, and every sequence of insertions.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "map_cells.hpp"

namespace berm::core_test {
namespace {

constexpr int kIy = 17, kIx = 90;

// The words of the requirements, case by case.
Cell after_insertion(const Cell& c, std::int32_t z_mm, std::int64_t now_us, std::int32_t generation_us) {
  if (c.seen_us < 0) return {z_mm, z_mm, now_us, now_us};
  if (now_us - c.began_us >= generation_us) return {z_mm, c.height_mm, now_us, now_us};
  return {std::max(c.height_mm, z_mm), c.previous_mm, c.began_us, now_us};
}

}  // namespace

// verifies: SK-HM-3, SK-HM-5, SK-HM-6, SK-HM-7, SK-HM-11
TEST(MapGenerations, EveryStateAndInsertion) {
  const auto map = cleared_map();
  const std::int32_t heights[] = {-20000, -1, 0, 7, 20000};
  long checked = 0;
  for (const std::int32_t height : heights)
    for (const std::int32_t previous : heights)
      for (std::int64_t began = 0; began <= 6; ++began)
        for (std::int64_t seen = -1; seen <= 6; ++seen)
          for (const std::int32_t z : heights)
            for (std::int64_t now = -1; now <= 7; ++now)
              for (std::int32_t generation = -1; generation <= 7; ++generation) {
                const Cell before{height, previous, began, seen};
                put(*map, kIy, kIx, before);
                const bool valid = now >= 0 && generation > 0;
                ASSERT_EQ(sk_map_insert(map.get(), kIy, kIx, z, now, generation), valid);
                ASSERT_EQ(cell_of(*map, kIy, kIx), valid ? after_insertion(before, z, now, generation) : before)
                    << before << "; z " << z << " now " << now << " generation " << generation;
                ++checked;
              }
  EXPECT_EQ(checked, 5 * 5 * 7 * 8 * 5 * 9 * 9);
}

namespace {

// Every sequence of insertions, the sweeps kept as lists.
class Sequences {
 public:
  Sequences(sk_height_map& map, std::int32_t generation_us) : map_(map), generation_us_(generation_us) {}

  void extend(int insertions) {
    if (insertions == 0) return;
    const Cell here = cell_of(map_, kIy, kIx);
    const auto sweeps = sweeps_;
    for (std::int64_t now = 0; now <= 5; ++now)
      for (std::int32_t z = 0; z <= 2; ++z) {
        put(map_, kIy, kIx, here);
        sweeps_ = sweeps;
        insert(z, now);
        if (testing::Test::HasFatalFailure()) return;
        extend(insertions - 1);
      }
    put(map_, kIy, kIx, here);
    sweeps_ = sweeps;
  }
  long checked() const { return checked_; }

 private:
  struct Sweep {
    std::int64_t began_us;
    std::int32_t highest_mm;
  };
  void insert(std::int32_t z_mm, std::int64_t now_us) {
    ASSERT_TRUE(sk_map_insert(&map_, kIy, kIx, z_mm, now_us, generation_us_));
    if (sweeps_.empty() || now_us >= sweeps_.back().began_us + generation_us_) sweeps_.push_back({now_us, z_mm});
    sweeps_.back().highest_mm = std::max(sweeps_.back().highest_mm, z_mm);
    const std::size_t n = sweeps_.size();
    const std::int32_t top = n > 1 ? std::max(sweeps_[n - 1].highest_mm, sweeps_[n - 2].highest_mm) : sweeps_[n - 1].highest_mm;
    ASSERT_EQ(sk_map_top(&map_, kIy, kIx), top);
    ASSERT_EQ(map_.seen_us[kIy][kIx], now_us);
    ++checked_;
  }
  sk_height_map& map_;
  std::int32_t generation_us_;
  std::vector<Sweep> sweeps_;
  long checked_ = 0;
};

}  // namespace

// verifies: SK-HM-10, SK-HM-11
TEST(MapGenerations, EverySequenceOfFourInsertions) {
  for (std::int32_t generation_us = 1; generation_us <= 4; ++generation_us) {
    const auto map = cleared_map();
    Sequences sequences(*map, generation_us);
    sequences.extend(4);
    EXPECT_EQ(sequences.checked(), 18 + 18 * 18 + 18 * 18 * 18 + 18 * 18 * 18 * 18);
  }
}

}  // namespace berm::core_test
