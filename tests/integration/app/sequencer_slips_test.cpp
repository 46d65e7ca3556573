// The base slips while the machine works: after the operator's reset nothing that was seen before is taken for where it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

class SequencerSlips : public ::testing::Test {
protected:
  static constexpr double x_ = 0.40, y_ = -0.30;

  // No heap slides over the walls, which the miniature bench knows nothing of.
  static SiteModel half_loads() {
    SiteModel site = app_bench::bench();
    site.place.target_kg = 8000.0;
    return site;
  }

  static void until(Loading& run, std::uint16_t phase, double longest_s = 90.0) {
    for (const double end = run.seconds + longest_s; run.last.phase != phase && run.seconds < end;) run.step();
    ASSERT_EQ(run.last.phase, phase);
  }
  // The operator resets after some seconds.
  void slip(Loading& run, double x = x_, double y = y_, std::uint8_t reason = BERM_STOP_BASE_MOVED) {
    run.plant.slip(x, y);
    run.finder.truck.pose.middle.x() -= x;
    run.finder.truck.pose.middle.y() -= y;
    run.plant.stop_reason = reason;
    run.plant.kernel_runs = false;
    run.plant.map_void = true;
    run.go(5.0);
    run.plant.map_void = false;
    run.plant.kernel_runs = true;
    run.step();  // still answers the cycle before
    run.step();
    known_after_reset_ = cells_known(run);
    run.go(1.5);  // who carried on swinging as it stopped is asked to stand for a second
  }
  static bool moves(const Loading& run) {
    return std::any_of(run.last.velocity.begin(), run.last.velocity.end(), [](double v) { return v != 0.0; });
  }
  static int cells_known(Loading& run) {
    int known = 0;
    for (double x = -14.0; x < 14.0; x += 0.4)
      for (double y = -14.0; y < 14.0; y += 0.4) known += run.sequencer.terrain().observed_at(x, y) >= 0.0;
    return known;
  }
  long calls(const std::string& reason) const {
    const auto all = events_.named("operator_needed");
    return std::count_if(all.begin(), all.end(), [&](const auto& e) { return e.at("reason") == reason; });
  }
  void expect_loaded(Loading& run) const {
    while (!run.sequencer.finished() && run.seconds < 700.0) run.step();
    ASSERT_TRUE(run.sequencer.finished());
    const double target = half_loads().place.target_kg, bed = run.plant.site().bed_mass();
    EXPECT_GE(bed, 0.96 * target);
    EXPECT_LE(bed, 1.04 * target);
    EXPECT_LT(run.plant.site().spilled_mass(), 0.02 * target);
    EXPECT_NEAR(events_.named("pass").back().at("loaded_kg").get<double>(), bed, 0.03 * bed);
    EXPECT_EQ(run.plant.findings().floor_contacts + run.plant.findings().range_contacts, 0);
  }

  app_bench::Events events_;
  int known_after_reset_ = -1;  // cells of the terrain
};

TEST_F(SequencerSlips, TheTruckIsLoadedWhereItStandsAfterwards) {
  Loading run(1, start_pose(), events_.fd(), half_loads());
  while (events_.named("pass").size() < 2 && run.seconds < 120.0) run.step();
  until(run, BERM_PHASE_SWING_TO_TRUCK);
  run.go(1.0);
  const double carried = run.plant.payload_kg();
  ASSERT_GT(carried, 500.0);
  slip(run);
  EXPECT_EQ(run.sequencer.bed(), nullptr) << "the old bed is used on";
  EXPECT_EQ(known_after_reset_, 0) << "the old terrain is used on";
  while (!moves(run) && run.seconds < 120.0) run.step();
  EXPECT_GT(cells_known(run), 500) << "it moves before it has looked round";
  while (run.finder.looks.size() < 2 && run.seconds < 160.0) run.step();
  EXPECT_NEAR(run.plant.payload_kg(), carried, 0.05 * carried) << "the load was let go";
  const auto told = events_.named("base_moved");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].at("brings_load"), true);
  EXPECT_EQ(told[0].at("loaded_kg"), events_.named("pass")[1].at("loaded_kg"));
  EXPECT_EQ(events_.named("pass").size(), 2u);
  expect_loaded(run);
  EXPECT_EQ(run.finder.looks.size(), 2u);
  EXPECT_NEAR(events_.named("recognised").back().at("x_m").get<double>(), app_bench::bench_bed().centre_x - x_, 1e-6);
  EXPECT_TRUE(events_.named("moved").empty());
}

