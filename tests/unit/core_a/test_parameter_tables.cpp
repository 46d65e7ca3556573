// Braking tables, parts, dig zones.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/parameter_check.h"
#include "valid_parameters.hpp"

namespace berm::core_test {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();

class ParameterTables : public testing::Test {
 protected:
  std::int32_t check() const { return sk_parameters_check(&p); }
  const berm_parameters ok = valid_parameters();
  berm_parameters p = ok;
};

// verifies: SK-PC-20, SK-PC-21
TEST_F(ParameterTables, BrakeReaches) {
  for (int r = 0; r < BERM_BRAKE_REACHES; ++r) {
    for (const std::int32_t v : {r == 0 ? 0 : ok.brake_reach_mm[r - 1], kMin32, r + 1 == BERM_BRAKE_REACHES ? SK_COORD_MAX_MM + 1 : ok.brake_reach_mm[r + 1], kMax32}) {
      p = ok;
      p.brake_reach_mm[r] = v;
      EXPECT_EQ(check(), SK_RULE_BRAKE_REACH_ORDER) << "row " << r << " = " << v;
    }
  }
  p = ok;
  const std::int32_t total = ok.boom_pin_x_mm + ok.boom_length_mm + ok.stick_length_mm + ok.bucket_length_mm;
  p.brake_reach_mm[BERM_BRAKE_REACHES - 1] = total;
  EXPECT_EQ(check(), SK_RULE_NONE);
  p.brake_reach_mm[BERM_BRAKE_REACHES - 1] = total - 1;
  EXPECT_EQ(check(), SK_RULE_BRAKE_REACH_COVERS);
}

// Every entry of both tables: out of its range, below its neighbour at less speed, below its neighbour at less reach.
// verifies: SK-PC-22, SK-PC-23, SK-PC-24, SK-PC-25, SK-PC-26, SK-PC-27
TEST_F(ParameterTables, EveryBrakeEntry) {
  const auto push = [&](auto member, std::int32_t high, std::int32_t range, std::int32_t speed, std::int32_t reach) {
    for (int j = 0; j < 4; ++j) {
      for (int r = 0; r < BERM_BRAKE_REACHES; ++r) {
        for (int c = 0; c < BERM_BRAKE_SPEEDS; ++c) {
          const auto with = [&](std::int32_t v) {
            p = ok;
            (p.*member)[j][r][c] = v;
            return check();
          };
          SCOPED_TRACE(testing::Message() << "joint " << j << " row " << r << " column " << c);
          EXPECT_EQ(with(-1), range);
          EXPECT_EQ(with(kMin32), range);
          EXPECT_EQ(with(high + 1), range);
          EXPECT_EQ(with(kMax32), range);
          // the largest value allowed breaks a rise only if there is a later entry
          if (c + 1 < BERM_BRAKE_SPEEDS) {
            EXPECT_EQ(with(high), speed);
          } else if (r + 1 < BERM_BRAKE_REACHES) {
            EXPECT_EQ(with(high), reach);
          } else {
            EXPECT_EQ(with(high), SK_RULE_NONE);
          }
          if (c > 0) {
            const std::int32_t less_speed = (ok.*member)[j][r][c - 1];
            if (less_speed > 0) {
              EXPECT_EQ(with(less_speed - 1), speed);
            }
          }
          if (r > 0) {
            const std::int32_t less_reach = (ok.*member)[j][r - 1][c];
            const std::int32_t before = c > 0 ? (ok.*member)[j][r][c - 1] : 0;
            if (less_reach > before) {
              EXPECT_EQ(with(less_reach - 1), reach);
            }
          }
        }
      }
    }
  };
  push(&berm_parameters::brake_angle_urad, 6283186, SK_RULE_BRAKE_ANGLE_RANGE, SK_RULE_BRAKE_ANGLE_SPEED, SK_RULE_BRAKE_ANGLE_REACH);
  push(&berm_parameters::brake_time_us, 30000000, SK_RULE_BRAKE_TIME_RANGE, SK_RULE_BRAKE_TIME_SPEED, SK_RULE_BRAKE_TIME_REACH);
}

// verifies: SK-PC-29, SK-PC-30, SK-PC-31, SK-PC-32
TEST_F(ParameterTables, PartFields) {
  ASSERT_GE(ok.parts, 3);
  for (int i = 0; i < ok.parts; ++i) {
    SCOPED_TRACE(testing::Message() << "part " << i);
    for (const std::int32_t v : {0, 4, kMin32, kMax32}) {
      p = ok;
      p.part[i].link = v;
      EXPECT_EQ(check(), SK_RULE_PART_LINK);
    }
    for (const std::int32_t v : {0, 3001, kMin32, kMax32}) {
      p = ok;
      p.part[i].half_width_mm = v;
      EXPECT_EQ(check(), SK_RULE_PART_WIDTH);
    }
    for (const std::int32_t v : {2, BERM_PART_VERTICES + 1, kMin32, kMax32}) {
      p = ok;
      p.part[i].vertices = v;
      EXPECT_EQ(check(), SK_RULE_PART_VERTEX_COUNT);
    }
    for (int k = 0; k < ok.part[i].vertices; ++k) {
      for (int axis = 0; axis < 2; ++axis) {
        for (const std::int32_t v : {-15001, 15001, kMin32, kMax32}) {
          p = ok;
          p.part[i].vertex_mm[k][axis] = v;
          EXPECT_EQ(check(), SK_RULE_PART_VERTEX_RANGE) << "vertex " << k;
        }
      }
    }
  }
}

// verifies: SK-PC-28, SK-PC-46, SK-PC-63, SK-PC-66
TEST_F(ParameterTables, WhatIsNotCountedIsNotLookedAt) {
  const int last = ok.parts - 1;
  p.part[BERM_PARTS - 1] = {99, -1, 99, {}};
  p.parts = BERM_PARTS;
  EXPECT_EQ(check(), SK_RULE_PART_LINK);
  p.parts = last + 1;
  EXPECT_EQ(check(), last == BERM_PARTS - 1 ? SK_RULE_PART_LINK : SK_RULE_NONE);
  p = ok;
  p.dig_zones = 0;
  p.dig_zone[0] = {0, 0, -1, -1, kMax32, 0};
  EXPECT_EQ(check(), SK_RULE_NONE);
  p.ground_zones = p.truck_zones = 0;
  p.ground_zone[0] = {0, 0, -1, -1, kMax32};
  p.truck_zone[0] = {0, 0, -1, -1, kMax32};
  EXPECT_EQ(check(), SK_RULE_NONE);
}

// verifies: SK-PC-33
TEST_F(ParameterTables, OutlinesAreConvexAndCounterClockwise) {
  for (int i = 0; i < ok.parts; ++i) {
    SCOPED_TRACE(testing::Message() << "part " << i);
    const int n = ok.part[i].vertices;
    p = ok;
    std::reverse(p.part[i].vertex_mm, p.part[i].vertex_mm + n);
    EXPECT_EQ(check(), SK_RULE_PART_CONVEX) << "clockwise";
    for (int k = 0; k < n; ++k) {
      const int next = (k + 1) % n;
      p = ok;  // a vertex doubled
      for (int axis = 0; axis < 2; ++axis) p.part[i].vertex_mm[next][axis] = p.part[i].vertex_mm[k][axis];
      EXPECT_EQ(check(), SK_RULE_PART_CONVEX) << "doubled " << k;
      p = ok;  // two neighbours exchanged: the outline crosses itself
      for (int axis = 0; axis < 2; ++axis) std::swap(p.part[i].vertex_mm[next][axis], p.part[i].vertex_mm[k][axis]);
      EXPECT_EQ(check(), SK_RULE_PART_CONVEX) << "crossed " << k;
    }
  }
}

// All of its turns are to the left, and it winds twice.
// verifies: SK-PC-33
TEST_F(ParameterTables, APentagramIsNotConvex) {
  const std::int32_t star[5][2] = {{1000, 0}, {-809, 588}, {309, -951}, {309, 951}, {-809, -588}};
  p.part[0].vertices = 5;
  for (int k = 0; k < 5; ++k) std::copy(star[k], star[k] + 2, p.part[0].vertex_mm[k]);
  EXPECT_EQ(check(), SK_RULE_PART_CONVEX);
  const int around[] = {0, 3, 1, 4, 2};
  for (int k = 0; k < 5; ++k) std::copy(star[around[k]], star[around[k]] + 2, p.part[0].vertex_mm[k]);
  EXPECT_EQ(check(), SK_RULE_NONE);
}

// verifies: SK-PC-33
TEST_F(ParameterTables, StraightIsNotConvex) {
  const std::int32_t outline[4][2] = {{0, 0}, {100, 0}, {200, 0}, {100, 100}};
  p.part[0].vertices = 4;
  for (int k = 0; k < 4; ++k) std::copy(outline[k], outline[k] + 2, p.part[0].vertex_mm[k]);
  EXPECT_EQ(check(), SK_RULE_PART_CONVEX);
  p.part[0].vertex_mm[1][1] = -1;
  EXPECT_EQ(check(), SK_RULE_NONE);
}

// verifies: SK-PC-34
TEST_F(ParameterTables, EveryLinkHasAPart) {
  for (std::int32_t link = 1; link <= 3; ++link) {
    p = ok;
    for (berm_part& part : p.part) {
      if (part.link == link) part.link = link % 3 + 1;
    }
    EXPECT_EQ(check(), SK_RULE_PART_EVERY_LINK) << "no part for link " << link;
  }
}

// verifies: SK-PC-47, SK-PC-48
TEST_F(ParameterTables, DigZones) {
  for (int i = 0; i < BERM_DIG_ZONES; ++i) {
    SCOPED_TRACE(testing::Message() << "zone " << i);
    const auto with = [&](berm_dig_zone z) {
      p = ok;
      p.dig_zones = BERM_DIG_ZONES;
      for (berm_dig_zone& each : p.dig_zone) each = {-15000, -15000, 15000, 15000, -20000, 20000};
      p.dig_zone[i] = z;
      return check();
    };
    EXPECT_EQ(with({-1, -1, 0, 0, 19999, 20000}), SK_RULE_NONE);
    EXPECT_EQ(with({-15001, -1, 0, 0, 0, 1}), SK_RULE_DIG_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -15001, 0, 0, 0, 1}), SK_RULE_DIG_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -1, 15001, 0, 0, 1}), SK_RULE_DIG_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -1, 0, 15001, 0, 1}), SK_RULE_DIG_ZONE_BOUNDS);
    EXPECT_EQ(with({0, -1, 0, 0, 0, 1}), SK_RULE_DIG_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, 0, 0, 0, 0, 1}), SK_RULE_DIG_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -1, 0, 0, -20001, 0}), SK_RULE_DIG_ZONE_HEIGHTS);
    EXPECT_EQ(with({-1, -1, 0, 0, 20001, 20002}), SK_RULE_DIG_ZONE_HEIGHTS);
    EXPECT_EQ(with({-1, -1, 0, 0, 0, 20001}), SK_RULE_DIG_ZONE_HEIGHTS);
    EXPECT_EQ(with({-1, -1, 0, 0, 500, 500}), SK_RULE_DIG_ZONE_HEIGHTS);
  }
}

