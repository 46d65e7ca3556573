// Looking for the truck: from where it is seen whole, until there is one that can be loaded.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Events;
using app_bench::Loading;
using app_bench::start_pose;

bool moves(const Answer& answer) { return std::any_of(answer.velocity.begin(), answer.velocity.end(), [](double v) { return v != 0.0; }); }

TEST(TruckLook, AsksWithOneSweepOverTheWholePlaceFromWhereTheMachineStands) {
  Loading run(1, start_pose());
  while (run.finder.ended() == 0 && run.seconds < 60.0) run.step();
  ASSERT_EQ(run.finder.looks.size(), 1u);
  const auto& asked = run.finder.looks.front();
  const ScannerMount& mount = run.machine.scanner[0];
  const double swing_angle = run.plant.angle()[swing];
  EXPECT_NEAR(asked.viewpoint[0], mount.x * std::cos(swing_angle) - mount.y * std::sin(swing_angle), 0.01);
  EXPECT_NEAR(asked.viewpoint[1], mount.x * std::sin(swing_angle) + mount.y * std::cos(swing_angle), 0.01);
  EXPECT_NEAR(asked.viewpoint[2], mount.z, 1e-9);
  EXPECT_NEAR(swing_angle, radians(36.0), radians(3.0)) << "60 degrees before the truck's bearing";
  // Bearings from the head: well beyond both ends of the bed.
  double low = 1e9, high = -1e9;
  for (const ScanPoint& p : asked.points) {
    if (static_cast<double>(p.y) < asked.viewpoint[1] + 2.0) continue;
    const double b = std::atan2(static_cast<double>(p.y) - asked.viewpoint[1], static_cast<double>(p.x) - asked.viewpoint[0]);
    low = std::min(low, b), high = std::max(high, b);
  }
  const TruckBed bed = app_bench::bench_bed();
  for (const double u : {-0.5, 0.5})
    for (const double v : {-0.5, 0.5}) {
      const double b = std::atan2(bed.centre_y + v * bed.width - asked.viewpoint[1], bed.centre_x + u * bed.length - asked.viewpoint[0]);
      EXPECT_GT(b, low + radians(5.0));
      EXPECT_LT(b, high - radians(5.0));
    }
  EXPECT_FALSE(moves(run.last));
}

// From beside the truck it goes to dig over ground at its feet that the other scanner must have seen by then, wherever that was when the look began.
TEST(TruckLook, TheDigWaitsUntilTheOtherScannerHasSeenTheFeet) {
  Loading run(1, start_pose());
  const double outmost = run.machine.scanner[1].pan_low;
  double inmost = outmost, looks_since = -1.0;
  bool moved = false;
  while (!moved && run.seconds < 60.0) {
    run.step();
    const bool looks = !run.finder.looks.empty();
    if (looks && looks_since < 0.0) looks_since = run.seconds;
    const bool late = looks_since < 0.0 || run.seconds < looks_since + 2.0;  // the other scanner
    if (late && std::fabs(run.plant.angle()[swing]) > radians(10.0)) run.plant.put_pan(1, outmost);
    if (looks) inmost = std::max(inmost, run.plant.state().pan_angle_urad[1] * 1e-6);
    moved = looks && moves(run.last);
  }
  ASSERT_TRUE(moved);
  EXPECT_GT(inmost, radians(35.0));
}

TEST(TruckLook, WithoutATruckItLooksAgainTellsTheOperatorAndDoesNotDig) {
  Events events;
  Loading run(1, start_pose(), events.fd());
  run.finder.truck = {};
  run.finder.truck.reason = "the sweep shows no upright wall";
  while (run.seconds < 75.0) {
    run.step();
    ASSERT_NE(run.last.phase, BERM_PHASE_DIG);
  }
  EXPECT_GE(run.finder.ended(), 4u);
  const auto none = events.named("no_truck"), operators = events.named("operator_needed");
  EXPECT_EQ(none.size(), run.finder.ended());
  EXPECT_EQ(none.front().at("reason"), "the sweep shows no upright wall");
  ASSERT_EQ(operators.size(), 1u) << "once";
  EXPECT_EQ(operators.front().at("reason"), "no_truck");
  EXPECT_NE(operators.front().at("advice").get<std::string>().find("truck"), std::string::npos);
  EXPECT_FALSE(moves(run.last));
  run.finder.truck = app_bench::bench_truck();
  const double parked = run.seconds;
  while (run.last.phase != BERM_PHASE_DIG && run.seconds < parked + 60.0) run.step();
  EXPECT_EQ(run.last.phase, BERM_PHASE_DIG) << "there is one now";
  EXPECT_EQ(events.named("recognised").size(), 1u);
}

