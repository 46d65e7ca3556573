// The sequencer loads trucks on the miniature bench, and touches nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

void expect_no_contact(const Loading& run) {
  const app_bench::Findings& f = run.plant.findings();
  EXPECT_EQ(f.wall_contacts, 0) << "lowest over the truck: " << f.lowest_over_truck;
  EXPECT_EQ(f.ground_contacts, 0);
  EXPECT_EQ(f.floor_contacts, 0);
  EXPECT_EQ(f.range_contacts, 0);
}

// In the kernel's map: the cell at x, y is this high.
void show_height(Loading& run, double x, double y, double top_m) {
  berm_state_segment& segment = run.plant.mutable_segment();
  const auto index = [&](double v) { return static_cast<int>(std::floor((1e3 * v - segment.map_origin_mm) / segment.cell_mm)); };
  segment.map_height_mm[index(y)][index(x)] = static_cast<std::int32_t>(1e3 * top_m);
}

TEST(Sequencer, NothingMovesBeforeBothScannersHaveSweptTheirRange) {
  Loading run(1, start_pose());
  double left_low = 1e9, left_high = -1e9, right_low = 1e9, right_high = -1e9;
  while (run.seconds < 30.0) {
    run.step();
    const berm_state& s = run.plant.state();
    const bool moves = std::any_of(run.last.velocity.begin(), run.last.velocity.end(), [](double v) { return v != 0.0; });
    if (moves) break;
    left_low = std::min(left_low, s.pan_angle_urad[0] * 1e-6);
    left_high = std::max(left_high, s.pan_angle_urad[0] * 1e-6);
    right_low = std::min(right_low, s.pan_angle_urad[1] * 1e-6);
    right_high = std::max(right_high, s.pan_angle_urad[1] * 1e-6);
  }
  ASSERT_LT(run.seconds, 30.0) << "it never moved";
  EXPECT_LT(left_low, radians(-16.0));
  EXPECT_GT(left_high, radians(126.0));
  EXPECT_LT(right_low, radians(-126.0));
  EXPECT_GT(right_high, radians(16.0));
}

TEST(Sequencer, LoadsOneTruck) {
  Loading run(1, start_pose());
  while (!run.sequencer.finished() && run.seconds < 600.0) run.step();
  ASSERT_TRUE(run.sequencer.finished()) << "not loaded after " << run.seconds << " s: " << run.plant.site().bed_mass() << " kg";
  expect_no_contact(run);
  const double target = app_bench::bench().place.target_kg;
  EXPECT_GE(run.plant.site().bed_mass(), 0.96 * target);
  EXPECT_LE(run.plant.site().bed_mass(), 1.04 * target);
  EXPECT_LT(run.plant.site().spilled_mass(), 0.02 * target);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(run.plant.site().third(i), target / 3.0, 0.35 * target / 3.0) << "third " << i;
  EXPECT_EQ(run.plant.findings().unseen_cells, 0);
  EXPECT_LT(run.plant.findings().most_azimuth_rate, radians(50.0));
  EXPECT_LT(run.seconds, 12.0 * 25.0 + 30.0);
}

// What is dug on the truck's side goes to the bed's far end, and what is dug beyond to its near end; after either the next dig lies the other way.
TEST(Sequencer, NoPassSwingsFarBothWays) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  while (events.named("pass").size() < 9 && run.seconds < 400.0) run.step();
  const auto passes = events.named("pass"), scripts = events.named("script");
  ASSERT_GE(passes.size(), 9U);
  ASSERT_GE(scripts.size(), passes.size());
  const TruckBed bed = app_bench::bench_bed();
  const double dig_middle = degrees(middle_of_digs(app_bench::bench())), bed_middle = degrees(std::atan2(bed.centre_y, bed.centre_x));
  double to_truck = 0.0, back = 0.0;
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const double dump = scripts[k].at("truck_bearing_deg").get<double>() - bed_middle;
    to_truck += dump * (passes[k].at("dig_bearing_deg").get<double>() - dig_middle);
    if (k + 1 < passes.size()) back += dump * (passes[k + 1].at("dig_bearing_deg").get<double>() - dig_middle);
  }
  EXPECT_GT(to_truck, 0.0);
  EXPECT_GT(back, 0.0);
}

