// What the machine's own implements hide stays in the map.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "io/own_shadow.hpp"

namespace berm::kernel {
namespace {

constexpr std::int64_t kNow = 1'000'000'000;
constexpr std::int32_t kGeneration = 1'000'000;
constexpr std::int32_t kThingMm = 1500;
constexpr sk_point kHead = {0, 0, 3300};
constexpr sk_point kBucket = {4000, 100, 2000};  // the beam falls by 0.325 m a metre

struct Place {
  std::int32_t iy, ix;
};
Place cell_of(std::int32_t x_mm, std::int32_t y_mm) { return {sk_map_index(y_mm), sk_map_index(x_mm)}; }

class OwnShadowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    sk_map_clear(map.get());
    for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) sk_map_insert(map.get(), iy, ix, 0, kNow, kGeneration);
  }
  void put_thing(Place at) { sk_map_insert(map.get(), at.iy, at.ix, kThingMm, kNow, kGeneration); }
  std::int32_t top(Place at) const { return sk_map_top(map.get(), at.iy, at.ix); }
  // The ground round about is seen in sweep after sweep, the beam ends on the bucket each time.
  void sweeps(Place at, const sk_point& own, int scanner = 0) {
    for (int k = 1; k <= 5; ++k) {
      const std::int64_t now = kNow + k * kGeneration;
      sk_map_insert(map.get(), at.iy, at.ix, 0, now, kGeneration);
      shadow->keep(scanner, kHead, own, now, *map);
      sk_map_insert(map.get(), at.iy, at.ix, 0, now + 1, kGeneration);
    }
  }
  std::unique_ptr<sk_height_map> map = std::make_unique<sk_height_map>();
  std::unique_ptr<OwnShadow> shadow = std::make_unique<OwnShadow>(kGeneration);
};

// verifies: SK-CY-105
TEST_F(OwnShadowTest, WhatTheBeamWouldHaveMetIsKept) {
  const Place behind = cell_of(6000, 150);  // the beam is at 1.35 m there
  put_thing(behind);
  sweeps(behind, kBucket);
  EXPECT_EQ(top(behind), kThingMm);
  EXPECT_EQ(map->seen_us[behind.iy][behind.ix], kNow + 5 * kGeneration + 1);
}

// verifies: SK-CY-105
TEST_F(OwnShadowTest, WhatStandsElsewhereIsForgotten) {
  // Before the bucket; beside the beam; behind, but lower than the beam; beyond where the beam meets the ground.
  for (const Place at : {cell_of(3000, 150), cell_of(6000, 750), cell_of(4700, 150)}) {
    SetUp();
    put_thing(at);
    sweeps(at, kBucket);
    EXPECT_EQ(top(at), 0) << at.iy << ' ' << at.ix;
  }
}

// verifies: SK-CY-105
TEST_F(OwnShadowTest, NothingIsHiddenBelowTheGround) {
  const Place behind = cell_of(6000, 150);
  const sk_point low = {4000, 100, 400};  // the beam goes under in front of the cell
  for (const bool seen : {false, true}) {
    SetUp();
    put_thing(behind);
    for (int k = 1; k <= 5; ++k) {
      const std::int64_t now = kNow + k * kGeneration;
      if (seen) shadow->note_view(0, {6000, 150, 0}, now);
      sk_map_insert(map.get(), behind.iy, behind.ix, 0, now, kGeneration);
      shadow->keep(0, kHead, low, now, *map);
    }
    EXPECT_EQ(top(behind), seen ? 0 : kThingMm) << "where the ground is not known it may be deep";
  }
}

// Where the beam goes under seen ground it would have ended: the machine's feet hide nothing behind the crest of the bench that they stand on.
// verifies: SK-CY-105
TEST_F(OwnShadowTest, NothingIsHiddenBehindTheGroundThatTheBeamGoesUnder) {
  const Place behind = cell_of(6000, 150);
  const sk_point low = {4000, 100, 400};  // the beam enters the cell at 5 m 0.18 m under zero
  struct Case {
    const char* what;
    std::int32_t ground_mm;
    std::int64_t age_us;
    int scanner;
    bool kept;
  };
  for (const Case& c : {Case{"ground well over the beam", 500, 0, 0, false}, Case{"ground hardly over the beam", 100, 0, 0, true},
                        Case{"seen long ago", 500, 2 * kGeneration, 0, true}, Case{"seen by the other scanner only", 500, 0, 1, true}}) {
    SetUp();
    shadow = std::make_unique<OwnShadow>(kGeneration);
    put_thing(behind);
    for (int k = 1; k <= 5; ++k) {
      const std::int64_t now = kNow + k * kGeneration;
      shadow->note_view(c.scanner, {5000, 150, c.ground_mm}, now - c.age_us);
      sk_map_insert(map.get(), behind.iy, behind.ix, 0, now, kGeneration);
      shadow->keep(0, kHead, low, now, *map);
    }
    EXPECT_EQ(top(behind), c.kept ? kThingMm : 0) << c.what;
  }
}

