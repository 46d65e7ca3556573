#include <gtest/gtest.h>

#include <cmath>

#include "bench_pass.hpp"

namespace {

using namespace berm::app;
using berm::app_bench::BenchPass;

TEST(Skyline, TheTrucksWallsStandEvenUnseen) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  const TerrainMap nothing_seen;
  const Skyline sky(m, site, ground_of(nothing_seen));
  EXPECT_GE(sky.height(radians(96.0), static_cast<int>(6.75 / LowerEdge::bin_m)), berm::app_bench::bench_bed().wall_top);
}

TEST(Skyline, HighIsClearLowIsNot) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  const TerrainMap nothing_seen;
  const Skyline sky(m, site, ground_of(nothing_seen));
  auto high = inverse_pin(m, {6.0, 3.2}, radians(-178.0), radians(7.0));
  auto low = inverse_pin(m, {6.0, 1.2}, radians(-178.0), radians(7.0));
  ASSERT_TRUE(high && low);
  (*high)[swing] = (*low)[swing] = radians(90.0);
  EXPECT_TRUE(sky.clear(*high, {}));
  EXPECT_FALSE(sky.clear(*low, {}));
}

TEST(Skyline, ContactInTheDigZoneOnlyWhileTheSwingIsSlowAndAboveTheFloor) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  const TerrainMap nothing_seen;
  const Skyline sky(m, site, ground_of(nothing_seen));
  const auto digging = inverse_tip(m, {6.6, -1.2}, radians(-110.0), radians(7.0));
  ASSERT_TRUE(digging);
  EXPECT_TRUE(sky.clear(*digging, {}));
  EXPECT_FALSE(sky.clear(*digging, {radians(8.0), 0.0, 0.0, 0.0}));
  const auto deep = inverse_tip(m, {6.2, -3.3}, radians(-110.0), radians(7.0));
  ASSERT_TRUE(deep);
  EXPECT_FALSE(sky.clear(*deep, {}));
  Joints aside = *digging;
  aside[swing] = radians(60.0);
  EXPECT_FALSE(sky.clear(aside, {}));
}

TEST(Skyline, LooksAsFarAheadAsTheSwingNeedsToStop) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  TerrainMap terrain;
  for (double r = 5.0; r < 7.0; r += 0.1)
    for (double across = -0.4; across < 0.4; across += 0.1) terrain.insert(r * std::cos(radians(-40)) + across * 0.64, r * std::sin(radians(-40)) + across * 0.77, 4.0, 1.0);
  const Skyline sky(m, site, ground_of(terrain));
  const auto carry = inverse_pin(m, {6.0, 3.2}, radians(-178.0), radians(7.0));
  ASSERT_TRUE(carry);
  EXPECT_TRUE(sky.clear(*carry, {}));
  EXPECT_TRUE(sky.clear(*carry, {radians(-15.0), 0, 0, 0}));
  EXPECT_FALSE(sky.clear(*carry, {radians(-38.0), 0, 0, 0}));
  EXPECT_TRUE(sky.clear(*carry, {radians(38.0), 0, 0, 0}));
}

TEST(PassPoses, HoldTheLoadLevelAndOpenOverTheBed) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  for (const double radius : {6.6, 6.8, 7.0, 7.15}) {
    PassTask task;
    task.dump_radius = radius;
    task.next_entry = {7.4, -1.6};
    task.truck_top = task.wall_top = berm::app_bench::bench_bed().wall_top;
    const auto poses = pass_poses(m, task);
    ASSERT_TRUE(poses) << radius;
    EXPECT_NEAR(forward(m, poses->carry).bucket_attitude, radians(-178.0), radians(3.0));
    EXPECT_LT(forward(m, poses->spill).bucket_attitude, radians(-155.0));
    EXPECT_NEAR(forward(m, poses->dump).bucket_attitude, radians(-48.0), radians(3.0));
    EXPECT_NEAR(forward(m, poses->dump).tip.r, radius - 0.25 + 1.562 * std::cos(radians(-48.0)), 0.06);
    for (const Joints* pose : {&poses->carry, &poses->spill, &poses->dump, &poses->back}) EXPECT_GT(bucket_underside(m, *pose), berm::app_bench::bench_bed().wall_top + 1.1);
  }
}

TEST(PassPoses, PassHigherOverAHighCab) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  PassTask task;
  task.dump_radius = 6.8;
  task.next_entry = {7.4, -1.6};
  task.truck_top = task.wall_top = 0.3;
  const auto low = pass_poses(m, task);
  task.truck_top = 0.8;
  const auto high = pass_poses(m, task);
  ASSERT_TRUE(low && high);
  EXPECT_NEAR(bucket_underside(m, high->carry) - bucket_underside(m, low->carry), 0.5, 0.10);  // the bucket tilts a little as well
}

