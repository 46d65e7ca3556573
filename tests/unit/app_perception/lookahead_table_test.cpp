// The tables of lookahead and trigger angles against swings and pans simulated moment by moment, without any of the tables' code.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app_bench/bench_machine.hpp"
#include "motion/joint_controller.hpp"
#include "perception/lookahead_table.hpp"

namespace {

using namespace berm::app;

constexpr std::array<const char*, 5> shipped{"zx200", "zx200_rear", "zx200_ring", "excavator_12t", "excavator_25t"};

// How far the swing goes on until it stands if it is stopped now, and until what is looked at now stands in the kernel's map: the braking table on the chord between
// its speeds, after the latencies at the speed that it may gain meanwhile.
double stops_in(const MachineModel& m, std::size_t row, double speed) {
  constexpr double sends_within = 0.005;
  const JointLimits& joint = m.joint[swing];
  const double gains_s = m.state_latency + m.command_latency + m.cycle, obeys_s = m.state_latency + m.command_latency + heartbeat_silence + sends_within;
  const double then = std::min(joint.velocity_max, speed + joint.velocity_error + joint.acceleration_max * gains_s);
  const std::vector<double>& braking = m.braking.angle[swing][row];
  const double column = then / joint.velocity_max * static_cast<double>(braking.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(column), braking.size() - 2);
  const double seen_s = m.state_latency + 2.0 * m.cycle;
  return braking[k] + (column - static_cast<double>(k)) * (braking[k + 1] - braking[k]) + then * obeys_s - 0.5 * joint.acceleration_max * gains_s * gains_s + speed * seen_s;
}

// The pan at which the scanner on that side looks past everything that the implements cover once they have swung on so far.
double past_implements(const MachineModel& m, double side, double swung, double reach_m) {
  constexpr double cell = 0.3, rim = 0.55;
  double half_width = 0.0, most = 0.0;
  for (const Prism& part : m.parts) half_width = std::max(half_width, part.half_width + cell);
  const ScannerMount& head = m.scanner[side > 0.0 ? 0 : 1];
  // A corner, at so far along the arm: turned about the swing axis, seen from the head.
  for (double along = m.own_body_radius + rim; along <= reach_m; along += 0.05) {
    const double ahead = std::sqrt(std::max(0.0, along * along - half_width * half_width)), c = std::cos(swung), s = std::sin(swung);
    const double x = ahead * c - half_width * s, y = side * (ahead * s + half_width * c);
    most = std::max(most, side * std::atan2(y - head.y, x - head.x));
  }
  return std::min(most, side > 0.0 ? head.pan_high : -head.pan_low);
}

// How far the pan is beyond what each moment of a swing needs, at the least: it stands at the trigger angle, obeys after its dead time and then goes outward to the
// lookahead angle, at a rate that with the swing's is no more than 38 degrees a second. The swing is the app's own, from standing to standing, of an empty bucket.
double least_room(const MachineModel& m, double side, double length, std::size_t row, const LookaheadTable::Angles& angles) {
  const ScannerMount& head = m.scanner[side > 0.0 ? 0 : 1];
  const double reach_m = m.braking.reach[row], dead_s = m.state_latency + m.command_latency;
  const ControllerLimits limits = limits_of(m, swing, reach_m, 0.0);
  JointController controller(responses_of(m, swing, reach_m, 0.0), m.cycle);
  JointModel joint(responses_of(m, swing, reach_m, 0.0), m.cycle);
  joint.reset(0.0, 0.0);
  double pan = angles.trigger, least = 1e9;
  for (double t = 0.0; t < 20.0 && side * joint.angle() < length - radians(0.1); t += m.cycle) {
    const double speed = side * joint.velocity();
    least = std::min(least, pan - past_implements(m, side, stops_in(m, row, std::max(0.0, speed)), reach_m));
    if (t >= dead_s) pan = std::min(angles.lookahead, pan + std::min(head.pan_rate_max, std::max(radians(1.0), radians(38.0) - speed)) * m.cycle);
    const double command = controller.toward(side * length, joint.angle(), joint.velocity(), limits);
    controller.sent(command);
    joint.advance(command);
  }
  return least;
}

TEST(LookaheadTable, APanThatStartsAtTheTriggerAngleIsAheadOfTheSwingAtEachMoment) {
  for (const char* name : shipped) {
    const MachineModel m = berm::app_bench::shipped_machine(name);
    const LookaheadTable table(m);
    for (const double side : {1.0, -1.0})
      for (std::size_t row = 0; row < m.braking.reach.size(); ++row)
        for (double length = 10.0; length <= 180.0; length += 8.5) {
          const double room = least_room(m, side, radians(length), row, table.of(side > 0.0 ? 0 : 1, radians(length), m.braking.reach[row]));
          EXPECT_GE(room, 0.0) << name << ", " << side * length << " degrees at " << m.braking.reach[row] << " m";
          // Tight: between the tables' lengths and speeds no more than so much is lost.
          if (length <= 20.0) continue;
          EXPECT_LE(room, radians(2.0)) << name << ", " << side * length << " degrees at " << m.braking.reach[row] << " m";
        }
  }
}

TEST(LookaheadTable, LongerFasterAndFartherOutNeedsNoLess) {
  for (const char* name : shipped) {
    const MachineModel m = berm::app_bench::shipped_machine(name);
    const LookaheadTable table(m);
    for (const std::size_t scanner : {0U, 1U}) {
      LookaheadTable::Angles shorter;
      for (double length = 0.0; length <= 200.0; length += 2.5) {
        LookaheadTable::Angles nearer;
        for (const double reach_m : m.braking.reach) {
          const LookaheadTable::Angles a = table.of(scanner, radians(length), reach_m);
          EXPECT_GE(a.lookahead, a.trigger);
          EXPECT_GE(a.lookahead, nearer.lookahead);
          EXPECT_GE(a.trigger, nearer.trigger);
          nearer = a;
        }
        const LookaheadTable::Angles a = table.of(scanner, radians(length), m.braking.reach.front());
        EXPECT_GE(a.lookahead, shorter.lookahead - 1e-9) << name << " " << length;
        EXPECT_GE(a.trigger, shorter.trigger - 1e-9) << name << " " << length;
        shorter = a;
      }
      for (double speed = 1.0; speed <= 50.0; speed += 1.0)
        EXPECT_GE(table.required(scanner, radians(speed), m.braking.reach.front()), table.required(scanner, radians(speed - 1.0), m.braking.reach.front()));
    }
  }
}

// Which comes to a higher speed before it has to brake.
TEST(LookaheadTable, AnEmptySwingThatWasLearnedToBrakeHarderIsLookedAheadOfFarther) {
  const MachineModel m = berm::app_bench::zx200();
  const LookaheadTable before(m), learned(m, 1.5 * m.joint[swing].acceleration_max);
  const double reach_m = m.braking.reach.front(), length = radians(40.0);
  EXPECT_GT(learned.of(0, length, reach_m).lookahead, before.of(0, length, reach_m).lookahead + radians(1.0));
  EXPECT_EQ(learned.empty_brake(), 1.5 * m.joint[swing].acceleration_max);
}

}  // namespace
