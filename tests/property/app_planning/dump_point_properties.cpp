// Beds of any size and place, and buckets of any weight: no dump lies outside what the bucket may come over, and by the books the load ends in the middle.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "planning/dump_point.hpp"

namespace {

using namespace berm::app;

double drawn(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 100001) * 1e-5; }

TruckBed drawn_bed() {
  TruckBed bed;
  bed.centre_x = drawn(-1.0, 0.5);
  bed.centre_y = drawn(6.4, 7.0);
  bed.yaw = (*rc::gen::arbitrary<bool>() ? std::numbers::pi : 0.0) + drawn(-0.2, 0.2);
  bed.length = drawn(4.3, 6.0);
  bed.width = drawn(2.3, 2.6);
  bed.height = 1.2;
  bed.wall_top = drawn(0.2, 0.7);
  bed.end_deviation = drawn(0.0, 0.05);
  return bed;
}

RC_GTEST_PROP(DumpPoint, StaysWhereTheBucketMayBeAndEndsInTheMiddle, ()) {
  const TruckBed bed = drawn_bed();
  BedMap map(bed);
  const int passes = *rc::gen::inRange(3, 13);
  constexpr double half_bucket = 0.56;
  const BedArea area = dump_area(bed, half_bucket);
  double rest = passes * 1500.0;
  for (int pass = 0; pass < passes; ++pass) {
    // A pass brings what is planned, or much less; the last ones make up for it.
    const double kg = pass + 1 == passes ? rest : std::fmin(rest / (passes - pass) * drawn(0.7, 1.05), 1600.0);
    rest -= kg;
    const DumpPoint p = choose_dump_point(map, {half_bucket, 0.0, kg, 1600.0, rest, std::numeric_limits<double>::infinity(), {}});
    RC_ASSERT(p.at.u >= area.u_low - 1e-9 && p.at.u <= area.u_high + 1e-9);
    RC_ASSERT(std::fabs(p.at.u) + half_bucket + 2.0 * bed.end_deviation <= 0.5 * bed.length);
    RC_ASSERT(std::fabs(p.at.v) <= 0.3);
    map.note_dump(landing(bed, p.at, kg), kg);
  }
  const BedPoint centre = map.noted_load().centre();
  RC_ASSERT(std::hypot(centre.u, centre.v) < 0.15);
}

}  // namespace