// The truck that nobody loads has no number of its own: of the next the operator is told all the same. A spotter who is silent for a moment is no next one.
TEST(TruckLook, OfEachTruckThatIsNotRecognisedTheOperatorIsTold) {
  for (const bool says_so : {true, false}) {
    Events events;
    Loading run(2, start_pose(), events.fd());
    run.finder.truck = {};
    const auto go = [&](double seconds) {
      for (const double end = run.seconds + seconds; run.seconds < end;) run.step();
    };
    const auto absent = [&](double seconds) {
      run.plant.truck_parked = false;
      run.plant.truck_leaves = says_so && seconds > 2.0;
      go(seconds);
      run.plant.truck_parked = true;
      run.plant.truck_leaves = false;
    };
    while (events.named("operator_needed").empty() && run.seconds < 90.0) run.step();
    absent(1.0);
    go(60.0);
    EXPECT_EQ(events.named("operator_needed").size(), 1u) << "it is the same truck";
    absent(10.0);
    go(60.0);
    EXPECT_EQ(events.named("operator_needed").size(), 2u);
  }
}

// It parks anew, and now stands where none may: that is another thing to do.
TEST(TruckLook, OfWhatIsWrongNextWithTheSameTruckTheOperatorIsToldToo) {
  Events events;
  Loading run(1, start_pose(), events.fd());
  run.finder.truck = {};
  while (events.named("operator_needed").empty() && run.seconds < 90.0) run.step();
  run.finder.truck = app_bench::bench_truck();
  run.finder.truck.pose.middle.x() += 6.0;
  for (const double end = run.seconds + 60.0; run.seconds < end;) run.step();
  const auto calls = events.named("operator_needed");
  ASSERT_EQ(calls.size(), 2u);
  EXPECT_EQ(calls[0].at("reason"), "no_truck");
  EXPECT_EQ(calls[1].at("reason"), "truck_misplaced");
}

// On sloping ground: what is passed over is the highest place of its walls.
TEST(TruckLook, ATiltedBedIsPassedOverWhereItsWallsAreHighest) {
  Events events;
  Loading run(1, start_pose(), events.fd());
  app::BedPose& pose = run.finder.truck.pose;
  pose.pitch = 0.04, pose.roll = -0.03;
  while (events.named("recognised").empty() && run.seconds < 60.0) run.step();
  ASSERT_EQ(events.named("recognised").size(), 1u);
  const auto event = events.named("recognised").front();
  EXPECT_NEAR(event.at("wall_top_m").get<double>(), pose.middle.z(), 1e-9);
  EXPECT_NEAR(event.at("wall_top_highest_m").get<double>(), pose.middle.z() + 0.5 * (0.04 * run.finder.truck.length + 0.03 * run.finder.truck.width), 2e-3);
  EXPECT_NEAR(event.at("pitch_deg").get<double>(), degrees(0.04), 1e-9);
  EXPECT_NEAR(event.at("roll_deg").get<double>(), degrees(-0.03), 1e-9);
}

// The kernel lets nothing pass over a truck that stands elsewhere.
TEST(TruckLook, ATruckOutsideTheTruckZoneIsNotLoaded) {
  Events events;
  Loading run(1, start_pose(), events.fd());
  run.finder.truck.pose.middle.x() += 6.0;
  while (run.seconds < 45.0) {
    run.step();
    ASSERT_NE(run.last.phase, BERM_PHASE_DIG);
  }
  ASSERT_FALSE(events.named("truck_misplaced").empty());
  EXPECT_NEAR(events.named("truck_misplaced").front().at("x_m").get<double>(), 5.3, 1e-9);
  EXPECT_TRUE(events.named("recognised").empty());
}

TEST(TruckLook, ATruckThatLeavesMeanwhileIsNotLookedForAnyLonger) {
  Loading run(1, start_pose());
  run.finder.truck = {};
  while (run.finder.ended() == 0 && run.seconds < 60.0) run.step();
  run.plant.truck_parked = false;
  const std::size_t looks = run.finder.looks.size();
  for (int k = 0; k < 2000; ++k) run.step();
  EXPECT_EQ(run.finder.looks.size(), looks);
  EXPECT_FALSE(moves(run.last));
}

