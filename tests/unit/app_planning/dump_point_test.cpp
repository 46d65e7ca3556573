// Evenness and balance of the load, where a bucket may come, and what is done where the walls hide the bed.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "app_bench/bench_machine.hpp"
#include "planning/dump_point.hpp"

namespace {

using namespace berm::app;

constexpr double half_bucket = 0.56;
constexpr double bucket_kg = 1500.0;

// The bed of the miniature bench, as free at the cab's end as at the other.
TruckBed free_bed() {
  TruckBed bed = berm::app_bench::bench_bed();
  bed.zone_low = -bed.length;
  return bed;
}

// For the pass after `done` of so many.
DumpNeeds needs(int done, int passes, double since_s = 0.0) {
  return {half_bucket, since_s, bucket_kg, bucket_kg, bucket_kg * (passes - done - 1), std::numeric_limits<double>::infinity(), {}};
}

// What a scanner sees of a load height(u, v), where seen(u, v).
template <class Height, class Seen>
void look(BedMap& map, Height height, Seen seen, double time_s) {
  const TruckBed& bed = map.bed();
  for (double u = -2.4; u < 2.4; u += 0.05)
    for (double v = -1.2; v < 1.2; v += 0.05) {
      if (!seen(u, v)) continue;
      double x = 0.0, y = 0.0;
      from_bed(bed, {u, v}, x, y);
      map.insert(x, y, bed.wall_top - bed.height + height(u, v), time_s);
    }
}

bool everywhere(double, double) { return true; }

double offset(const BedPoint& p) { return std::hypot(p.u, p.v); }

TEST(DumpPoint, AnEvenBedIsLoadedFromItsMiddle) {
  for (const double height : {0.0, 0.4, 1.0}) {
    BedMap map(free_bed());
    look(map, [&](double, double) { return height; }, everywhere, 1.0);
    const DumpPoint p = choose_dump_point(map, needs(0, 12));
    EXPECT_TRUE(p.observed);
    EXPECT_LT(offset(p.at), 0.2) << "at " << height;
    EXPECT_NEAR(p.height, height, 1e-9);
  }
}

TEST(DumpPoint, ByTheBooksTheLoadEndsInTheMiddleAndItsThirdsAreAlike) {
  for (const int passes : {3, 4, 6, 12}) {
    BedMap map(free_bed());
    double third[3] = {0.0, 0.0, 0.0};
    for (int pass = 0; pass < passes; ++pass) {
      const DumpPoint p = choose_dump_point(map, needs(pass, passes));
      EXPECT_FALSE(p.observed);
      map.note_dump(landing(map.bed(), p.at, bucket_kg), bucket_kg);
      third[p.at.u < -0.55 ? 0 : p.at.u > 0.55 ? 2 : 1] += 1.0;
    }
    EXPECT_LT(offset(map.noted_load().centre()), 0.15) << passes << " passes";
    for (const double t : third) EXPECT_NEAR(t, passes / 3.0, passes / 6.0 + 0.5) << passes << " passes";
  }
}

TEST(DumpPoint, GoesToTheLowPartThatIsSeen) {
  const TruckBed bed = free_bed();
  BedMap map(bed);
  look(map, [](double u, double) { return u > 0.9 ? 0.1 : 0.6; }, everywhere, 5.0);
  const DumpPoint p = choose_dump_point(map, needs(1, 12));
  EXPECT_TRUE(p.observed);
  EXPECT_GT(p.at.u, 1.0);
  EXPECT_LT(p.height, 0.25);
  double x = 0.0, y = 0.0;
  from_bed(bed, p.at, x, y);
  EXPECT_NEAR(p.radius * std::cos(p.bearing), x, 1e-9);
  EXPECT_NEAR(p.radius * std::sin(p.bearing), y, 1e-9);
}

TEST(DumpPoint, FillsAHoleInAnEvenLoad) {
  BedMap map(free_bed());
  look(map, [](double u, double v) { return std::hypot(u + 0.9, v) < 0.35 ? 0.3 : 0.6; }, everywhere, 5.0);
  EXPECT_NEAR(choose_dump_point(map, needs(1, 12)).at.u, -0.9, 0.31);
}

TEST(DumpPoint, GoesDownASlope) {
  BedMap map(free_bed());
  look(map, [](double u, double) { return 0.6 - 0.12 * u; }, everywhere, 5.0);
  EXPECT_GT(choose_dump_point(map, needs(1, 12)).at.u, 1.0);
}

TEST(DumpPoint, TheLastDumpsPutTheLoadOverTheAxles) {
  const TruckBed bed = free_bed();
  BedMap map(bed);
  for (int i = 0; i < 4; ++i) map.note_dump({-1.0, 0.0}, bucket_kg);
  const DumpPoint p = choose_dump_point(map, needs(4, 6));
  EXPECT_GT(p.at.u, 1.2);
  EXPECT_NEAR(p.load_centre.u, (4.0 * -1.0 + p.at.u) / 5.0, 0.01) << "by the books alone";
  // With many to come there is no hurry: the lowest part counts, wherever it is.
  BedMap early(bed);
  early.note_dump({-1.0, 0.0}, bucket_kg);
  look(early, [](double u, double) { return u < -1.2 ? 0.0 : 0.5; }, everywhere, 5.0);
  EXPECT_LT(choose_dump_point(early, needs(1, 12)).at.u, -1.2);
}

// Two passes of 945 kg are left, and the next may bring a heaped bucket: dumped at the empty end, as two equal ones would be, it left that truck's load 0.4 m off
// its middle.
TEST(DumpPoint, ABucketThatMayComeFullerIsNotDumpedWhereTheRestCannotBalanceIt) {
  BedMap map(free_bed());
  map.note_dump({0.0, 0.0}, 1590.0);
  map.note_dump({1.2, 0.0}, 980.0);
  DumpNeeds sure{half_bucket, 0.0, 945.0, 945.0, 945.0, std::numeric_limits<double>::infinity(), {}}, fuller = sure;
  fuller.most_kg = 1600.0;
  const DumpPoint exact = choose_dump_point(map, sure), careful = choose_dump_point(map, fuller);
  EXPECT_LT(exact.at.u, -1.2);
  LoadMoment load = map.noted_load();
  load.add(landing(map.bed(), careful.at, 1600.0), 1600.0);
  EXPECT_LT(least_final_offset(load, 945.0 - (1600.0 - 945.0), dump_area(map.bed(), half_bucket)), 0.15) << "dumped at " << careful.at.u;
  load = map.noted_load();
  load.add(landing(map.bed(), exact.at, 1600.0), 1600.0);
  EXPECT_GT(least_final_offset(load, 945.0 - (1600.0 - 945.0), dump_area(map.bed(), half_bucket)), 0.2);
}

TEST(DumpPoint, OldSightDoesNotCount) {
  BedMap map(berm::app_bench::bench_bed());
  look(map, [](double, double) { return 0.5; }, everywhere, 5.0);
  EXPECT_TRUE(choose_dump_point(map, needs(0, 12, 4.0)).observed);
  EXPECT_FALSE(choose_dump_point(map, needs(0, 12, 6.0)).observed);
}

// The near wall hides the near half: of what lies there the far half and the books tell.
TEST(DumpPoint, AHiddenHalfDoesNotLeadItAstray) {
  const auto far_half = [](double, double v) { return v < 0.0; };
  BedMap across(free_bed());
  across.note_dump({0.0, 0.0}, bucket_kg);
  look(across, [](double u, double) { return std::fmax(0.0, 0.45 - 0.6 * std::fmax(0.0, std::fabs(u) - 0.55)); }, far_half, 5.0);
  const DumpPoint beside = choose_dump_point(across, needs(1, 12));
  EXPECT_TRUE(beside.observed);
  EXPECT_GT(std::fabs(beside.at.u), 1.2) << "beside the heap";
  EXPECT_LT(std::fabs(beside.at.v), 0.15) << "and not to the far side alone";

  // One end is hidden, and empty by the books: it is not taken for as full as the other.
  const auto one_end = [](double u, double) { return u < 0.0; };
  BedMap along(free_bed());
  for (const double u : {-1.5, -0.5, -1.5, -0.5}) along.note_dump({u, 0.0}, bucket_kg);
  look(along, [](double, double) { return 0.75; }, one_end, 5.0);
  EXPECT_GT(choose_dump_point(along, needs(4, 12)).at.u, 0.8);
}

TEST(DumpPoint, StaysABucketsWidthFromTheEndWallsAndItsPourFromTheSideWalls) {
  const TruckBed bed = free_bed();
  BedMap map(bed);
  for (int pass = 0; pass < 6; ++pass) {
    const DumpPoint p = choose_dump_point(map, needs(pass, 12));
    EXPECT_LE(std::fabs(p.at.u) + half_bucket, 0.5 * bed.length);
    EXPECT_LE(std::fabs(p.at.v) + 1.0, 0.5 * bed.width);
    map.note_dump(p.at, bucket_kg);
  }
}

TEST(DumpPoint, StaysWithinTheArmsReach) {
  const TruckBed bed = free_bed();
  BedMap map(bed);
  for (int pass = 0; pass < 6; ++pass) {
    DumpNeeds n = needs(pass, 12);
    n.farthest_radius = 6.9;
    const DumpPoint p = choose_dump_point(map, n);
    EXPECT_LE(p.radius, 6.95);
    map.note_dump(p.at, bucket_kg);
  }
}

// So that no pass swings far both ways: what was dug far from the truck goes to the bed's near end, and what was dug near it to the far one.
TEST(DumpPoint, WhatWasDugFarFromTheTruckIsDumpedNear) {
  BedMap map(free_bed());
  look(map, [](double, double) { return 0.4; }, everywhere, 1.0);
  const double middle = std::atan2(free_bed().centre_y, free_bed().centre_x);
  DumpNeeds n = needs(3, 12);
  n.dig_beyond = radians(12.0);
  EXPECT_LT(choose_dump_point(map, n).bearing, middle - radians(5.0));
  n.dig_beyond = radians(-12.0);
  EXPECT_GT(choose_dump_point(map, n).bearing, middle + radians(5.0));
  n.rest_kg = 0.0;
  EXPECT_NEAR(choose_dump_point(map, n).bearing, middle, radians(2.0)) << "the last goes where the balance has it";
  TruckBed behind = free_bed();
  behind.centre_x = -std::hypot(behind.centre_x, behind.centre_y);
  behind.centre_y = 0.0;
  behind.yaw = radians(90.0);
  BedMap there(behind);
  look(there, [](double, double) { return 0.4; }, everywhere, 1.0);
  n = needs(3, 12);
  n.dig_beyond = radians(12.0);
  EXPECT_LT(wrapped(choose_dump_point(there, n).bearing - std::numbers::pi), radians(-5.0)) << "where bearings begin anew, too";
  n.dig_beyond = radians(-12.0);
  EXPECT_GT(wrapped(choose_dump_point(there, n).bearing - std::numbers::pi), radians(5.0));
}

// The arm is drawn in as a part is poured, and beside the cab it is held up there.
TEST(DumpPoint, APartIsPouredAwayFromTheTruckZonesEnd) {
  TruckBed bed = berm::app_bench::bench_bed();
  bed.zone_low = -2.6;
  BedMap map(bed);
  look(map, [](double u, double) { return u < 0.0 ? 0.3 : 0.4; }, everywhere, 1.0);
  DumpNeeds n = needs(0, 12);
  const double whole = choose_dump_point(map, n).at.u;
  n.may_be_part = true;
  EXPECT_LT(whole, -0.5);
  EXPECT_GT(choose_dump_point(map, n).at.u, whole + 0.3);
}

// A small load slides late, when the lip has passed the point: it is poured short.
TEST(DumpPoint, ASmallLoadIsPouredShortOfItsPlace) {
  const TruckBed bed = free_bed();
  BedMap map(bed);
  DumpNeeds small = needs(0, 1);
  small.dump_kg = small.most_kg = 500.0;
  const DumpPoint p = choose_dump_point(map, small), full = choose_dump_point(map, needs(0, 12));
  EXPECT_LT(p.radius, full.radius - 0.2);
  EXPECT_LT(offset(landing(bed, p.at, 500.0)), 0.15);
  small.most_kg = 1600.0;
  EXPECT_GT(choose_dump_point(map, small).radius, full.radius - 0.1) << "but not where it may turn out to be a full bucket";
}

// An end that no ray showed may stand nearer than it is thought to.
TEST(DumpPoint, StaysFartherFromAnEndThatIsNotSure) {
  TruckBed bed = free_bed();
  bed.end_deviation = 0.35;
  BedMap map(bed);
  double farthest = 0.0;
  for (int pass = 0; pass < 9; ++pass) {
    const DumpPoint p = choose_dump_point(map, needs(pass, 12));
    farthest = std::fmax(farthest, std::fabs(p.at.u));
    map.note_dump(p.at, bucket_kg);
  }
  EXPECT_LE(farthest + half_bucket, 0.5 * bed.length - 2.0 * bed.end_deviation);
  EXPECT_GT(farthest, 0.5) << "it still fills the bed";
  bed.end_deviation = 5.0;
  EXPECT_NEAR(choose_dump_point(BedMap(bed), needs(0, 12)).at.u, 0.0, 1e-9);
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
    const DumpPoint p = choose_dump_point(map, needs(pass, 12));
    lowest = std::fmin(lowest, p.at.u);
    highest = std::fmax(highest, p.at.u);
    map.note_dump(p.at, bucket_kg);
  }
  EXPECT_GE(lowest - half_bucket, bed.zone_low + 0.5);
  EXPECT_LE(highest + half_bucket, bed.zone_high - 0.5);
  EXPECT_GT(highest - lowest, 1.0) << "it still fills the bed";
}

