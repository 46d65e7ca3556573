// The ground round the upper body's tail, in the whole cycle: what stands there stops the swing before the tail comes to it, and needs the operator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <memory>

#include "cycle_rig.hpp"
#include "geometry/reach.hpp"

namespace berm::kernel::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNearM = 3.0, kFarM = 4.8;  // of the ring that the lidar sees
constexpr double kPersonRadiusM = 0.25;
constexpr int kTurnCycles = 10;              // the lidar goes round ten times a second
constexpr std::size_t kLatencyCycles = 8;    // the machine file has 90 ms for a command
constexpr double kSeenFromRad = 1.78;        // 102 degrees: what two lidars at the rear corners see

struct Person {
  double x_m = 0.0, y_m = 0.0, height_m = 0.0;  // absent when height is 0
};

// A machine whose tail points to the right at first; a lidar behind it sees the ring, a tenth of it each cycle.
class CycleTail : public testing::Test {
 protected:
  void begin() {
    rig = std::make_unique<CycleRig>(parameters);
    rig->face_a_swing_to_the_left();
  }
  void step() {
    rig->gather();
    if (lidar) add_ring();
    rig->cycle->step(*rig->in, *rig->out);
    rig->obey();
    if (latency_cycles > 0) obey_later();
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  bool reach_state(int wanted, int limit) {
    for (int i = 0; i < limit; ++i) {
      step();
      if (state().kernel_state == wanted) return true;
    }
    return false;
  }
  void run() {
    begin();
    ASSERT_TRUE(reach_state(BERM_STATE_RUN, 1500)) << why();
    steps(1000);  // both sides swept
  }
  // The scanners do, their beams that go round the back too.
  void look_to_the_side() {
    rig->machine.pan_low_rad = 0.9;
    rig->machine.pan_high_rad = 1.1;
  }
  const berm_state& state() const { return rig->state(); }
  double swing() const { return rig->machine.angle_rad[0]; }
  std::string why() const {
    return "reason " + std::to_string(state().stop_reason) + " link " + std::to_string(state().blocked_link) + " at " + std::to_string(state().blocked_x_mm) + ", " +
           std::to_string(state().blocked_y_mm) + " height " + std::to_string(state().blocked_height_mm);
  }
  // How far the nearest point of the tail (radius and half width of the machine file) is from the person's axis.
  double tail_to_person() const {
    const double c = std::cos(swing()), s = std::sin(swing());
    const double x = person.x_m * c + person.y_m * s, y = person.y_m * c - person.x_m * s;
    const double w = parameters.tail_half_width_mm * 1e-3, back = std::sqrt(std::pow(parameters.tail_radius_mm * 1e-3, 2) - w * w);
    const double dx = std::max({0.0, x, -back - x}), dy = std::max(0.0, std::fabs(y) - w);
    return std::hypot(dx, dy);
  }
  void stand_at(double bearing_rad, double distance_m, double height_m = 1.75) {
    person = {distance_m * std::cos(bearing_rad), distance_m * std::sin(bearing_rad), height_m};
  }

  berm_parameters parameters = watched();
  bool lidar = true;
  std::size_t latency_cycles = 0;  // of the swing's command
  double seen_from_rad = 0.0;  // the lidar sees what lies behind this on either side, from the implements on
  Person person;
  std::unique_ptr<CycleRig> rig;

 private:
  static berm_parameters watched() {
    berm_parameters p = berm::test::demo_parameters();
    p.tail_watched = 1;
    return p;
  }
  void obey_later() {
    on_their_way_.push_back(rig->machine.command_rad_s[0]);
    rig->machine.command_rad_s[0] = on_their_way_.front();
    if (on_their_way_.size() > latency_cycles) on_their_way_.pop_front();
  }
  void add_ring() {
    CycleInputs& in = *rig->in;
    in.lidar_head = {0, 0, 3300};
    const int count = static_cast<int>(2 * kFarM / 0.1);
    for (int iy = 0; iy < count; ++iy) {
      for (int ix = 0; ix < count; ++ix) {
        if ((ix + iy) % kTurnCycles != static_cast<int>(rig->machine.cycle() % kTurnCycles)) continue;
        const double x = -kFarM + 0.1 * ix + 0.05, y = -kFarM + 0.1 * iy + 0.05, far = std::hypot(x, y);
        if (far < kNearM || far > kFarM || std::fabs(std::remainder(std::atan2(y, x) - swing(), 2 * kPi)) < seen_from_rad) continue;
        const bool met = person.height_m > 0 && std::hypot(x - person.x_m, y - person.y_m) < kPersonRadiusM;
        const sk_point point{static_cast<std::int32_t>(std::lround(x * 1e3)), static_cast<std::int32_t>(std::lround(y * 1e3)),
                             met ? static_cast<std::int32_t>(std::lround(person.height_m * 1e3)) : 0};
        in.footprint[in.footprint_count++] = {point, point};
      }
    }
  }

  std::deque<double> on_their_way_;
};

// verifies: SK-TS-1, IF-CF-17 (false: the kernel does not check it)
TEST_F(CycleTail, UnwatchedNothingIsCheckedAndTheStateSaysSo) {
  parameters.tail_watched = 0;
  lidar = false;
  begin();
  stand_at(0.4 + kPi + 0.8, 3.4);
  ASSERT_TRUE(reach_state(BERM_STATE_RUN, 1500)) << why();
  EXPECT_EQ(state().unwatched & BERM_UNWATCHED_TAIL, BERM_UNWATCHED_TAIL);
  steps(1000);
  rig->wanted_urad_s[0] = 300000;
  steps(400);
  EXPECT_GT(swing(), 1.0) << why();
}

// verifies: SK-TS-1
TEST_F(CycleTail, WatchedAndFreeItSwings) {
  run();
  EXPECT_EQ(state().unwatched & BERM_UNWATCHED_TAIL, 0U);
  rig->wanted_urad_s[0] = 300000;
  steps(400);
  EXPECT_GT(swing(), 1.0) << why();
}

// verifies: SK-TS-3, SK-TS-5, IF-CF-17 (where no sensor sees it again the machine stands)
TEST_F(CycleTail, GroundSeenTooLongAgoHoldsTheMachine) {
  run();
  rig->wanted_urad_s[0] = 200000;
  steps(100);
  ASSERT_EQ(state().kernel_state, BERM_STATE_RUN) << why();
  lidar = false;
  look_to_the_side();
  int until = 0;
  while (until < 300 && state().kernel_state == BERM_STATE_RUN) {
    step();
    ++until;
  }
  EXPECT_LE(until, parameters.tail_fresh_us / 10000 + 1);
  EXPECT_GE(until, parameters.tail_fresh_us / 10000 - kTurnCycles - 1);
  EXPECT_EQ(state().stop_reason, BERM_STOP_STALE_GROUND) << why();
  EXPECT_EQ(state().blocked_link, 0U);
  steps(300);
  const double stands = swing();
  rig->wanted_urad_s[0] = 20000;  // not even creeping
  steps(200);
  EXPECT_NEAR(swing(), stands, 1e-9);
  lidar = true;
  EXPECT_TRUE(reach_state(BERM_STATE_RUN, 100)) << why();  // by itself
}

// verifies: SK-TS-2, SK-TS-4, SK-TS-5, SK-TS-6, SK-TS-7
TEST_F(CycleTail, WhoStandsInTheTailsWayIsNotReachedAndTheOperatorIsNeeded) {
  run();
  stand_at(0.4 + kPi + 1.4, 3.35);
  const double side_rad = std::atan2(person.y_m, person.x_m);
  steps(200);
  ASSERT_EQ(state().kernel_state, BERM_STATE_RUN) << why();
  rig->wanted_urad_s[0] = 600000;
  double fastest = 0, nearest = 1e9;
  bool cut = false;
  for (int i = 0; i < 1500; ++i) {
    step();
    fastest = std::max(fastest, rig->machine.velocity_rad_s[0]);
    nearest = std::min(nearest, tail_to_person() - kPersonRadiusM);
    cut = cut || (state().kernel_state == BERM_STATE_RUN && state().commanded_urad_s[0] > 0 && state().commanded_urad_s[0] < 600000);
  }
  std::printf("bearing %.0f deg: fastest %.2f rad/s, stood at %.2f rad, %.2f m between tail and person\n", side_rad * 180 / kPi, fastest, swing(), nearest);
  EXPECT_GT(fastest, 0.1) << "it must have swung";
  EXPECT_TRUE(cut) << "it must have been slowed before it was stopped";
  EXPECT_GT(nearest, 0.3);
  EXPECT_EQ(state().stop_reason, BERM_STOP_TAIL) << why();
  EXPECT_EQ(state().blocked_link, 0U);
  EXPECT_LT(std::hypot(state().blocked_x_mm * 1e-3 - person.x_m, state().blocked_y_mm * 1e-3 - person.y_m), 0.6);
  EXPECT_GT(state().blocked_height_mm, 1700);
  EXPECT_EQ(state().stop_count[BERM_STOP_TAIL], 1U);

  // A reset while he stands there brings it no nearer than its creeping box. When he has left it stays where it is: it was not seen whether he went away or in.
  const auto press_reset = [&] {
    rig->machine.reset_key = false;
    steps(20);
    rig->machine.reset_key = true;
    steps(20);
    rig->machine.reset_key = false;
  };
  press_reset();
  steps(400);
  EXPECT_EQ(state().stop_reason, BERM_STOP_TAIL) << why();
  EXPECT_GT(tail_to_person() - kPersonRadiusM, 0.3);
  const double stands = swing();
  person.height_m = 0;
  steps(400);
  EXPECT_EQ(state().kernel_state, BERM_STATE_STOPPED);
  EXPECT_EQ(state().stop_reason, BERM_STOP_TAIL) << why();
  EXPECT_NEAR(swing(), stands, 1e-9);
  press_reset();
  EXPECT_TRUE(reach_state(BERM_STATE_RUN, 100)) << why();
  steps(200);
  EXPECT_GT(swing(), stands + 0.2) << why();
}

// Below the underside (1.00 m) less the margin the tail passes over; what is higher stops it, wherever it stands round the machine.
// verifies: SK-TS-2, SK-TS-4
TEST_F(CycleTail, WhatIsLowerThanTheUndersideIsPassedOver) {
  run();
  stand_at(0.4 + kPi + 1.4, 3.35, 0.65);
  rig->wanted_urad_s[0] = 300000;
  steps(700);
  EXPECT_GT(swing(), 1.9) << why();
  person.height_m = 0.75;
  stand_at(swing() + kPi + 1.2, 3.35, 0.75);
  steps(700);
  EXPECT_EQ(state().stop_reason, BERM_STOP_TAIL) << why();
}

// verifies: SK-TS-2
TEST_F(CycleTail, WhoStandsBeyondTheClearanceStopsNothing) {
  run();
  stand_at(0.4 + kPi + 1.0, 4.4);
  rig->wanted_urad_s[0] = 300000;
  steps(400);
  EXPECT_GT(swing(), 1.2) << why();
}

// What lies beside the machine no lidar sees, only now and then another sensor. While that is fresh the tail may go over it, but not so fast that it could not be slowed down to what the lidar
// sees when it is fresh no longer.
// verifies: SK-TS-7
TEST_F(CycleTail, AGlimpseOfWhatLiesBesideTheMachineDoesNotEndInAStop) {
  bool cut = false;
  double fastest = 0.0;
  latency_cycles = kLatencyCycles;
  for (const int every : {110, 130, 150, 170}) {
    run();
    seen_from_rad = kSeenFromRad;
    look_to_the_side();
    steps(150);
    rig->wanted_urad_s[0] = 800000;
    for (int i = 0; i < 400 && swing() < 2.4; ++i) {
      seen_from_rad = i % every < kTurnCycles ? 0.0 : kSeenFromRad;
      step();
      cut = cut || state().commanded_urad_s[0] < 600000;
      fastest = std::max(fastest, rig->machine.velocity_rad_s[0]);
    }
    EXPECT_EQ(state().stop_count[BERM_STOP_STALE_GROUND], 0U) << every << " cycles: " << why();
    EXPECT_GT(swing(), 1.4) << every << " cycles";
    seen_from_rad = 0.0;
  }
  EXPECT_TRUE(cut);
  EXPECT_GT(fastest, 0.35);
}

// An arm that reaches out comes from one row of the braking table to the next, and a fast swing's box is longer by a tenth of a radian in one cycle. The governor goes by the next row before:
// the swing is cut while the box still has the row before.
// verifies: SK-CY-26
TEST_F(CycleTail, TheSwingIsCutForTheNextRowShortlyBeforeTheReachComesToIt) {
  std::int32_t least_row = -1, commanded_before = 0, cut_mm = 0, edge_mm = 0;
  for (double stick_deg = -70.0; stick_deg < -50.0 && edge_mm == 0; stick_deg += 0.5) {
    begin();
    rig->machine.angle_rad[2] = stick_deg * kPi / 180.0;
    ASSERT_TRUE(reach_state(BERM_STATE_RUN, 1500)) << why();
    steps(600);
    seen_from_rad = kSeenFromRad;
    look_to_the_side();
    steps(150);
    rig->wanted_urad_s[0] = 700000;
    step();
    seen_from_rad = 0.0;
    sk_reach_box box{};
    std::copy(state().reach_low_urad, state().reach_low_urad + SK_JOINTS, box.low_urad);
    std::copy(state().reach_high_urad, state().reach_high_urad + SK_JOINTS, box.high_urad);
    const std::int32_t reach_mm = max_reach_mm(parameters, box), row = sk_brake_row(&parameters, reach_mm), commanded = state().commanded_urad_s[0];
    if (least_row < 0) least_row = row;
    if (row > least_row) edge_mm = reach_mm;
    if (cut_mm == 0 && commanded < commanded_before) cut_mm = reach_mm;
    commanded_before = commanded;
  }
  std::printf("the swing is cut from a reach of %d mm on, the row another from %d\n", cut_mm, edge_mm);
  ASSERT_GT(cut_mm, 0);
  ASSERT_GT(edge_mm, 0);
  EXPECT_GE(edge_mm - cut_mm, 100);
  EXPECT_LE(edge_mm - cut_mm, 200);
}

// The tail stands; whoever comes up to it, from any side but the front, is seen at the clearance.
// verifies: SK-TS-2, SK-TS-6
TEST_F(CycleTail, WhoComesUpToAStandingTailIsSeen) {
  for (const double off_rad : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
    run();
    stand_at(swing() + kPi + off_rad, 3.4);
    steps(100);
    EXPECT_EQ(state().stop_reason, BERM_STOP_TAIL) << off_rad << ": " << why();
    EXPECT_NE(state().kernel_state, BERM_STATE_RUN);
    person = {};
  }
}

}  // namespace
}  // namespace berm::kernel::test