TEST(TruckLook, AStopInTheLookBeginsItAnew) {
  Loading run(1, start_pose());
  while (run.plant.angle()[swing] < radians(30.0) && run.seconds < 60.0) run.step();
  while (std::fabs(run.plant.state().joint_velocity_urad_s[0]) > 20000 && run.seconds < 60.0) run.step();
  for (int k = 0; k < 150; ++k) run.step();  // the sweep is under way
  ASSERT_EQ(run.finder.looks.size(), 1u);
  run.plant.kernel_runs = false;
  for (int k = 0; k < 300; ++k) run.step();
  EXPECT_EQ(run.finder.ended(), 0u) << "half a sweep tells nothing";
  run.plant.kernel_runs = true;
  const double resumed = run.seconds;
  while (run.finder.ended() == 0 && run.seconds < resumed + 40.0) run.step();
  EXPECT_EQ(run.finder.ended(), 1u);
  EXPECT_GT(run.finder.looks.size(), 1u);
}

// The head's bearing of a place, from where the machine stands.
double bearing_from(const std::array<double, 3>& head, double x, double y) { return std::atan2(y - head[1], x - head[0]); }

// However early the answer stands, the look goes on until the whole bed was looked into, and no longer.
TEST(TruckLook, AnAnswerThatStandsEarlyEndsTheLookWhenTheBedWasPassed) {
  std::size_t whole = 0;
  for (const bool early : {false, true}) {
    Events events;
    Loading run(1, start_pose(), events.fd());
    if (early) run.finder.stands_after = 10;
    while (run.sequencer.bed() == nullptr && run.seconds < 60.0) run.step();
    ASSERT_NE(run.sequencer.bed(), nullptr);
    ASSERT_EQ(run.finder.looks.size(), 1u);
    const auto& look = run.finder.looks.front();
    const auto recognised = events.named("recognised");
    ASSERT_EQ(recognised.size(), 1u);
    EXPECT_EQ(recognised.front().at("before_sweep_end"), early);
    EXPECT_EQ(look.ended, !early);
    const std::vector<ScanPoint>& seen = run.sequencer.sweep().points();
    if (!early) {
      whole = seen.size();
      continue;
    }
    EXPECT_LT(seen.size(), whole) << "it does not go on to the sweep's end";
    double low = 1e9, high = -1e9;
    for (const ScanPoint& p : seen) {
      if (static_cast<double>(p.y) < look.viewpoint[1] + 2.0) continue;
      const double b = bearing_from(look.viewpoint, static_cast<double>(p.x), static_cast<double>(p.y));
      low = std::min(low, b), high = std::max(high, b);
    }
    const TruckBed bed = app_bench::bench_bed();
    for (const double u : {-0.5, 0.5})
      for (const double v : {-0.5, 0.5}) {
        const double b = bearing_from(look.viewpoint, bed.centre_x + u * bed.length, bed.centre_y + v * bed.width);
        EXPECT_GT(b, low);
        EXPECT_LT(b, high);
      }
  }
}

// A scanline is told whole, once, and as soon as it is whole, whatever the blocks are that it comes in.
TEST(TruckLook, TellsTheSweepScanlineByScanlineWhileItGoesOn) {
  Loading run(1, start_pose());
  while (run.finder.looks.empty() && run.seconds < 60.0) run.step();
  ASSERT_FALSE(run.finder.looks.empty());
  std::size_t during = 0;
  while (run.finder.ended() == 0 && run.seconds < 60.0) {
    run.step();
    const auto& told = run.finder.looks.front().points;
    const std::vector<ScanPoint>& seen = run.sequencer.sweep().points();
    if (!run.sequencer.sweep().recording()) continue;
    during = std::max(during, told.size());
    ASSERT_LE(told.size(), seen.size());
    if (told.size() == seen.size() || told.empty()) continue;
    ASSERT_EQ(seen[told.size()].scanline, told.back().scanline + 1);
    ASSERT_EQ(seen.back().scanline, seen[told.size()].scanline) << "only the newest is not told yet";
  }
  EXPECT_GT(during, 1000u);
  EXPECT_EQ(run.finder.looks.front().points.size(), run.sequencer.sweep().points().size());
}

}  // namespace