TEST(DumpPoint, IsPlannedInFarLessThanFiftyMilliseconds) {
  BedMap map(free_bed());
  look(map, [](double u, double v) { return 0.5 + 0.1 * u + 0.05 * v; }, everywhere, 5.0);
  const auto began = std::chrono::steady_clock::now();
  constexpr int times = 20;
  double sum = 0.0;
  for (int i = 0; i < times; ++i) sum += choose_dump_point(map, needs(i, 30)).radius;
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - began;
  EXPECT_GT(sum, 0.0);
  EXPECT_LT(took.count() / times, 50.0);
}

TEST(BedMap, KeepsWhatLiesInsideTheWalls) {
  const TruckBed bed = berm::app_bench::bench_bed();
  BedMap map(bed);
  double x = 0.0, y = 0.0;
  from_bed(bed, {-1.6, 0.0}, x, y);
  map.insert(x, y, bed.wall_top - bed.height + 0.5, 1.0);
  from_bed(bed, {0.0, 1.3}, x, y);  // outside the walls
  map.insert(x, y, 3.0, 1.0);
  from_bed(bed, {0.0, 0.0}, x, y);  // the implements
  map.insert(x, y, bed.wall_top + 1.1, 1.0);
  const BedGrid grid = map.seen(0.0);
  EXPECT_NEAR(grid.known_share(), 1.0 / static_cast<double>(grid.height.size()), 1e-12);
  EXPECT_NEAR(grid.known_mean(), 0.5, 1e-9);
  EXPECT_EQ(map.seen(2.0).known_share(), 0.0) << "too old";
}