TEST(Sequencer, GoesOnAfterTheKernelStoppedItInTheSwing) {
  Loading run(1, start_pose());
  while (run.last.phase != BERM_PHASE_SWING_TO_TRUCK && run.seconds < 60.0) run.step();
  ASSERT_LT(run.seconds, 60.0);
  for (int k = 0; k < 100; ++k) run.step();
  run.plant.kernel_runs = false;
  run.step();  // still answers the cycle before
  const MachineModel& m = run.machine;
  for (int k = 0; k < 500; ++k) {
    run.step();
    for (std::size_t j = 0; j < joints; ++j) ASSERT_LE(std::fabs(run.last.velocity[j]), m.joint[j].creep_velocity) << "while stopped";
  }
  run.plant.kernel_runs = true;
  const double resumed = run.seconds;
  while (run.plant.site().bed_mass() < 1000.0 && run.seconds < resumed + 30.0) run.step();
  EXPECT_GE(run.plant.site().bed_mass(), 1000.0) << "the pass did not go on";
  expect_no_contact(run);
}

// Stopped over the truck with its bucket emptied, and carried on its way back by what mends the stop: the script's marks on that way are passed when it goes
// on. It once waited for them for ever, over the dig.
TEST(Sequencer, GoesOnWhenTheSwingWasCarriedPastItsMarksMeanwhile) {
  for (const double left_deg : {70.0, 45.0, 10.0}) {
    Loading run(1, start_pose());
    while (run.last.phase != BERM_PHASE_SWING_TO_DIG && run.seconds < 90.0) run.step();
    while (run.last.phase != BERM_PHASE_DUMP && run.seconds < 90.0) run.step();
    while (run.last.phase == BERM_PHASE_DUMP && run.seconds < 90.0) run.step();
    ASSERT_LT(run.seconds, 90.0);
    for (int k = 0; k < 20; ++k) run.step();
    const double bearing = degrees(run.plant.angle()[swing]);
    ASSERT_GT(bearing, 72.0) << "still over the truck";
    run.plant.kernel_runs = false;
    for (int k = 0; k < 100; ++k) run.step();
    run.plant.put(swing, radians(left_deg));
    for (int k = 0; k < 100; ++k) run.step();
    run.plant.kernel_runs = true;
    const double resumed = run.seconds;
    while (run.last.phase != BERM_PHASE_DIG && run.seconds < resumed + 30.0) run.step();
    EXPECT_LT(run.seconds, resumed + 30.0) << "it never came to the dig, from " << left_deg << " degrees";
  }
}

// Stopped while it is lowered over the dig, and carried back towards the truck by what mends the stop: it is raised before it swings to the dig again, not
// lowered where it is.
TEST(Sequencer, IsNotLoweredWhereTheSwingWasCarriedMeanwhile) {
  Loading run(1, start_pose());
  while (run.last.phase != BERM_PHASE_DUMP && run.seconds < 90.0) run.step();
  while (run.last.phase != BERM_PHASE_SWING_TO_DIG && run.seconds < 90.0) run.step();
  double boom_high = -10.0;
  while (run.last.phase != BERM_PHASE_DIG && run.plant.angle()[boom] > boom_high - radians(9.0) && run.seconds < 90.0) {
    run.step();
    boom_high = std::max(boom_high, run.plant.angle()[boom]);
  }
  ASSERT_EQ(run.last.phase, BERM_PHASE_SWING_TO_DIG) << "it was to be on its way down";
  const double dig_deg = degrees(run.plant.angle()[swing]);
  run.plant.kernel_runs = false;
  for (int k = 0; k < 100; ++k) run.step();
  run.plant.put(swing, radians(dig_deg + 24.0));
  for (int k = 0; k < 100; ++k) run.step();
  const double low_deg = degrees(run.plant.angle()[boom]);
  run.plant.kernel_runs = true;
  const double resumed = run.seconds;
  while (run.last.phase != BERM_PHASE_DIG && run.seconds < resumed + 30.0) {
    run.step();
    const double before_deg = degrees(run.plant.angle()[swing]) - dig_deg;
    if (before_deg > 12.0) {
      ASSERT_GT(degrees(run.plant.angle()[boom]), low_deg - 1.5) << before_deg << " degrees before the dig";
    }
  }
  EXPECT_LT(run.seconds, resumed + 30.0) << "it never came to the dig";
  expect_no_contact(run);
}