// The bucket comes up out of the dig first, wherever the slip has left it.
TEST_F(SequencerSlips, ADigIsLeft) {
  Loading run(1, start_pose(), events_.fd(), half_loads());
  until(run, BERM_PHASE_DIG);
  run.go(1.5);
  slip(run);
  expect_loaded(run);
  EXPECT_EQ(run.finder.looks.size(), 2u);
}

// Stopped amid the pour: what is in the truck is booked, what is in the bucket is not.
TEST_F(SequencerSlips, APourIsBookedAsFarAsItCame) {
  Loading run(1, start_pose(), events_.fd());
  until(run, BERM_PHASE_DUMP);
  const double carried = run.plant.payload_kg();
  while (run.plant.payload_kg() > 0.6 * carried && run.seconds < 90.0) run.step();
  run.plant.kernel_runs = false;
  run.plant.stop_reason = BERM_STOP_BASE_MOVED;
  run.go(0.3);
  slip(run);
  const double bed = run.plant.site().bed_mass();
  ASSERT_GT(bed, 200.0);
  ASSERT_EQ(events_.named("pass").size(), 1u);
  EXPECT_NEAR(events_.named("pass")[0].at("payload_kg").get<double>(), bed, 120.0);
  ASSERT_EQ(events_.named("base_moved").size(), 1u);
  EXPECT_EQ(events_.named("base_moved")[0].at("loaded_kg"), events_.named("pass")[0].at("loaded_kg"));
  run.go(60.0);
  EXPECT_GE(events_.named("pass").size(), 1u);
  EXPECT_EQ(run.finder.looks.size(), 2u);
}

// The last pass has filled it: nothing more is dug for it, and it is told so once the bucket is away.
TEST_F(SequencerSlips, ATruckThatWasFullByThenIsSentOff) {
  SiteModel site = app_bench::bench();
  site.place.target_kg = 1300.0;
  Loading run(1, start_pose(), events_.fd(), site);
  until(run, BERM_PHASE_DUMP);
  until(run, BERM_PHASE_SWING_TO_DIG);
  run.go(0.5);
  slip(run);
  const std::size_t digs = events_.named("dig").size();
  while (!run.sequencer.finished() && run.seconds < 200.0) run.step();
  EXPECT_TRUE(run.sequencer.finished());
  EXPECT_EQ(events_.named("truck_full").size(), 1u);
  EXPECT_EQ(events_.named("pass").size(), 1u);
  EXPECT_EQ(events_.named("dig").size(), digs) << "it digs for a full truck";
}

TEST_F(SequencerSlips, AFullTruckThatStandsThereIsWaitedForOn) {
  SiteModel site = app_bench::bench();
  site.place.target_kg = 4000.0;
  Loading run(2, start_pose(), events_.fd(), site);
  while (!run.last.horn && run.seconds < 300.0) run.step();
  while (run.last.horn) run.step();
  slip(run);
  EXPECT_EQ(known_after_reset_, 0);
  run.go(60.0);
  EXPECT_EQ(run.finder.looks.size(), 1u) << "the full truck is taken for the next";
  run.plant.truck_parked = false;
  run.plant.truck_leaves = true;
  run.go(8.0);
  run.plant.truck_leaves = false;
  run.plant.site().new_truck();
  run.plant.truck_parked = true;
  run.go(60.0);
  EXPECT_EQ(run.finder.looks.size(), 2u);
  EXPECT_GT(run.plant.site().bed_mass(), 500.0);
}

// Where the slip has taken it out of the truck zones, or nothing is recognised, nothing is poured; it is looked for until it is found.
TEST_F(SequencerSlips, ATruckThatIsNotFoundAfterwardsIsLookedForWithTheLoadKept) {
  Loading run(1, start_pose(), events_.fd(), half_loads());
  until(run, BERM_PHASE_SWING_TO_TRUCK);
  run.go(1.0);
  const double carried = run.plant.payload_kg();
  run.finder.truck.found = false;
  slip(run);
  run.go(60.0);
  EXPECT_EQ(calls("no_truck"), 1);
  EXPECT_NEAR(run.plant.payload_kg(), carried, 0.05 * carried);
  EXPECT_EQ(run.plant.site().bed_mass(), 0.0);
  run.finder.truck.found = true;
  expect_loaded(run);
}

// The operator was quicker at the emergency stop than the kernel was at finding the slip.
TEST_F(SequencerSlips, IsTakenForOneInAnotherLatchedStopToo) {
  Loading run(1, start_pose(), events_.fd());
  until(run, BERM_PHASE_SWING_TO_TRUCK);
  run.go(1.0);
  slip(run, x_, y_, BERM_STOP_EMERGENCY);
  EXPECT_EQ(events_.named("base_moved").size(), 1u);
  EXPECT_EQ(run.sequencer.bed(), nullptr);
}

