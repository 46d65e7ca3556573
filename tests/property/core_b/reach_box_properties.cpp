// Joints that do what they may, against the box. A failure prints its seed (RC_PARAMS="seed=..." repeats it).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "draw.hpp"
#include "reach_parameters.hpp"
#include "simulated_joint.hpp"
#include "valid_parameters.hpp"

namespace berm::core_test {
namespace {

constexpr double kRounding = 1e-4;  // urad, of the simulation's doubles

std::int32_t any_scale(std::int32_t low, std::int32_t high) {  // small figures as often as large ones
  return std::max(low, draw(low, high) >> draw(0, 20));
}

berm_parameters random_parameters() {
  berm_parameters p = reach_parameters();
  p.state_latency_us = any_scale(0, 1'000'000);
  p.cycle_us = any_scale(0, 1'000'000);
  p.command_latency_us = any_scale(0, 1'000'000);
  for (int joint = 0; joint < SK_JOINTS; ++joint) {
    p.velocity_max_urad_s[joint] = any_scale(1, 5'000'000);
    p.acceleration_max_urad_s2[joint] = any_scale(1, 100'000'000);
    p.angle_error_urad[joint] = any_scale(0, 1'000'000);
    p.velocity_error_urad_s[joint] = any_scale(0, 1'000'000);
    for (int row = 0; row < BERM_BRAKE_REACHES; ++row)
      for (int column = 1; column < BERM_BRAKE_SPEEDS; ++column) {
        const std::int32_t slower = p.brake_angle_urad[joint][row][column - 1], nearer = row > 0 ? p.brake_angle_urad[joint][row - 1][column] : 0;
        p.brake_angle_urad[joint][row][column] = std::max(slower, nearer) + draw(0, 1'000'000);
      }
  }
  return p;
}

const berm_parameters& demonstration_machine() {
  static const berm_parameters p = valid_parameters();
  return p;
}

struct Situation {
  berm_parameters p;
  std::int32_t joint, row, angle_urad, velocity_urad_s, mode, low_urad_s, high_urad_s;