// verifies: SK-PC-64, SK-PC-65
TEST_F(ParameterTables, GroundZones) {
  for (int i = 0; i < BERM_GROUND_ZONES; ++i) {
    SCOPED_TRACE(testing::Message() << "zone " << i);
    const auto with = [&](berm_ground_zone z) {
      p = ok;
      p.ground_zones = BERM_GROUND_ZONES;
      for (berm_ground_zone& each : p.ground_zone) each = {-15000, -15000, 15000, 15000, -20000};
      p.ground_zone[i] = z;
      return check();
    };
    EXPECT_EQ(with({-1, -1, 0, 0, 20000}), SK_RULE_NONE);
    EXPECT_EQ(with({-15001, -1, 0, 0, 0}), SK_RULE_GROUND_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -15001, 0, 0, 0}), SK_RULE_GROUND_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -1, 15001, 0, 0}), SK_RULE_GROUND_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -1, 0, 15001, 0}), SK_RULE_GROUND_ZONE_BOUNDS);
    EXPECT_EQ(with({0, -1, 0, 0, 0}), SK_RULE_GROUND_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, 0, 0, 0, 0}), SK_RULE_GROUND_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -1, 0, 0, -20001}), SK_RULE_GROUND_ZONE_LIMIT);
    EXPECT_EQ(with({-1, -1, 0, 0, 20001}), SK_RULE_GROUND_ZONE_LIMIT);
  }
}