TEST(Skyline, NamesWhatBlocks) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  const Skyline sky(m, site, [](double x, double y) { return x > 0.0 && y > 4.0 && y < 5.0 ? INFINITY : -2.0; });
  auto pose = inverse_pin(m, {6.4, 3.2}, radians(-178.0), radians(7.0));
  ASSERT_TRUE(pose);
  (*pose)[swing] = radians(50.0);
  const auto blocking = sky.blocking(preview(m, *pose, {}));
  ASSERT_TRUE(blocking);
  EXPECT_EQ(blocking->what, Skyline::Blocking::What::ground);
  EXPECT_TRUE(std::isinf(blocking->height));
  EXPECT_NEAR(blocking->distance * std::sin(blocking->bearing), 4.5, 1.5);
  const auto folded = inverse_pin(m, {4.6, 2.2}, radians(-178.0));
  ASSERT_TRUE(folded);
  ASSERT_TRUE(sky.blocking(preview(m, *folded, {})));
  EXPECT_EQ(sky.blocking(preview(m, *folded, {}))->what, Skyline::Blocking::What::own_body);
}

TEST(Skyline, IntervalsBeyondARangeHideNothingThatTheyMeet) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  const Skyline low(m, site, [](double, double) { return -2.0; }), unseen(m, site, [](double, double) { return INFINITY; });
  auto opening = inverse_pin(m, {6.4, 3.6}, radians(-30.0), radians(7.0));
  ASSERT_TRUE(opening);
  (*opening)[bucket] = m.joint[bucket].high - radians(8.0);
  const ReachIntervals box = preview(m, *opening, {0.0, 0.0, 0.0, radians(50.0)});
  ASSERT_TRUE(low.blocking(box));
  EXPECT_EQ(low.blocking(box)->what, Skyline::Blocking::What::joint_range);
  EXPECT_FALSE(low.blocking(box, Skyline::Ranges::left_to_guard));
  ASSERT_TRUE(unseen.blocking(box, Skyline::Ranges::left_to_guard));
  EXPECT_EQ(unseen.blocking(box, Skyline::Ranges::left_to_guard)->what, Skyline::Blocking::What::ground);
}

// What sticks is let out by a bucket that opens almost to its range's end, which says nothing of where the arm may reach out over the dig.
TEST(PassSearch, ABucketThatOpensFarDoesNotKeepTheArmFromReachingOutOverTheDig) {
  BenchPass pass;
  const auto reaches_out = [&](double farther) {
    pass.task.open_farther = farther;
    const auto poses = pass_poses(pass.machine, pass.task);
    EXPECT_TRUE(poses);
    PassSearch search = pass.begin(poses.value());
    for (int steps = 0; !search.done() && steps < 100; ++steps) search.step();
    EXPECT_TRUE(search.clear()) << degrees(farther);
    return std::pair(degrees(poses->dump[bucket]), degrees(search.thresholds().hover_offset));
  };
  const auto [opens, offset] = reaches_out(0.0);
  const auto [opens_far, offset_far] = reaches_out(radians(38.0));
  EXPECT_GT(opens_far, opens + 20.0);
  EXPECT_GT(offset, 20.0);
  EXPECT_EQ(offset_far, offset);
}

TEST(PassSearch, FindsASwingThatStartsBeforeTheBoomIsUpAndStaysClear) {
  const BenchPass pass;
  const MachineModel& m = pass.machine;
  const PassTask& task = pass.task;
  const auto poses = pass_poses(m, task);
  ASSERT_TRUE(poses);
  PassSearch search = pass.begin(*poses);
  int steps = 0;
  while (!search.done() && ++steps < 100) search.step();
  ASSERT_TRUE(search.done());
  EXPECT_TRUE(search.clear());
  EXPECT_LT(search.thresholds().swing_start_boom, poses->carry[boom] - radians(4.0));
  EXPECT_LT(search.seconds(), 18.0);
  // Sooner than the coarse candidate that was found clear: these lie up to 8 degrees from one another.
  const double low = task.lifted_from[boom] + radians(1.0), high = poses->carry[boom] - radians(1.5), start = search.thresholds().swing_start_boom;
  int k = 0;
  const auto candidate = [&] { return low + (high - low) * k * k / 64.0; };
  while (k < 8 && candidate() < start - 1e-9) ++k;
  ASSERT_GT(k, 0) << "the soonest is clear: the test shows nothing";
  EXPECT_LT(start, candidate() - radians(0.1));
}

TEST(Skyline, OverATrucksCabNothingPassesHoweverHigh) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  TerrainMap cab;  // beyond the truck zone's end, 0.7 m over the bench's level
  for (double x = -5.5; x < -3.5; x += 0.1)
    for (double y = 5.8; y < 7.8; y += 0.1) cab.insert(x, y, 0.7, 1.0);
  const Skyline by_height(m, site, ground_of(cab)), refused(m, site, ground_of(cab), Skyline::OverHigh::refused);
  auto high = inverse_pin(m, {6.4, 3.6}, radians(-175.0), radians(7.0));
  ASSERT_TRUE(high);
  Joints over_cab = *high, over_bed = *high;
  over_cab[swing] = radians(125.0);
  over_bed[swing] = radians(95.0);
  EXPECT_TRUE(by_height.clear(over_cab, {}));
  EXPECT_FALSE(refused.clear(over_cab, {}));
  EXPECT_TRUE(refused.clear(over_bed, {}));
  EXPECT_FALSE(refused.clear(over_bed, {radians(30.0), 0.0, 0.0, 0.0})) << "it could not stop before the cab";
  EXPECT_TRUE(refused.clear(over_bed, {radians(-30.0), 0.0, 0.0, 0.0}));
}