// What mends a stop on the way back may carry the bucket over the bed again. The truck is full; but it is not sent off, nor anybody told that it is, from under
// the bucket.
TEST(Sequencer, AFullTruckIsNotSentOffFromUnderTheBucket) {
  const app_bench::Events events;
  SiteModel site = app_bench::bench();
  site.place.target_kg = 1300.0;
  Loading run(1, start_pose(), events.fd(), site);
  while (run.last.phase != BERM_PHASE_DUMP && run.seconds < 90.0) run.step();
  const double bed = run.plant.angle()[swing];
  while (run.last.phase != BERM_PHASE_SWING_TO_DIG && run.seconds < 90.0) run.step();
  ASSERT_LT(run.seconds, 90.0);
  for (int k = 0; k < 200; ++k) run.step();
  run.plant.kernel_runs = false;
  for (int k = 0; k < 100; ++k) run.step();
  run.plant.put(swing, bed);
  for (int k = 0; k < 100; ++k) run.step();
  run.plant.kernel_runs = true;
  const double resumed = run.seconds;
  while (std::fabs(run.plant.angle()[swing] - bed) < radians(15.0) && run.seconds < resumed + 10.0) run.step();
  run.plant.kernel_runs = false;  // and once more, on its way off
  for (int k = 0; k < 100; ++k) run.step();
  run.plant.put(swing, bed);
  for (int k = 0; k < 100; ++k) run.step();
  run.plant.kernel_runs = true;
  while (!run.last.horn && run.seconds < resumed + 40.0) {
    ASSERT_TRUE(events.named("truck_full").empty());
    for (int k = 0; k < 10 && !run.last.horn; ++k) run.step();
  }
  EXPECT_TRUE(run.last.horn);
  EXPECT_EQ(events.named("truck_full").size(), 1U);
  EXPECT_EQ(events.named("pass").size(), 1U);
  EXPECT_GT(std::fabs(run.plant.angle()[swing] - bed), radians(40.0));
  expect_no_contact(run);
}

// A thing under the arm that the kernel does not let it pass over: while it stands in the kernel's map nothing is tried; but the truck stays, and its cab is
// gone round.
TEST(Sequencer, TriesNothingWhileWhatIsTooHighStands) {
  struct Case { double x, y; bool waits; };
  for (const Case& at : {Case{2.25, 3.75, true}, Case{-4.05, 6.75, false}}) {
    Loading run(1, start_pose());
    while (run.last.phase != BERM_PHASE_SWING_TO_TRUCK && run.seconds < 60.0) run.step();
    ASSERT_LT(run.seconds, 60.0);
    for (int k = 0; k < 50; ++k) run.step();
    const auto show = [&](double top_m) {
      show_height(run, at.x, at.y, top_m);
      berm_state_segment& segment = run.plant.mutable_segment();
      segment.state.blocked_x_mm = static_cast<std::int32_t>(1e3 * at.x);
      segment.state.blocked_y_mm = static_cast<std::int32_t>(1e3 * at.y);
    };
    const auto steps = [&](int cycles, double top_m) {
      bool moves = false;
      for (int k = 0; k < cycles; ++k) {
        run.step();
        show(top_m);
        moves = moves || std::any_of(run.last.velocity.begin(), run.last.velocity.end(), [](double v) { return std::fabs(v) > radians(1.0); });
      }
      return moves;
    };
    run.plant.stop_reason = BERM_STOP_OVERPASS;
    run.plant.kernel_runs = false;
    steps(50, 1.4);
    run.plant.kernel_runs = true;
    steps(1, 1.4);
    EXPECT_NE(steps(500, 1.4), at.waits) << at.x;
    EXPECT_TRUE(steps(200, 0.0)) << at.x << ": it is gone";
  }
}

