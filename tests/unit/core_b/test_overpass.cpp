// The limits of the overpass rule, cell by cell, against the words of its header.
#include "core/overpass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <random>

#include "map_cells.hpp"

namespace berm::core_test {
namespace {

constexpr std::uint64_t kSeed = 41;

struct Rectangle {
  std::int32_t x_low, y_low, x_high, y_high;
};

template <typename Zone>
Rectangle of(const Zone& z) {
  return {z.x_low_mm, z.y_low_mm, z.x_high_mm, z.y_high_mm};
}

bool holds(const Rectangle& r, int iy, int ix) {
  return low_of_cell_mm(ix) >= r.x_low && low_of_cell_mm(ix + 1) <= r.x_high && low_of_cell_mm(iy) >= r.y_low && low_of_cell_mm(iy + 1) <= r.y_high;
}

bool meets(const Rectangle& r, int iy, int ix) {
  return !(low_of_cell_mm(ix) > r.x_high || low_of_cell_mm(ix + 1) < r.x_low || low_of_cell_mm(iy) > r.y_high || low_of_cell_mm(iy + 1) < r.y_low);
}

// Whether a top at z may be passed over, by the words alone.
bool may_pass(const berm_parameters& p, bool truck, int iy, int ix, int z) {
  bool ground = z <= p.pass_over_mm;
  for (int i = 0; i < p.ground_zones; ++i) ground = ground && (!meets(of(p.ground_zone[i]), iy, ix) || z <= p.ground_zone[i].pass_over_mm);
  bool zone = false;
  for (int i = 0; truck && i < p.truck_zones; ++i) zone = zone || (holds(of(p.truck_zone[i]), iy, ix) && z <= p.truck_zone[i].ceiling_mm);
  for (int i = 0; i < p.dig_zones; ++i) zone = zone || (holds(of(p.dig_zone[i]), iy, ix) && z <= p.dig_zone[i].ceiling_mm);
  return ground || zone;
}

class Overpass : public testing::Test {
 protected:
  void SetUp() override { p->pass_over_mm = 800; }
  void ground(const Rectangle& r, std::int32_t limit) { p->ground_zone[p->ground_zones++] = {r.x_low, r.y_low, r.x_high, r.y_high, limit}; }
  void truck(const Rectangle& r, std::int32_t ceiling) { p->truck_zone[p->truck_zones++] = {r.x_low, r.y_low, r.x_high, r.y_high, ceiling}; }
  void dig(const Rectangle& r, std::int32_t ceiling) { p->dig_zone[p->dig_zones++] = {r.x_low, r.y_low, r.x_high, r.y_high, -9000, ceiling}; }
  int at(int iy, int ix, bool admitted = false) {
    EXPECT_TRUE(sk_pass_limits(p.get(), admitted, rules.get()));
    return rules->pass_mm[iy][ix];
  }