// Stick and bucket hang beyond it, and the boom's heights are in no lower edge.
TEST(Skyline, TheBoomPassesOverNothingTooHighEither) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  const Joints carried{radians(45.0), radians(42.0), radians(-88.0), radians(-127.0)};
  const auto clear = [&](double r, double top, Skyline::OverHigh over_high) {
    TerrainMap post;  // a cell of the kernel's map and no more
    for (double dx = -0.1; dx < 0.15; dx += 0.1)
      for (double dy = -0.1; dy < 0.15; dy += 0.1) post.insert(r * std::cos(carried[swing]) + dx, r * std::sin(carried[swing]) + dy, top, 1.0);
    return Skyline(m, site, ground_of(post), over_high).clear(carried, {});
  };
  EXPECT_FALSE(clear(3.7, 1.4, Skyline::OverHigh::refused));
  EXPECT_TRUE(clear(3.7, 1.4, Skyline::OverHigh::ignored));
  EXPECT_TRUE(clear(3.7, 0.7, Skyline::OverHigh::refused)) << "no higher than may be passed over";
  EXPECT_TRUE(clear(3.1, 1.4, Skyline::OverHigh::refused)) << "of the own body's cells nothing is asked";
  EXPECT_TRUE(clear(8.0, 1.4, Skyline::OverHigh::refused)) << "beyond the bucket";
}

// A cell that begins right at the own body's circle is not all of it within the circle and a diagonal: the kernel stops the boom before it.
TEST(Skyline, TheBoomPassesOverNoCellThatTheCircleLeavesOut) {
  const MachineModel m = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench_with_truck();
  const auto blocks = [&](double x, double y) {
    TerrainMap post;  // a cell of the kernel's map and no more
    for (double dx = -0.1; dx < 0.15; dx += 0.1)
      for (double dy = -0.1; dy < 0.15; dy += 0.1) post.insert(x + dx, y + dy, 1.17, 1.0);
    const Joints carried{std::atan2(y, x), radians(42.6), radians(-70.0), radians(-73.5)};
    const auto blocking = Skyline(m, site, ground_of(post), Skyline::OverHigh::refused).blocking(preview(m, carried, {}));
    return std::string(blocking ? blocking->name() : "nothing");
  };
  EXPECT_EQ(blocks(1.65, 2.85), "too high to pass over") << "its far corner is 3.50 m from the swing axis";
  EXPECT_EQ(blocks(2.25, 2.25), "nothing") << "3.39 m: of the machine's own";
}

TEST(Skyline, WhatIsOfTheParkedTruck) {
  const SiteModel site = berm::app_bench::bench_with_truck();
  const TruckBed& bed = *site.bed;
  const double far_side = to_bed(bed, 0.0, 0.0).v > 0.0 ? -1.0 : 1.0, wall = 0.5 * bed.width, end = 0.5 * bed.length;
  const auto at = [&](double u, double v) {
    double x = 0.0, y = 0.0;
    from_bed(bed, {u, v}, x, y);
    return at_truck(site, x, y);
  };
  EXPECT_TRUE(at(0.0, 0.0));
  for (const double way : {1.0, -1.0}) {
    EXPECT_TRUE(at(way * (end + 2.5), 0.0)) << "the cab";
    EXPECT_FALSE(at(way * (end + 3.5), 0.0));
  }
  EXPECT_TRUE(at(0.0, far_side * (wall + 1.0))) << "behind the far wall the map has lines from its top";
  EXPECT_FALSE(at(0.0, -far_side * (wall + 1.0))) << "before the near one somebody may stand";
  SiteModel none = site;
  none.bed.reset();
  EXPECT_FALSE(at_truck(none, bed.centre_x, bed.centre_y)) << "none was recognised";
}

TEST(Skyline, WhereTheGroundMayBePassedOver) {
  SiteModel site = berm::app_bench::bench_with_truck();
  EXPECT_NEAR(pass_over_limit(site, -8.0, 0.0), 0.8, 1e-9);
  EXPECT_LT(pass_over_limit(site, -10.0, 8.0), -0.8) << "the lower ground";
  EXPECT_NEAR(pass_over_limit(site, 0.0, 7.0), 1.3, 1e-9) << "the truck's bed";
  site.bed.reset();
  EXPECT_LT(pass_over_limit(site, 0.0, 7.0), -0.8) << "no truck: lower ground";
}

}  // namespace