// In the swing's way, and the kernel would let nothing pass over it: the arm stands before it, from where the scanners see the place, and goes on when it is gone.
TEST(Sequencer, StandsBeforeWhatIsTooHighUntilItIsGone) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  while (run.last.phase != BERM_PHASE_SWING_TO_TRUCK && run.seconds < 60.0) run.step();
  ASSERT_LT(run.seconds, 60.0);
  constexpr double x = 2.25, y = 2.55, top_m = 1.4;
  const auto step = [&](double top) {
    show_height(run, x, y, top);
    run.step();
  };
  double farthest = -1e9;
  std::array<bool, 2> low{}, high{};  // ends of the pans' ranges that are asked for
  for (int k = 0; k < 1100; ++k) {
    step(top_m);
    farthest = std::max(farthest, run.plant.angle()[swing]);
    for (std::size_t i = 0; i < 2 && !events.named("held").empty(); ++i) {
      low[i] = low[i] || run.last.pan[i].goal <= run.machine.scanner[i].pan_low;
      high[i] = high[i] || run.last.pan[i].goal >= run.machine.scanner[i].pan_high;
    }
  }
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(low[i] && high[i]) << i;
  EXPECT_LT(farthest, std::atan2(y, x) - 0.6 / std::hypot(x, y)) << "its implements are 0.6 m to either side at least";
  EXPECT_GT(farthest, radians(10.0)) << "it waits before it, not where it began";
  EXPECT_LT(std::fabs(run.last.velocity[swing]), radians(0.1));
  ASSERT_EQ(events.named("held").size(), 1u) << "and has both scanners look";
  EXPECT_EQ(events.named("held")[0].at("by"), "too high to pass over");
  EXPECT_NEAR(events.named("held")[0].at("height_m").get<double>(), top_m, 1e-9);
  for (int k = 0; k < 1000 && run.last.phase != BERM_PHASE_DUMP; ++k) step(0.0);
  EXPECT_EQ(run.last.phase, BERM_PHASE_DUMP);
  expect_no_contact(run);
}

// Two wrong returns over the truck's wall while the bucket was poured out: as high as the bucket, on the way back.
TEST(Sequencer, StandsBeforeWhatReachesUpToTheBucketToo) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  while (!(run.last.phase == BERM_PHASE_SWING_TO_DIG && run.plant.angle()[swing] > radians(60.0)) && run.seconds < 60.0) run.step();
  ASSERT_LT(run.seconds, 60.0);
  const double bearing = run.plant.angle()[swing] - radians(40.0), distance = reach_of(run.machine, run.plant.angle()) - 0.4;
  const double x = distance * std::cos(bearing), y = distance * std::sin(bearing), top_m = 2.0;
  const auto step = [&](double top) {
    show_height(run, x, y, top);
    run.step();
  };
  double farthest = 1e9;
  for (int k = 0; k < 900; ++k) {
    step(top_m);
    farthest = std::min(farthest, run.plant.angle()[swing]);
  }
  EXPECT_GT(farthest, bearing + 0.6 / distance) << "its implements are 0.6 m to either side at least";
  EXPECT_GE(events.named("held").size(), 1u) << "and has both scanners look";
  for (int k = 0; k < 1000 && run.last.phase != BERM_PHASE_DIG; ++k) step(0.0);
  EXPECT_EQ(run.last.phase, BERM_PHASE_DIG);
  expect_no_contact(run);
}

// In a dig, too: there no script says where it is going.
TEST(Sequencer, IsHeldInADigAsElsewhere) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  while (run.last.phase != BERM_PHASE_DIG && run.seconds < 60.0) run.step();
  ASSERT_LT(run.seconds, 60.0);
  const double bearing = run.plant.angle()[swing] + radians(8.0), distance = 3.7;
  const double x = distance * std::cos(bearing), y = distance * std::sin(bearing);
  for (int k = 0; k < 400; ++k) {
    show_height(run, x, y, 2.0);
    run.step();
  }
  ASSERT_EQ(events.named("held").size(), 1u);
  EXPECT_EQ(run.last.phase, BERM_PHASE_DIG);
}

TEST(Sequencer, WaitsForTheTruckAndStandsMeanwhile) {
  Loading run(1, start_pose());
  run.plant.truck_parked = false;
  while (run.seconds < 30.0) {
    run.step();
    for (const double v : run.last.velocity) ASSERT_EQ(v, 0.0);
  }
  run.plant.truck_parked = true;
  bool moved = false;
  for (int k = 0; k < 200; ++k) {
    run.step();
    for (const double v : run.last.velocity) moved = moved || v != 0.0;
  }
  EXPECT_TRUE(moved);
  EXPECT_FALSE(run.last.horn);
}

// What sticks is in the bucket on the way back, when the implements' own weight is learned, and not always as much: the books are to say what came into the truck.
TEST(Sequencer, BooksWhatComesIntoTheTruckWhereSoilSticks) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  run.plant.has_pressures = true;
  run.plant.sticks = 0.12;
  std::size_t passes = 0;
  for (double bed_then = 0.0; passes < 5 && run.seconds < 300.0;) {
    for (int k = 0; k < 50; ++k) run.step();
    const auto booked = events.named("pass");
    if (booked.size() == passes) continue;
    const double came = run.plant.site().bed_mass() - bed_then;
    EXPECT_NEAR(booked.back().at("payload_kg").get<double>(), came, 15.0) << "pass " << booked.size();
    if (passes == 2) run.plant.sticks = 0.05;  // another soil
    bed_then += came;
    passes = booked.size();
  }
  EXPECT_EQ(passes, 5U);
}

