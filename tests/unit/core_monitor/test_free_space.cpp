// Free space, voxel by voxel, against a model that keeps sets.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "core/free_space.h"
#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

using Place = std::array<int, 3>;  // level, row, column

class FreeSpace : public testing::Test {
 protected:
  FreeSpace() { sk_space_begin(space.get()); }
  int flag(const Place& p) const { return space->voxel[p[0]][p[1]][p[2]]; }
  void pass(const Place& p) { sk_space_pass(space.get(), {p[0], p[1], p[2]}); }
  void pass_around(const Place& p) {
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) pass({p[0] + k, p[1] + j, p[2] + i});
  }
  bool returned(const Place& p, bool learning = false) { return sk_space_return(space.get(), {p[0], p[1], p[2]}, learning); }

  std::unique_ptr<sk_free_space> space = std::make_unique<sk_free_space>();
  std::unique_ptr<sk_monitor_rules> rules = monitor_rules(true);
  sk_monitor_cell where{};
};

// verifies: SK-FS-1
TEST_F(FreeSpace, AVoxelHoldsItsLowSideAndNotItsHighOne) {
  const auto of = [](double low, std::int32_t v) { return static_cast<int>(std::floor((v - low) / 150.0)); };
  for (const std::int32_t v : {-15600, -15451, -15450, -1, 0, 149, 150, 15599, 15600, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()}) {
    const sk_voxel voxel = sk_voxel_of(v, v, v);
    EXPECT_EQ(voxel.jx, of(-15600, v)) << v;
    EXPECT_EQ(voxel.jy, of(-15600, v)) << v;
    EXPECT_EQ(voxel.level, of(-5100, v)) << v;
  }
}

// verifies: SK-FS-2, SK-FS-3, SK-FS-4
TEST_F(FreeSpace, WhoStandsWhereARayHasPassedIsForeignUntilOnePassesAgain) {
  const Place p{30, 100, 101};
  EXPECT_EQ(flag(p), SK_VOXEL_UNKNOWN);
  pass_around(p);
  EXPECT_EQ(flag(p), SK_VOXEL_FREE);
  EXPECT_TRUE(returned(p));
  EXPECT_EQ(flag(p), SK_VOXEL_FOREIGN);
  EXPECT_EQ(space->foreign[50][50], 1);
  EXPECT_FALSE(returned(p)) << "counted once";
  EXPECT_EQ(space->foreign[50][50], 1);
  pass(p);
  EXPECT_EQ(flag(p), SK_VOXEL_FREE);
  EXPECT_EQ(space->foreign[50][50], 0);
}

// verifies: SK-FS-3
TEST_F(FreeSpace, ASurfaceIsSolidAndStaysSoWhenRaysGrazeIt) {
  const Place p{20, 60, 60};
  EXPECT_FALSE(returned(p));
  EXPECT_EQ(flag(p), SK_VOXEL_SOLID);
  pass(p);
  EXPECT_EQ(flag(p), SK_VOXEL_SOLID);
  EXPECT_FALSE(returned(p));
}

// A surface is in one voxel that rays have grazed, and before those that none has passed.
// verifies: SK-FS-3
TEST_F(FreeSpace, WhereOneVoxelAroundIsSolidOrUnknownNobodyIsForeign) {
  const Place p{30, 60, 60};
  for (const bool solid : {false, true})
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          if (k == 0 && j == 0 && i == 0) continue;
          sk_space_begin(space.get());
          const Place q{30 + k, 60 + j, 60 + i};
          if (solid) returned(q);
          for (int l = -1; l <= 1; ++l)
            for (int n = -1; n <= 1; ++n)
              for (int m = -1; m <= 1; ++m)
                if (Place{30 + l, 60 + n, 60 + m} != q) pass({30 + l, 60 + n, 60 + m});
          EXPECT_FALSE(returned(p)) << k << " " << j << " " << i;
          EXPECT_EQ(flag(p), SK_VOXEL_FREE);
          if (solid) continue;
          pass(q);
          EXPECT_TRUE(returned(p)) << k << " " << j << " " << i;
        }
  const Place rim{0, 60, 60};
  pass_around(rim);
  EXPECT_FALSE(returned(rim)) << "nothing is known of what lies outside";
}

// verifies: SK-FS-5
TEST_F(FreeSpace, WhatIsSeenWhileLearningIsSolid) {
  const Place p{30, 60, 60};
  pass(p);
  EXPECT_FALSE(returned(p, true));
  EXPECT_EQ(flag(p), SK_VOXEL_SOLID);
  const Place q{30, 80, 80};
  pass_around(q);
  EXPECT_TRUE(returned(q));
  EXPECT_FALSE(returned(q, true));
  EXPECT_EQ(flag(q), SK_VOXEL_SOLID);
  EXPECT_EQ(space->foreign[40][40], 0);
}