// verifies: SK-CY-105
TEST_F(OwnShadowTest, AnotherScannersWordCountsWhereNothingIsInItsWay) {
  const Place behind = cell_of(6000, 150);
  enum class Other { sees_late, sees, is_hidden_too };
  for (const Other other : {Other::sees_late, Other::sees, Other::is_hidden_too}) {
    SetUp();
    shadow = std::make_unique<OwnShadow>(kGeneration);
    put_thing(behind);
    for (int k = 1; k <= 5; ++k) {
      const std::int64_t now = kNow + k * kGeneration;
      if (other == Other::sees_late) shadow->note_view(1, {6000, 150, 0}, now - kGeneration);
      else shadow->note_view(1, {6000, 150, 0}, now - 100'000);
      if (other == Other::is_hidden_too) shadow->keep(1, kHead, kBucket, now - 2 * kGeneration, *map);
      sk_map_insert(map.get(), behind.iy, behind.ix, 0, now, kGeneration);
      shadow->keep(0, kHead, kBucket, now, *map);
    }
    EXPECT_EQ(top(behind), other == Other::sees ? 0 : kThingMm) << static_cast<int>(other);
  }
}

// A cell never observed stays so, and no beam leads out of the map's arrays: under a sanitizer.
// verifies: SK-CY-105
TEST_F(OwnShadowTest, AnyBeamIsTaken) {
  constexpr std::uint64_t seed = 20261121;
  std::mt19937_64 random(seed);
  const auto draw = [&random](double most) { return static_cast<std::int32_t>(std::uniform_real_distribution<double>(-most, most)(random)); };
  sk_map_clear(map.get());
  for (int i = 0; i < 20000; ++i) {
    const sk_point head = {draw(30000), draw(30000), draw(20000)};
    const sk_point own = i % 10 == 0 ? head : sk_point{i % 7 == 0 ? head.x_mm : draw(30000), draw(30000), draw(20000)};
    shadow->keep(i % 3, head, own, kNow + i, *map);
  }
  for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) ASSERT_EQ(map->seen_us[iy][ix], -1) << "seed " << seed;
}

// Every cell that the beam crosses behind the own return is visited: against points along it.
// verifies: SK-CY-105
TEST_F(OwnShadowTest, NoCellOfTheBeamIsLeftOut) {
  constexpr std::uint64_t seed = 20261122;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-9000, 9000), height(500, 3200);
  for (int i = 0; i < 300; ++i) {
    const sk_point own = {static_cast<std::int32_t>(place(random)), static_cast<std::int32_t>(place(random)), static_cast<std::int32_t>(height(random))};
    const double x = own.x_mm - kHead.x_mm, y = own.y_mm - kHead.y_mm, z = own.z_mm - kHead.z_mm, ground = std::hypot(x, y);
    if (ground < 1000) continue;
    for (double along = 1.0; along < 8000.0; along += 37.0) {
      const double px = own.x_mm + x / ground * along, py = own.y_mm + y / ground * along, pz = own.z_mm + z / ground * along;
      const Place at = cell_of(static_cast<std::int32_t>(std::floor(px)), static_cast<std::int32_t>(std::floor(py)));
      if (at.iy < 0 || at.iy >= SK_MAP_CELLS || at.ix < 0 || at.ix >= SK_MAP_CELLS || pz < -7000) break;
      const std::int32_t thing = static_cast<std::int32_t>(pz) + 100;
      map->height_mm[at.iy][at.ix] = -20000;
      map->previous_mm[at.iy][at.ix] = thing;
      shadow->keep(0, kHead, own, kNow, *map);
      ASSERT_EQ(map->height_mm[at.iy][at.ix], thing) << "seed " << seed << ", beam " << i << ", " << along << " mm behind";
    }
  }
}

}  // namespace
}  // namespace berm::kernel