// What the machine file says of the bucket is of common soil: asked for more than it holds of a light one, digs would go on with a full bucket, the longer the
// more of them came up short.
TEST(Sequencer, LearnsWhatABucketOfALightSoilWeighs) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  run.plant.has_pressures = true;
  run.plant.holds_kg = 1250.0;
  while (events.named("heaped_bucket").empty() && run.seconds < 300.0)
    for (int k = 0; k < 50; ++k) run.step();
  ASSERT_FALSE(events.named("heaped_bucket").empty());
  const auto learned = events.named("heaped_bucket").back();
  EXPECT_NEAR(learned.at("kg").get<double>(), run.plant.holds_kg, 0.02 * run.plant.holds_kg);
  const std::size_t digs = events.named("dig").size();
  while (events.named("dig").size() == digs && run.seconds < 330.0) run.step();
  ASSERT_GT(events.named("dig").size(), digs);
  EXPECT_LT(events.named("dig").back().at("goal_kg").get<double>(), run.plant.holds_kg);
}

// What runs out over the way back falls into the bed while that holds no heap; over one it slides over the walls. The shares are those that are still in the
// bucket a fifth of a second after they were weighed.
TEST(Sequencer, TurnsBackWithMoreInTheBucketWhileTheBedHoldsNoHeap) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  run.plant.has_pressures = true;
  double carried_kg = 0.0;
  std::uint32_t phase = 0;
  int empty_bed = 0, heap = 0;
  for (std::size_t turns = 0; turns < 11 && run.seconds < 300.0; run.step()) {
    if (run.last.phase == BERM_PHASE_SWING_TO_TRUCK) carried_kg = run.plant.payload_kg();
    if (run.last.phase == BERM_PHASE_SWING_TO_DIG && phase == BERM_PHASE_DUMP) {
      ++turns;
      const auto passes = events.named("pass");
      const double loaded_kg = passes.empty() ? 0.0 : passes.back().at("loaded_kg").get<double>(), left = run.plant.payload_kg() / carried_kg;
      // Over the 1.1 m of its way back on which it runs out, half of the bucket would come over the bed's end, 2.44 m.
      const bool leaves_at_once = events.named("dump").back().at("u_m").get<double>() > 0.8, heaped = loaded_kg > 0.6 * app_bench::bench().place.target_kg;
      if (leaves_at_once) {
        EXPECT_LT(left, 0.17) << "turn " << turns;
      } else if (heaped) {
        EXPECT_LT(left, 0.37) << "turn " << turns;
        EXPECT_GT(left, 0.22) << "turn " << turns;
      } else {
        EXPECT_GT(left, 0.37) << "turn " << turns;
        EXPECT_LT(left, 0.52) << "turn " << turns;
      }
      ++(heaped ? heap : empty_bed);
    }
    phase = run.last.phase;
  }
  EXPECT_GE(empty_bed, 5);
  EXPECT_GE(heap, 3);
}

// So little sticks that nothing is done for it; but it is weighed after a dump, and the pressures are not to take it for the bucket's own.
TEST(Sequencer, BooksWhatComesIntoTheTruckWhereSoilHardlySticks) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  run.plant.has_pressures = true;
  run.plant.sticks = 0.023;
  while (events.named("pass").size() < 6 && run.seconds < 300.0)
    for (int k = 0; k < 50; ++k) run.step();
  const auto booked = events.named("pass");
  ASSERT_EQ(booked.size(), 6U);
  EXPECT_TRUE(events.named("sticking").empty());
  EXPECT_NEAR(booked.back().at("loaded_kg").get<double>(), run.plant.site().bed_mass(), 6 * 5.0);
}