TEST(BedMap, TheBooksKeepMassAndPlace) {
  BedMap map(free_bed());
  map.note_dump({0.8, 0.1}, 1000.0);
  map.note_dump({-1.5, 0.0}, 1600.0);
  EXPECT_EQ(map.noted_load().kg, 2600.0);
  EXPECT_NEAR(map.noted_load().centre().u, (800.0 - 2400.0) / 2600.0, 1e-12);
  double volume = 0.0;
  for (const double z : map.noted().height) volume += z * BedGrid::cell * BedGrid::cell;
  EXPECT_NEAR(volume * BedMap::loose_density, 2600.0, 1e-6);
}

// Over what stands higher than the zone's ceiling the kernel lets nothing pass: the heap goes where it stays under it, or as low as may be.
TEST(DumpPoint, HeapsNothingUpToTheTruckZonesCeiling) {
  TruckBed bed = free_bed();
  bed.height += 1.0;  // nothing falls over walls so high
  bed.wall_top += 1.0;
  // By the books most lies at the one end, so that balance draws the last dump to the other; but there the soil stands higher.
  const auto load = [](double u, double) { return u < 0.3 ? 1.55 : 1.95; };
  const auto near_half = [](double, double v) { return v > -0.2; };
  const auto choose = [&](double ceiling_over_floor) {
    bed.ceiling = bed.wall_top - bed.height + ceiling_over_floor;
    BedMap map(bed);
    for (const double u : {-1.5, -1.5, -1.5, -0.5, 0.5, 1.5}) map.note_dump({u, 0.0}, 2.5 * bucket_kg);
    look(map, load, near_half, 5.0);
    return choose_dump_point(map, needs(11, 12));
  };
  const DumpPoint free = choose(std::numeric_limits<double>::infinity()), held = choose(2.3), full = choose(1.6);
  EXPECT_TRUE(free.fits);
  EXPECT_GT(free.at.u, 0.8) << "for balance";
  EXPECT_TRUE(held.fits);
  EXPECT_LT(held.at.u, 0.3) << "not onto the plateau";
  EXPECT_LE(held.heap_top, 2.3 - 0.2);
  EXPECT_FALSE(full.fits) << "there is no such place";
  EXPECT_GT(full.heap_top, 1.6 - 0.1);
  EXPECT_LT(full.at.u, 0.3) << "but here it stays lowest";
  // By the books alone, whose heaps are guessed, nothing is refused.
  bed.ceiling = bed.wall_top - bed.height + 0.1;
  BedMap unseen(bed);
  unseen.note_dump({0.0, 0.0}, 4.0 * bucket_kg);
  EXPECT_TRUE(choose_dump_point(unseen, needs(5, 12)).fits);
}