  std::unique_ptr<berm_parameters> p = std::make_unique<berm_parameters>();
  std::unique_ptr<sk_clearance_rules> rules = std::make_unique<sk_clearance_rules>();
};

// verifies: SK-OP-1
TEST_F(Overpass, TheSitesLimitHoldsEverywhere) {
  EXPECT_EQ(at(0, 0), 800);
  EXPECT_EQ(at(103, 103, true), 800);
}

// A lower ground forbids: a cell that it touches with its border alone has its limit too, and the lowest of several counts.
// verifies: SK-OP-2
TEST_F(Overpass, LowerGroundLowersTheLimitOfEveryCellThatItMeets) {
  ground({300, 300, 600, 600}, -1400);  // cell (53, 53)
  for (int iy = 51; iy <= 55; ++iy)
    for (int ix = 51; ix <= 55; ++ix) EXPECT_EQ(at(iy, ix), iy >= 52 && iy <= 54 && ix >= 52 && ix <= 54 ? -1400 : 800) << iy << " " << ix;
  ground({-9000, -9000, 9000, 9000}, 2000);  // higher: no matter
  EXPECT_EQ(at(53, 53), -1400);
  EXPECT_EQ(at(60, 60), 800);
  ground({-9000, -9000, 9000, 9000}, -1500);
  EXPECT_EQ(at(53, 53), -1500);
}

// A truck zone permits: only while a truck is admitted, and only a cell that is wholly inside.
// verifies: SK-OP-3
TEST_F(Overpass, ATruckZoneCountsOnlyWhileATruckIsAdmitted) {
  ground({-3000, 0, 3000, 3000}, -1400);
  truck({0, 300, 900, 1200}, 1000);
  EXPECT_EQ(at(54, 53), -1400);
  EXPECT_EQ(at(54, 53, true), 1000);
  EXPECT_EQ(at(54, 51, true), -1400) << "beside it";
  EXPECT_EQ(at(54, 53), -1400) << "no longer admitted";
  const berm_truck_zone whole = p->truck_zone[0];
  for (std::int32_t berm_truck_zone::*edge : {&berm_truck_zone::x_low_mm, &berm_truck_zone::y_low_mm}) {
    p->truck_zone[0] = whole;
    p->truck_zone[0].*edge += 1;
    EXPECT_EQ(at(53, 52, true), -1400);
    EXPECT_EQ(at(54, 53, true), 1000);
  }
  for (std::int32_t berm_truck_zone::*edge : {&berm_truck_zone::x_high_mm, &berm_truck_zone::y_high_mm}) {
    p->truck_zone[0] = whole;
    p->truck_zone[0].*edge -= 1;
    EXPECT_EQ(at(55, 54, true), -1400);
    EXPECT_EQ(at(54, 53, true), 1000);
  }
}

// verifies: SK-OP-4
TEST_F(Overpass, SoilThatMayBeDugMayBePassedOver) {
  dig({300, 300, 900, 900}, 1100);
  EXPECT_EQ(at(53, 53), 1100);
  EXPECT_EQ(at(52, 53), 800);
  p->dig_zone[0].ceiling_mm = 500;  // it permits, it does not forbid
  EXPECT_EQ(at(53, 53), 800);
  dig({300, 300, 600, 600}, 1200);
  EXPECT_EQ(at(53, 53), 1200);
  EXPECT_EQ(at(54, 54), 800);
}

// verifies: SK-OP-5
TEST_F(Overpass, WhatTheParameterCheckRefusesIsRefusedUntouched) {
  rules->pass_mm[7][7] = 77;
  const auto was = std::make_unique<sk_clearance_rules>(*rules);
  const auto refused = [&](const auto& change) {
    berm_parameters bad = *p;
    change(bad);
    return !sk_pass_limits(&bad, true, rules.get()) && std::memcmp(was.get(), rules.get(), sizeof(sk_clearance_rules)) == 0;
  };
  for (const std::int32_t count : {-1, 5}) {
    EXPECT_TRUE(refused([&](berm_parameters& b) { b.ground_zones = count; }));
    EXPECT_TRUE(refused([&](berm_parameters& b) { b.truck_zones = count; }));
    EXPECT_TRUE(refused([&](berm_parameters& b) { b.dig_zones = count; }));
  }
  for (const std::int32_t height : {-20001, 20001}) {
    EXPECT_TRUE(refused([&](berm_parameters& b) { b.pass_over_mm = height; }));
    EXPECT_TRUE(refused([&](berm_parameters& b) { b.ground_zone[b.ground_zones++] = {0, 0, 1, 1, height}; }));
    EXPECT_TRUE(refused([&](berm_parameters& b) { b.truck_zone[b.truck_zones++] = {0, 0, 1, 1, height}; }));
    EXPECT_TRUE(refused([&](berm_parameters& b) { b.dig_zone[b.dig_zones++] = {0, 0, 1, 1, 0, height}; }));
  }
}

// verifies: SK-OP-1, SK-OP-2, SK-OP-3, SK-OP-4
TEST_F(Overpass, EveryCellOfDrawnZonesIsAsSaid) {
  std::mt19937_64 random(kSeed);
  const auto between = [&](int low, int high) { return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1)); };
  const auto drawn = [&] {
    const bool whole = between(0, 1) == 0;  // on the borders of cells
    const auto place = [&](int low, int high) { return whole ? between(low / 300, high / 300) * 300 : between(low, high); };
    const std::int32_t x = place(-15000, 14000), y = place(-15000, 14000);
    return Rectangle{x, y, std::min(15000, x + std::max(300, place(300, 12000))), std::min(15000, y + std::max(300, place(300, 12000)))};
  };
  for (int n = 0; n < 60; ++n) {
    *p = berm_parameters{};
    p->pass_over_mm = between(-20000, 20000);
    for (int k = between(0, 4); k > 0; --k) ground(drawn(), between(-20000, 20000));
    for (int k = between(0, 4); k > 0; --k) truck(drawn(), between(-20000, 20000));
    for (int k = between(0, 4); k > 0; --k) dig(drawn(), between(-20000, 20000));
    const bool admitted = between(0, 1) == 1;
    ASSERT_TRUE(sk_pass_limits(p.get(), admitted, rules.get()));
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
        const int limit = rules->pass_mm[iy][ix];
        ASSERT_TRUE(may_pass(*p, admitted, iy, ix, limit)) << "seed " << kSeed << " case " << n << " cell " << iy << " " << ix;
        ASSERT_FALSE(may_pass(*p, admitted, iy, ix, limit + 1)) << "seed " << kSeed << " case " << n << " cell " << iy << " " << ix;
      }
  }
}

}  // namespace
}  // namespace berm::core_test