// The bed's walls are taken for lower than they are, so that late in the truck heaps would slide over them: that part of a bucket is in no truck.
TEST(Sequencer, BooksNotWhatSlidesOverTheWalls) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  run.plant.has_pressures = true;
  run.finder.truck.pose.middle[2] -= 0.6;
  run.finder.truck.height -= 0.6;
  constexpr double most_of_it_kg = 15.9e3;
  double loaded_kg = 0.0;
  while (loaded_kg < most_of_it_kg && run.seconds < 400.0) {
    for (int k = 0; k < 50; ++k) run.step();
    const auto passes = events.named("pass");
    loaded_kg = passes.empty() ? 0.0 : passes.back().at("loaded_kg").get<double>();
  }
  ASSERT_GT(loaded_kg, most_of_it_kg);
  const auto booked = events.named("pass");
  EXPECT_EQ(booked[0].at("over_walls_kg"), 0.0);
  double over = 0.0, left = 0.0;
  for (const auto& pass : booked) {
    over += pass.at("over_walls_kg").get<double>();
    left += pass.at("carried_kg").get<double>() - pass.at("payload_kg").get<double>() - pass.at("beside_kg").get<double>();
  }
  EXPECT_GT(over, 120.0);
  EXPECT_NEAR(left, over, 60.0) << "what stays in the bucket";
}

// A part that the weighing takes for poured before the bucket has tilted: the arm waits for no pour, but goes on to the dig.
TEST(Sequencer, APartThatIsPouredAtOnceEndsItsPass) {
  const app_bench::Events events;
  SiteModel site = app_bench::bench();
  site.place.target_kg = 2600.0;
  Loading run(1, start_pose(), events.fd(), site);
  while (events.named("part").empty() && run.seconds < 120.0)
    for (int k = 0; k < 10; ++k) run.step();
  ASSERT_EQ(events.named("part").size(), 1U);
  const auto part = events.named("part")[0];
  const std::size_t before = events.named("pass").size();
  run.plant.weighing_error_kg = part.at("keeps_kg").get<double>() - part.at("payload_kg").get<double>();
  for (int k = 0; k < 1600; ++k) run.step();
  EXPECT_EQ(events.named("pass").size(), before + 1) << "it stands";
  EXPECT_EQ(events.named("stands").size(), 0U);
  expect_no_contact(run);
}

// The on-board weighing fails after the first pass: a second whole bucket would overload this truck, and the cylinders' pressures say so.
TEST(Sequencer, ABucketThatTheWeighingHasNotSeenIsWeighedByThePressures) {
  const app_bench::Events events;
  SiteModel site = app_bench::bench();
  site.place.target_kg = 2200.0;
  Loading run(1, start_pose(), events.fd(), site);
  run.plant.has_pressures = true;
  while (events.named("pass").empty() && run.seconds < 90.0)
    for (int k = 0; k < 10; ++k) run.step();
  run.plant.weighs = false;
  double lifted_kg = 0.0;
  while (!run.sequencer.finished() && run.seconds < 200.0) {
    run.step();
    lifted_kg = std::max(lifted_kg, run.plant.payload_kg());
  }
  EXPECT_TRUE(run.sequencer.finished());
  const auto parts = events.named("part");
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(parts[0].at("payload_kg").get<double>(), lifted_kg, 20.0);
  EXPECT_NEAR(parts[0].at("loaded_kg").get<double>() + lifted_kg - parts[0].at("keeps_kg").get<double>(), TruckFill::aim_share * site.place.target_kg, 30.0);
  EXPECT_NEAR(events.named("pass").back().at("loaded_kg").get<double>(), TruckFill::aim_share * site.place.target_kg, 30.0) << "what the bucket kept is booked as loaded";
  expect_no_contact(run);
}

// Nor is it ever held level, as where the bucket's range ends: it is weighed as it swings, not booked by what it was to bring.
TEST(Sequencer, ABucketThatIsNeverLevelIsWeighedAsItSwings) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  run.plant.has_pressures = true;
  while (events.named("pass").empty() && run.seconds < 90.0) run.step();
  const double first_kg = run.plant.site().bed_mass();
  run.plant.weighs = false;
  while (run.last.phase != BERM_PHASE_SWING_TO_TRUCK && run.seconds < 120.0) run.step();
  run.plant.take(0.3 * run.plant.payload_kg());
  const double carried_kg = run.plant.payload_kg();
  constexpr double lowest = radians(-160.0);
  while (events.named("pass").size() < 2 && run.seconds < 150.0) {
    const Joints angle = run.plant.angle();
    run.plant.put(bucket, std::max(angle[bucket], lowest - angle[boom] - angle[stick]));
    run.step();
  }
  ASSERT_EQ(events.named("pass").size(), 2U);
  const auto pass = events.named("pass")[1];
  EXPECT_GT(std::abs(events.named("dig")[1].at("goal_kg").get<double>() - carried_kg), 200.0) << "it brought what it was to: the test shows nothing";
  EXPECT_NEAR(pass.at("carried_kg").get<double>(), carried_kg, 30.0);
  EXPECT_NEAR(pass.at("payload_kg").get<double>(), run.plant.site().bed_mass() - first_kg, 30.0);
  expect_no_contact(run);
}