// At the one end, which balance asks for, the heap stands from wall to wall: much of a bucket would fall over them there. Between higher walls nothing does.
TEST(DumpPoint, GoesWhereLessFallsOverTheWalls) {
  const TruckBed bed = free_bed();
  const auto choose = [&](double walls_higher) {
    TruckBed walled = bed;
    walled.height += walls_higher;
    walled.wall_top += walls_higher;
    const auto load = [&](double u, double v) { return u > 0.4 ? bed.height + std::min(0.3, 0.65 * (0.5 * bed.width - std::fabs(v))) : bed.height - 0.12; };
    BedMap map(walled);
    for (int i = 0; i < 4; ++i) map.note_dump({-0.9, 0.0}, 3.0 * bucket_kg);
    look(map, load, everywhere, 5.0);
    return choose_dump_point(map, needs(11, 12));
  };
  DumpPoint high = choose(1.0), low = choose(0.0);
  EXPECT_GT(high.at.u, 0.6) << "for balance";
  EXPECT_LT(low.at.u, high.at.u - 0.5);
  EXPECT_EQ(high.over_walls->falls(high.at, bucket_kg), 0.0);
  EXPECT_GT(low.over_walls->falls(high.at, bucket_kg), 100.0);
  EXPECT_LT(low.over_walls->falls(low.at, bucket_kg), 0.3 * low.over_walls->falls(high.at, bucket_kg));
}

}  // namespace