  bool box(sk_reach_box& out) const { return sk_reach_joint(&p, joint, row, angle_urad, velocity_urad_s, mode, low_urad_s, high_urad_s, &out); }
  double velocity_max() const { return p.velocity_max_urad_s[joint]; }
  double velocity_error() const { return p.velocity_error_urad_s[joint]; }
  double delay_s() const { return (p.state_latency_us + p.cycle_us + p.command_latency_us) * 1e-6; }
  double stop_angle_at(double speed) const {
    std::array<double, 8> table{};
    for (std::size_t column = 0; column < 8; ++column) table[column] = p.brake_angle_urad[joint][row][column];
    return stop_angle(table, velocity_max(), speed);
  }
  // What the joint's speed is held between, when it starts with this speed.
  SimulatedJoint::Limits limits(double start) const {
    SimulatedJoint::Limits l{static_cast<double>(p.acceleration_max_urad_s2[joint]), -velocity_max(), velocity_max()};
    if (mode == SK_REACH_COMMANDED) {
      l.speed_low = std::max(l.speed_low, std::min<double>(start, low_urad_s) - velocity_error());
      l.speed_high = std::min(l.speed_high, std::max<double>(start, high_urad_s) + velocity_error());
    }
    return l;
  }
};

Situation situation() {
  Situation s{};
  s.p = chance(30) ? demonstration_machine() : random_parameters();
  s.joint = draw(0, SK_JOINTS - 1);
  s.row = draw(0, BERM_BRAKE_REACHES - 1);
  s.angle_urad = draw(-3'000'000, 3'000'000);
  const std::int32_t fastest = std::min(s.p.velocity_max_urad_s[s.joint] + s.p.velocity_error_urad_s[s.joint], 5'000'000);
  s.velocity_urad_s = (chance(50) ? 1 : -1) * any_scale(0, fastest);
  s.mode = chance(50) ? SK_REACH_COMMANDED : SK_REACH_ANY;
  const std::int32_t a = draw(-fastest, fastest) >> draw(0, 10), b = draw(-fastest, fastest) >> draw(0, 10);
  s.low_urad_s = std::min(a, b);
  s.high_urad_s = std::max(a, b);
  return s;
}

double fraction() { return draw(0, 1'000'000) * 1e-6; }

// Any start within the errors, any course, a stop at any time.
SimulatedJoint moved_at_random(const Situation& s) {
  const double angle = s.angle_urad + s.p.angle_error_urad[s.joint] * (2.0 * fraction() - 1.0);
  const double speed = std::clamp(s.velocity_urad_s + s.velocity_error() * (2.0 * fraction() - 1.0), -s.velocity_max(), s.velocity_max());
  SimulatedJoint joint(angle, speed, s.limits(speed));
  double left = s.delay_s() * (chance(50) ? 1.0 : fraction());
  const double most = s.p.acceleration_max_urad_s2[s.joint];
  for (int piece = draw(0, 6); piece >= 0; --piece) {
    const double duration = piece == 0 ? left : left * fraction();
    const double push = chance(70) ? most : most * fraction();
    joint.run(chance(50) ? push : -push, duration);
    left -= duration;
  }
  joint.brake(s.stop_angle_at(joint.speed()));
  return joint;
}

// Everything to one side: the errors, the acceleration, the latest stop.
SimulatedJoint pushed(const Situation& s, double sign) {
  const double speed = std::clamp(s.velocity_urad_s + sign * s.velocity_error(), -s.velocity_max(), s.velocity_max());
  SimulatedJoint joint(s.angle_urad + sign * s.p.angle_error_urad[s.joint], speed, s.limits(speed));
  joint.run(sign * s.p.acceleration_max_urad_s2[s.joint], s.delay_s());
  return joint;
}

void expect_inside(const sk_reach_box& box, const Situation& s, const SimulatedJoint& joint) {
  RC_ASSERT(joint.lowest() >= box.low_urad[s.joint] - kRounding);
  RC_ASSERT(joint.highest() <= box.high_urad[s.joint] + kRounding);
  RC_ASSERT(joint.fastest() <= box.speed_urad_s[s.joint] + kRounding);
}

}  // namespace

// verifies: SK-RB-8, SK-RB-10
TEST(ReachBoxProperties, HoldsEveryPositionReached) {
  EXPECT_TRUE(rc::check("no course of the joint leaves the box", [] {
    for (int i = 0; i < 20; ++i) {
      const Situation s = situation();
      sk_reach_box box = untouched_box();
      RC_ASSERT(s.box(box));
      for (int course = 0; course < 12; ++course) expect_inside(box, s, moved_at_random(s));
      for (const double sign : {-1.0, 1.0}) {
        SimulatedJoint joint = pushed(s, sign);
        joint.brake(s.stop_angle_at(joint.speed()));
        expect_inside(box, s, joint);
      }
    }
  }));
}

// verifies: SK-RB-4, SK-RB-5, SK-RB-6, SK-RB-7, SK-RB-11
TEST(ReachBoxProperties, EndsWhereAJointCanGet) {
  long compared = 0;
  EXPECT_TRUE(rc::check("the box ends where the joint gets that is pushed to one side", [&] {
    for (int i = 0; i < 40; ++i) {
      const Situation s = situation();
      sk_reach_box box = untouched_box();
      RC_ASSERT(s.box(box));
      double fastest = 0.0;
      for (const double sign : {-1.0, 1.0}) {
        const double end = sign > 0 ? box.high_urad[s.joint] : -box.low_urad[s.joint];
        const double start = sign * s.angle_urad + s.p.angle_error_urad[s.joint];
        const SimulatedJoint joint = pushed(s, sign);
        const double speed = sign * joint.speed(), way = sign * joint.angle() - start;
        fastest = std::max(fastest, speed);
        if (speed <= -1.0) RC_ASSERT(end == start);
        if (speed <= 0.0 || way < 0.0) continue;
        ++compared;
        RC_ASSERT(end >= start + way + s.stop_angle_at(speed) - kRounding);
        RC_ASSERT(end <= start + way + s.stop_angle_at(speed + 3.0) + 10.0);
      }
      RC_ASSERT(box.speed_urad_s[s.joint] <= fastest + 1.0 + kRounding);
    }
  }));
  EXPECT_GT(compared, 3000);
}

// verifies: SK-RB-12
TEST(ReachBoxProperties, MoreCommandsGiveAWiderBox) {
  EXPECT_TRUE(rc::check("fewer commands, more commands, any command", [] {
    Situation s = situation();
    sk_reach_box inner{}, outer{}, any{};
    s.mode = SK_REACH_COMMANDED;
    RC_ASSERT(s.box(inner));
    s.low_urad_s = std::max(-5'000'000, s.low_urad_s - any_scale(0, 1'000'000));
    s.high_urad_s = std::min(5'000'000, s.high_urad_s + any_scale(0, 1'000'000));
    RC_ASSERT(s.box(outer));
    s.mode = SK_REACH_ANY;
    RC_ASSERT(s.box(any));
    const int j = s.joint;
    // what the ramp saves is rounded down, so that a faster joint's way may come out 1 urad shorter
    RC_ASSERT(any.low_urad[j] <= outer.low_urad[j] + 1 && outer.low_urad[j] <= inner.low_urad[j] + 1);
    RC_ASSERT(inner.high_urad[j] <= outer.high_urad[j] + 1 && outer.high_urad[j] <= any.high_urad[j] + 1);
    RC_ASSERT(inner.speed_urad_s[j] <= outer.speed_urad_s[j] && outer.speed_urad_s[j] <= any.speed_urad_s[j]);
  }));
}

// verifies: SK-RB-1, SK-RB-2
TEST(ReachBoxProperties, BrakingTableIsNeverReadTooLow) {
  EXPECT_TRUE(rc::check("the row is that of the next reach, the angle on the chord to the next speed", [] {
    const berm_parameters p = chance(30) ? demonstration_machine() : random_parameters();
    const int joint = draw(0, 3), row = draw(0, 3);
    const double velocity_max = p.velocity_max_urad_s[joint];
    const std::int32_t speed = draw(0, p.velocity_max_urad_s[joint]);
    std::array<double, 8> table{};
    for (std::size_t column = 0; column < 8; ++column) table[column] = p.brake_angle_urad[joint][row][column];
    const std::int32_t angle = sk_brake_angle(&p, joint, row, speed);
    RC_ASSERT(angle >= stop_angle(table, velocity_max, speed) - 1e-6);
    RC_ASSERT(angle <= stop_angle(table, velocity_max, speed + 1.0) + 1.0);
    RC_ASSERT(sk_brake_angle(&p, joint, row, p.velocity_max_urad_s[joint] + draw(1, 1'000'000)) == -1);
    const std::int32_t reach_mm = draw(0, 15'000), found = sk_brake_row(&p, reach_mm);
    for (int r = 0; r < 4; ++r) RC_ASSERT((p.brake_reach_mm[r] >= reach_mm) == (found >= 0 && r >= found));
  }));
}

}  // namespace berm::core_test