// Somebody else took the soil: the weighing shows nothing, and that is what is booked, not what was planned.
TEST(Sequencer, ABucketThatWasWeighedToHoldNothingIsBookedEmpty) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  while (run.last.phase != BERM_PHASE_DIG && run.seconds < 60.0) run.step();
  for (double r = 4.6; r < 8.4; r += 0.05) run.plant.site().cut(r, 0.0, 0.0, 1.6, -3.2);
  while (events.named("pass").empty() && run.seconds < 120.0)
    for (int k = 0; k < 10; ++k) run.step();
  const auto passes = events.named("pass");
  ASSERT_EQ(passes.size(), 1U);
  ASSERT_EQ(run.plant.site().bed_mass(), 0.0) << "there was soil: the test shows nothing";
  EXPECT_EQ(passes[0].at("payload_kg").get<double>(), 0.0);
}

// A bucket that stays low hides the ground round it until that is too old to move over. Here the face is dug out when the next truck is due: up, and ahead of
// the machine for the bench move.
TEST(Sequencer, WaitsForABenchMoveWithTheImplementsUpAndAhead) {
  const app_bench::Events events;
  Loading run(2, start_pose(), events.fd());
  while (!run.last.horn && run.seconds < 600.0) run.step();
  ASSERT_TRUE(run.last.horn) << "the first truck is not full after " << run.seconds << " s";
  const double boom_then = radians(14.0);
  run.plant.put(boom, boom_then);  // as low as after a pass that was not to be the last
  const SiteModel site = app_bench::bench();
  while (run.last.horn) run.step();
  run.plant.truck_parked = false;
  for (int k = 0; k < 1500; ++k) run.step();
  ASSERT_EQ(events.named("move_back").size(), 1U);
  EXPECT_GT(run.plant.state().joint_angle_urad[boom] * 1e-6, boom_then + radians(15.0)) << "it stood low over the dig";
  EXPECT_NEAR(run.plant.state().joint_angle_urad[swing] * 1e-6, 0.5 * (site.dig_swing_left + site.dig_swing_right), radians(1.5));
  for (const double v : run.last.velocity) EXPECT_EQ(v, 0.0) << "and stands";
  expect_no_contact(run);
}

// Where the face has enough for the next truck, so that the machine is not to be moved.
TEST(Sequencer, WaitsWithTheImplementsUpBeforeAFaceThatIsNotDugOut) {
  SiteModel site = app_bench::bench();
  site.place.target_kg = 8000.0;
  Loading run(2, start_pose(), std::getenv("BERM_TEST_VERBOSE") ? 1 : -1, site);
  while (!run.last.horn && run.seconds < 600.0) run.step();
  ASSERT_TRUE(run.last.horn) << "the first truck is not full after " << run.seconds << " s";
  const double boom_then = radians(14.0);
  run.plant.put(boom, boom_then);  // as low as after a pass that was not to be the last
  while (run.last.horn) run.step();
  run.plant.truck_parked = false;
  for (int k = 0; k < 1500; ++k) run.step();
  EXPECT_GT(run.plant.state().joint_angle_urad[boom] * 1e-6, boom_then + radians(15.0)) << "it stood low over the dig";
  const double waits = run.plant.state().joint_angle_urad[swing] * 1e-6;
  EXPECT_GT(waits, radians(15.0)) << "where the next truck's place is seen";
  const ArmPoints arm = forward(run.machine, run.plant.angle());
  const double reach = std::max(arm.stick_pin.r, arm.bucket_pin.r);
  EXPECT_LT(reach * std::sin(waits) + 0.5 * bucket_width(run.machine), site.dig_zones.front().y_high) << "over the dig zone: trucks pass beside it";
  for (const double v : run.last.velocity) EXPECT_NEAR(v, 0.0, radians(0.3)) << "and stands";
  expect_no_contact(run);
}

}  // namespace