TEST_F(SequencerSlips, AnotherLatchedStopForgetsNothing) {
  Loading run(1, start_pose(), events_.fd());
  until(run, BERM_PHASE_SWING_TO_TRUCK);
  run.go(1.0);
  run.plant.stop_reason = BERM_STOP_EMERGENCY;
  run.plant.kernel_runs = false;
  run.go(5.0);
  run.plant.kernel_runs = true;
  run.go(30.0);
  EXPECT_TRUE(events_.named("base_moved").empty());
  EXPECT_EQ(run.finder.looks.size(), 1u);
  EXPECT_GT(run.plant.site().bed_mass(), 500.0);
}

// While it looks for the truck: what it has seen of it until then is no part of what it looks at.
TEST_F(SequencerSlips, BeforeTheTruckIsRecognisedAllIsLookedAtAnew) {
  for (const double looked_s : {1.0, 4.0, 7.0}) {
    Loading run(1, start_pose(), events_.fd(), half_loads());
    const std::size_t slips = events_.named("base_moved").size();
    run.go(looked_s);
    ASSERT_EQ(run.sequencer.bed(), nullptr) << "recognised by then: this test asks for a bed that is not known";
    ASSERT_GT(cells_known(run), 0);
    slip(run);
    EXPECT_EQ(known_after_reset_, 0) << "the old terrain is used on, " << looked_s << " s from the start";
    EXPECT_EQ(run.sequencer.bed(), nullptr);
    while (run.sequencer.bed() == nullptr && run.seconds < 120.0) run.step();
    ASSERT_NE(run.sequencer.bed(), nullptr) << "never looked at again, " << looked_s << " s from the start";
    EXPECT_NEAR(events_.named("recognised").back().at("x_m").get<double>(), app_bench::bench_bed().centre_x - x_, 1e-6);
    EXPECT_GT(cells_known(run), 500);
    ASSERT_EQ(events_.named("base_moved").size(), slips + 1);
    EXPECT_EQ(events_.named("base_moved").back().at("brings_load"), false);
    EXPECT_EQ(events_.named("base_moved").back().at("loaded_kg"), 0.0);
    EXPECT_EQ(calls("work stands") + calls("no_truck"), 0);
    if (looked_s == 4.0) expect_loaded(run);  // one of them for all
  }
}

// Nobody stands there yet.
TEST_F(SequencerSlips, WhileATruckIsWaitedForTheNextIsLoadedWhereItComes) {
  Loading run(1, start_pose(), events_.fd(), half_loads());
  run.plant.truck_parked = false;
  run.go(25.0);
  ASSERT_TRUE(events_.named("recognised").empty());
  slip(run);
  EXPECT_EQ(known_after_reset_, 0);
  run.go(20.0);
  EXPECT_TRUE(run.finder.looks.empty()) << "it looks for a truck that is not there";
  EXPECT_TRUE(events_.named("dig").empty());
  run.plant.truck_parked = true;
  expect_loaded(run);
  EXPECT_EQ(run.finder.looks.size(), 1u);
  EXPECT_EQ(events_.named("base_moved").size(), 1u);
}

// As the kernel has it, so that a bucket over it may be led away.
TEST(PassOver, ATruckThatIsAdmittedButNotRecognised) {
  SiteModel site = app_bench::bench();
  const double over_ground = pass_over_limit(site, -0.7, 6.75);
  site.truck_admitted = true;
  EXPECT_GT(pass_over_limit(site, -0.7, 6.75), over_ground);
  EXPECT_EQ(pass_over_limit(site, -0.7, 6.75), site.truck_zones.front().ceiling);
}

// Of a move that was asked for the distance is known.
TEST_F(SequencerSlips, AMoveThatWasAskedForIsNone) {
  Loading run(2, start_pose(), events_.fd());
  while (events_.named("move_back").empty() && run.seconds < 600.0) {
    run.step();
    if (!events_.named("truck_full").empty()) run.plant.truck_parked = false;
  }
  ASSERT_EQ(events_.named("move_back").size(), 1u);
  run.go(25.0);
  slip(run, -1.0, 0.0);
  run.go(5.0);
  EXPECT_TRUE(events_.named("base_moved").empty());
  EXPECT_EQ(events_.named("moved").size(), 1u);
}

}  // namespace
