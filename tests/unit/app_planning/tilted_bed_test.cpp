// A truck on sloping ground: its load is what lies over its own floor, and its bed is passed over where its walls are highest.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "app_bench/bench_machine.hpp"
#include "planning/dump_point.hpp"

namespace {

using namespace berm::app;

// 3.4 degrees, by its rear and by its left side.
TruckBed tilted(double along, double across) {
  TruckBed bed = berm::app_bench::bench_bed();
  bed.zone_low = -bed.length;
  const double middle = bed.wall_top;
  bed.rise_along = along, bed.rise_across = across;
  bed.wall_top = middle + 0.5 * (std::fabs(along) * bed.length + std::fabs(across) * bed.width);
  return bed;
}

// What a scanner sees of a load height(u, v) over the floor, in the bed's own frame.
template <class Height>
BedMap seen(const TruckBed& bed, Height height) {
  BedMap map(bed);
  const double pitch = -std::atan(bed.rise_along), roll = std::atan(bed.rise_across * std::cos(pitch)), top = bed.top_at(0.0, 0.0);
  for (double u = -0.5 * bed.length + 0.02; u < 0.5 * bed.length; u += 0.04)
    for (double v = -0.5 * bed.width + 0.02; v < 0.5 * bed.width; v += 0.04) {
      const double w = height(u, v) - bed.height;
      // Rx(roll), then Ry(pitch).
      const double y = std::cos(roll) * v - std::sin(roll) * w, z = std::sin(roll) * v + std::cos(roll) * w;
      const double along = std::cos(pitch) * u + std::sin(pitch) * z, up = -std::sin(pitch) * u + std::cos(pitch) * z;
      double x_base = 0.0, y_base = 0.0;
      from_bed(bed, {along, y}, x_base, y_base);
      map.insert(x_base, y_base, top + up, 1.0);
    }
  return map;
}

constexpr std::pair<double, double> tilts[] = {{0.06, 0.0}, {-0.06, 0.0}, {0.0, 0.06}, {0.05, -0.05}};

TEST(TiltedBed, TheTopsAreHighestAtACornerAndTheMiddleLiesBetween) {
  for (const auto& [along, across] : tilts) {
    const TruckBed bed = tilted(along, across), level = tilted(0.0, 0.0);
    EXPECT_NEAR(bed.top_at(0.0, 0.0), level.wall_top, 1e-12);
    double highest = -1e9;
    for (const double u : {-0.5, 0.5})
      for (const double v : {-0.5, 0.5}) highest = std::fmax(highest, bed.top_at(u * bed.length, v * bed.width));
    EXPECT_NEAR(highest, bed.wall_top, 1e-12);
    EXPECT_GT(bed.wall_top, level.wall_top + 0.05);
  }
}

TEST(TiltedBed, TheLoadIsWhatLiesOverItsFloor) {
  for (const auto& [along, across] : tilts) {
    const TruckBed bed = tilted(along, across);
    const BedGrid grid = seen(bed, [](double u, double) { return u > 0.0 ? 0.6 : 0.3; }).seen(0.0);
    EXPECT_GT(grid.known_share(), 0.7);
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        if (!grid.known[grid.index(column, row)] || std::fabs(grid.u(column)) < 0.1) continue;
        EXPECT_NEAR(grid.height[grid.index(column, row)], grid.u(column) > 0.0 ? 0.6 : 0.3, 0.02) << along << ' ' << across << " at " << grid.u(column) << ' ' << grid.v(row);
      }
  }
}

// A metre over the walls there is soil, and none higher, wherever in the bed.
TEST(TiltedBed, WhatIsTooHighForAHeapIsSoByItsOwnWalls) {
  const TruckBed bed = tilted(0.06, 0.0);
  for (const double u : {-1.8, 1.8})
    for (const double over : {0.93, 1.07}) {
      BedMap map(bed);
      double x = 0.0, y = 0.0;
      from_bed(bed, {u, 0.0}, x, y);
      map.insert(x, y, bed.top_at(u, 0.0) + over, 1.0);
      EXPECT_EQ(map.seen(0.0).known_share() > 0.0, over < 1.0) << u << ' ' << over;
    }
}

TEST(TiltedBed, AnEvenLoadIsAsEvenAsInALevelBed) {
  const DumpNeeds needs{0.56, 0.0, 1500.0, 1500.0, 9000.0, std::numeric_limits<double>::infinity(), {}};
  const auto even = [](double, double) { return 0.4; };
  const DumpPoint level = choose_dump_point(seen(tilted(0.0, 0.0), even), needs);
  for (const auto& [along, across] : tilts) {
    const DumpPoint p = choose_dump_point(seen(tilted(along, across), even), needs);
    EXPECT_NEAR(p.at.u, level.at.u, 0.16) << along << ' ' << across;
    EXPECT_NEAR(p.at.v, level.at.v, 0.16) << along << ' ' << across;
  }
}

}  // namespace