// verifies: SK-PC-67, SK-PC-68
TEST_F(ParameterTables, TruckZones) {
  for (int i = 0; i < BERM_TRUCK_ZONES; ++i) {
    SCOPED_TRACE(testing::Message() << "zone " << i);
    const auto with = [&](berm_truck_zone z) {
      p = ok;
      p.truck_zones = BERM_TRUCK_ZONES;
      for (berm_truck_zone& each : p.truck_zone) each = {-15000, -15000, 15000, 15000, -20000};
      p.truck_zone[i] = z;
      return check();
    };
    EXPECT_EQ(with({-1, -1, 0, 0, 20000}), SK_RULE_NONE);
    EXPECT_EQ(with({-15001, -1, 0, 0, 0}), SK_RULE_TRUCK_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -15001, 0, 0, 0}), SK_RULE_TRUCK_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -1, 15001, 0, 0}), SK_RULE_TRUCK_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -1, 0, 15001, 0}), SK_RULE_TRUCK_ZONE_BOUNDS);
    EXPECT_EQ(with({0, -1, 0, 0, 0}), SK_RULE_TRUCK_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, 0, 0, 0, 0}), SK_RULE_TRUCK_ZONE_BOUNDS);
    EXPECT_EQ(with({-1, -1, 0, 0, -20001}), SK_RULE_TRUCK_ZONE_CEILING);
    EXPECT_EQ(with({-1, -1, 0, 0, 20001}), SK_RULE_TRUCK_ZONE_CEILING);
  }
}

}  // namespace
}  // namespace berm::core_test