// verifies: SK-FS-7
TEST_F(FreeSpace, FoundIsACellOfTheRegionWithEnoughForeignVoxels) {
  const auto stands = [&](int jy, int jx, int voxels) {
    for (int k = 0; k < voxels; ++k) pass_around({20 + k, jy, jx});
    for (int k = 0; k < voxels; ++k) EXPECT_TRUE(returned({20 + k, jy, jx}));
  };
  stands(40, 40, 3);
  EXPECT_FALSE(sk_space_find(space.get(), rules.get(), 4, &where));
  EXPECT_EQ(where.iy, -1);
  EXPECT_TRUE(sk_space_find(space.get(), rules.get(), 3, &where));
  EXPECT_EQ(where.iy, 20);
  EXPECT_EQ(where.ix, 20);
  rules->watched[20][20] = 0;
  EXPECT_FALSE(sk_space_find(space.get(), rules.get(), 3, &where));
  stands(206, 206, 5);
  EXPECT_TRUE(sk_space_find(space.get(), rules.get(), 4, &where));
  EXPECT_EQ(where.iy, 103);
  EXPECT_EQ(where.ix, 103);
}

// verifies: SK-FS-1, SK-FS-6
TEST_F(FreeSpace, OutsideNothingChanges) {
  const auto before = std::make_unique<sk_free_space>(*space);
  constexpr int kLow = std::numeric_limits<std::int32_t>::min(), kHigh = std::numeric_limits<std::int32_t>::max();
  for (const int out : {kLow, -1, kHigh}) {
    for (const Place& p : {Place{out, 5, 5}, Place{5, out, 5}, Place{5, 5, out}}) {
      pass(p);
      EXPECT_FALSE(returned(p));
      EXPECT_FALSE(returned(p, true));
    }
    sk_space_forget(space.get(), out, 5);
    sk_space_forget(space.get(), 5, out);
  }
  for (const Place& p : {Place{64, 5, 5}, Place{5, 208, 5}, Place{5, 5, 208}}) {
    pass(p);
    EXPECT_FALSE(returned(p));
  }
  sk_space_forget(space.get(), 104, 0);
  sk_space_forget(space.get(), 0, 104);
  EXPECT_EQ(std::memcmp(space.get(), before.get(), sizeof *before), 0);
}

// verifies: SK-FS-2 to SK-FS-6
TEST_F(FreeSpace, AnySequenceAsTheModelOfSets) {
  constexpr unsigned kSeed = 20260103;
  std::mt19937 random(kSeed);
  std::set<Place> free, solid, foreign;
  const auto open_around = [&](const Place& p) {  // FOREIGN ones are in both sets
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          if (free.count({p[0] + k, p[1] + j, p[2] + i}) == 0) return false;
    return true;
  };
  int ever_foreign = 0;
  for (int n = 0; n < 300000; ++n) {
    const Place p{static_cast<int>(random() % 8), static_cast<int>(100 + random() % 8), static_cast<int>(random() % 8)};
    const auto what = static_cast<unsigned>(random() % 1000);
    if (what < 940) {
      pass(p);
      foreign.erase(p);
      if (solid.count(p) == 0) free.insert(p);
    } else if (what < 990) {
      const bool learning = what < 941;
      const bool unknown = free.count(p) + solid.count(p) == 0;
      const bool expected = !unknown && !learning && free.count(p) != 0 && foreign.count(p) == 0 && open_around(p);
      ASSERT_EQ(returned(p, learning), expected) << "seed " << kSeed << " step " << n;
      if (unknown || learning) {
        solid.insert(p);
        free.erase(p);
        foreign.erase(p);
      }
      if (expected) {
        foreign.insert(p);
        ++ever_foreign;
      }
    } else if (random() % 4 == 0) {
      const int iy = p[1] / 2, ix = p[2] / 2;
      sk_space_forget(space.get(), iy, ix);
      for (std::set<Place>* set : {&free, &solid, &foreign})
        for (auto it = set->begin(); it != set->end();) it = (*it)[1] / 2 == iy && (*it)[2] / 2 == ix ? set->erase(it) : std::next(it);
    }
    const int held = foreign.count(p) != 0 ? SK_VOXEL_FOREIGN : solid.count(p) != 0 ? SK_VOXEL_SOLID : free.count(p) != 0 ? SK_VOXEL_FREE : SK_VOXEL_UNKNOWN;
    ASSERT_EQ(flag(p), held) << "seed " << kSeed << " step " << n;
  }
  std::map<std::pair<int, int>, int> count;
  for (const Place& p : foreign) ++count[{p[1] / 2, p[2] / 2}];
  EXPECT_GT(ever_foreign, 300);
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) ASSERT_EQ(space->foreign[iy][ix], count.count({iy, ix}) != 0 ? count.at({iy, ix}) : 0) << iy << " " << ix;
}

}  // namespace
}  // namespace berm::core_test
