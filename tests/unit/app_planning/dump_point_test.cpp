// Evenness of the load, and what is done where the walls hide the bed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "app_bench/bench_machine.hpp"
#include "planning/dump_point.hpp"

namespace {

using namespace berm::app;

constexpr double half_bucket = 0.56;

TEST(DumpPoint, ByTheBooksTheThirdsFillEvenly) {
  TruckBed bed = berm::app_bench::bench_bed();
  bed.zone_low = -bed.length;  // with the cab's end as free as the other
  BedMap map(bed);
  std::array<double, 3> third{};
  for (int pass = 0; pass < 12; ++pass) {
    const DumpPoint p = choose_dump_point(map, half_bucket, 0.0);
    EXPECT_FALSE(p.observed);
    map.note_dump(p.u, 1500.0);
    ++third[p.u < -0.5 ? 0 : p.u > 0.5 ? 2 : 1];
  }
  EXPECT_EQ(third, (std::array<double, 3>{4, 4, 4}));
}

TEST(DumpPoint, GoesToTheLowThirdThatIsSeen) {
  const TruckBed bed = berm::app_bench::bench_bed();
  BedMap map(bed);
  for (double u = -2.2; u < 2.2; u += 0.1)
    for (double v = -1.0; v < 1.0; v += 0.1) {
      double x = 0.0, y = 0.0;
      from_bed(bed, {u, v}, x, y);
      map.insert(x, y, bed.wall_top - bed.height + (u > 0.9 ? 0.1 : 0.6), 5.0);
    }
  const DumpPoint p = choose_dump_point(map, half_bucket, 0.0);
  EXPECT_TRUE(p.observed);
  EXPECT_GT(p.u, 1.0);
  EXPECT_NEAR(p.radius * std::cos(p.bearing), bed.centre_x + p.u, 1e-9);
  EXPECT_NEAR(p.radius * std::sin(p.bearing), bed.centre_y, 1e-9);
}

TEST(DumpPoint, OldSightDoesNotCount) {
  const TruckBed bed = berm::app_bench::bench_bed();
  BedMap map(bed);
  for (double u = -2.2; u < 2.2; u += 0.1)
    for (double v = -1.0; v < 1.0; v += 0.1) {
      double x = 0.0, y = 0.0;
      from_bed(bed, {u, v}, x, y);
      map.insert(x, y, 0.0, 5.0);
    }
  EXPECT_TRUE(choose_dump_point(map, half_bucket, 4.0).observed);
  EXPECT_FALSE(choose_dump_point(map, half_bucket, 6.0).observed);
}

TEST(DumpPoint, StaysABucketsWidthFromTheEndWalls) {
  const TruckBed bed = berm::app_bench::bench_bed();
  BedMap map(bed);
  for (int pass = 0; pass < 6; ++pass) {
    const DumpPoint p = choose_dump_point(map, half_bucket, 0.0);
    EXPECT_LE(std::fabs(p.u) + half_bucket, 0.5 * bed.length);
    map.note_dump(p.u, 1500.0);
  }
}

// An end that no ray showed may stand nearer than it is thought to.
TEST(DumpPoint, StaysFartherFromAnEndThatIsNotSure) {
  TruckBed bed = berm::app_bench::bench_bed();
  bed.end_deviation = 0.35;
  BedMap map(bed);
  double farthest = 0.0;
  for (int pass = 0; pass < 9; ++pass) {
    const DumpPoint p = choose_dump_point(map, half_bucket, 0.0);
    farthest = std::fmax(farthest, std::fabs(p.u));
    map.note_dump(p.u, 1500.0);
  }
  EXPECT_LE(farthest + half_bucket, 0.5 * bed.length - 2.0 * bed.end_deviation);
  EXPECT_GT(farthest, 0.5) << "it still fills the bed";
  bed.end_deviation = 5.0;
  EXPECT_EQ(choose_dump_point(BedMap(bed), half_bucket, 0.0).u, 0.0);
}

// The kernel lets nothing pass over what stands beyond the site's truck zone: the cab.
TEST(DumpPoint, StaysWellWithinTheTruckZone) {
  TruckBed bed = berm::app_bench::bench_bed();
  EXPECT_NEAR(bed.zone_low, -2.6, 0.011) << "of the site file: to the cab";
  EXPECT_NEAR(bed.zone_high, 5.2, 0.011);
  bed.zone_low = -2.2;
  bed.zone_high = 1.9;
  BedMap map(bed);
  double lowest = 0.0, highest = 0.0;
  for (int pass = 0; pass < 9; ++pass) {
    const DumpPoint p = choose_dump_point(map, half_bucket, 0.0);
    lowest = std::fmin(lowest, p.u);
    highest = std::fmax(highest, p.u);
    map.note_dump(p.u, 1500.0);
  }
  EXPECT_GE(lowest - half_bucket, bed.zone_low + 0.5);
  EXPECT_LE(highest + half_bucket, bed.zone_high - 0.5);
  EXPECT_GT(highest - lowest, 1.0) << "it still fills the bed";
}

TEST(BedMap, HiddenCellsCountAsTheMeanOfTheSeen) {
  const TruckBed bed = berm::app_bench::bench_bed();
  BedMap map(bed);
  double x = 0.0, y = 0.0;
  from_bed(bed, {-1.6, 0.0}, x, y);
  map.insert(x, y, bed.wall_top - bed.height + 0.5, 1.0);
  EXPECT_NEAR(map.mean_height(0.8, 2.4, 0.0), 0.5, 1e-9);  // nothing seen there
  from_bed(bed, {0.0, 1.3}, x, y);                         // outside the walls
  map.insert(x, y, 3.0, 1.0);
  EXPECT_NEAR(map.mean_height(-2.4, 2.4, 0.0), 0.5, 1e-9);
}

}  // namespace
