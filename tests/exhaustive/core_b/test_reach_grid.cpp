// Every speed and column of small tables; small joints whose figures are whole, against the way summed up piece by piece.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reach_parameters.hpp"

namespace berm::core_test {
namespace {

// The ground under the speed from start, rising with the acceleration to the cap, over one second: the fastest speed, and the way.
struct Way {
  double speed, way;
};
Way fastest_way(double start, double cap, double acceleration) {
  const double ramp = std::clamp((cap - start) / acceleration, 0.0, 1.0);
  const double speed = start + acceleration * ramp;
  return {speed, 0.5 * (start + speed) * ramp + speed * (1.0 - ramp)};
}

// Where the joint gets at most in the direction in which these count positive.
Way farthest(int velocity, int command, int error, int velocity_max, int acceleration, bool commanded) {
  double cap = velocity_max;
  if (commanded) cap = std::min(cap, static_cast<double>(std::max(velocity + error, command) + error));
  return fastest_way(std::min<double>(velocity + error, cap), cap, acceleration);
}

constexpr double kRounding = 1e-9;  // of the doubles here

// On the chord from the column before, rounded up to whole microradians.
double chord(const berm_parameters& p, int row, int column, double speed) {
  const auto& angle = p.brake_angle_urad[1][row];
  if (column == 0) return angle[0];
  const int before = p.velocity_max_urad_s[1] * (column - 1) / 7, at = p.velocity_max_urad_s[1] * column / 7;
  return angle[column - 1] + std::ceil((angle[column] - angle[column - 1]) * (speed - before) / (at - before) - kRounding);
}

void expect_side(const berm_parameters& p, int extent, const Way& w) {
  if (w.speed <= kRounding) {
    ASSERT_EQ(extent, 0);
    return;
  }
  const int column = [&] {
    for (int c = 0; c < 8; ++c)
      if (p.velocity_max_urad_s[1] * c / 7 >= w.speed - kRounding) return c;
    return 99;
  }();
  ASSERT_LT(column, 8);
  const double travel = extent - chord(p, 2, column, std::ceil(w.speed - kRounding)), way = std::max(w.way, 0.0);
  ASSERT_GE(travel, way - kRounding);
  ASSERT_LE(travel, way + 2.0);
}

}  // namespace

// verifies: SK-RB-2
TEST(ReachGrid, EverySpeedOfSmallTables) {
  berm_parameters p = reach_parameters();
  for (int velocity_max = 0; velocity_max <= 300; ++velocity_max) {
    p.velocity_max_urad_s[1] = velocity_max;
    for (int speed = -3; speed <= velocity_max + 3; ++speed) {
      int column = -1;
      for (int c = 7; c >= 0; --c)
        if (velocity_max * c / 7 >= speed) column = c;
      for (int row = 0; row < BERM_BRAKE_REACHES; ++row) {
        ASSERT_EQ(sk_brake_angle(&p, 1, row, speed), column < 0 ? -1 : chord(p, row, column, speed)) << velocity_max << " " << speed;
      }
    }
  }
}

// verifies: SK-RB-1
TEST(ReachGrid, EveryReach) {
  const berm_parameters p = reach_parameters();
  for (int reach_mm = -10; reach_mm <= 15'000; ++reach_mm) {
    const int row = std::max(0, (reach_mm + 2'999) / 3'000 - 1);
    ASSERT_EQ(sk_brake_row(&p, reach_mm), row > 3 ? -1 : row) << reach_mm;
  }
}

// verifies: SK-RB-3, SK-RB-4, SK-RB-5, SK-RB-7, SK-RB-8
TEST(ReachGrid, SmallJoints) {
  berm_parameters p = reach_parameters();
  p.state_latency_us = 300'000;  // one second in all
  p.cycle_us = 200'000;
  p.command_latency_us = 500'000;
  p.angle_error_urad[1] = 3;
  long accepted = 0;
  for (int velocity_max = 0; velocity_max <= 9; ++velocity_max)
    for (int acceleration = 1; acceleration <= 12; ++acceleration)
      for (int error = 0; error <= 2; ++error) {
        p.velocity_max_urad_s[1] = velocity_max;
        p.acceleration_max_urad_s2[1] = acceleration;
        p.velocity_error_urad_s[1] = error;
        for (int velocity = -12; velocity <= 12; ++velocity)
          for (int low = -6; low <= 7; ++low)
            for (int high = low; high <= 7; ++high) {
              const bool commanded = low < 7;  // the last of the grid stands for any command
              sk_reach_box box = untouched_box();
              const bool ok = sk_reach_joint(&p, 1, 2, 100, velocity, commanded ? SK_REACH_COMMANDED : SK_REACH_ANY, low, high, &box);
              ASSERT_EQ(ok, std::abs(velocity) <= velocity_max + error);
              if (!ok) {
                ASSERT_TRUE(same(box, untouched_box()));
                continue;
              }
              ++accepted;
              const Way up = farthest(velocity, high, error, velocity_max, acceleration, commanded);
              const Way down = farthest(-velocity, -low, error, velocity_max, acceleration, commanded);
              SCOPED_TRACE(testing::Message() << "velocity_max " << velocity_max << " acceleration " << acceleration << " error " << error
                                              << " velocity " << velocity << " commands " << low << " " << high);
              expect_side(p, box.high_urad[1] - 103, up);
              expect_side(p, 97 - box.low_urad[1], down);
              ASSERT_NEAR(box.speed_urad_s[1], std::max({0.0, up.speed, down.speed}), kRounding);
              if (testing::Test::HasFatalFailure()) return;
            }
      }
  EXPECT_GT(accepted, 300'000);
}

// Whether a row is needed: only where the joint can come to move.
// verifies: SK-RB-9
TEST(ReachGrid, RowsThatAreNotThere) {
  berm_parameters p = reach_parameters();
  p.state_latency_us = p.cycle_us = p.command_latency_us = 0;
  p.velocity_error_urad_s[1] = 0;
  for (int velocity_max = 0; velocity_max <= 3; ++velocity_max)
    for (int velocity = -velocity_max; velocity <= velocity_max; ++velocity)
      for (const int row : {-1, 0, 3, 4}) {
        p.velocity_max_urad_s[1] = velocity_max;
        sk_reach_box box = untouched_box();
        const bool there = row >= 0 && row < 4;
        ASSERT_EQ(sk_reach_joint(&p, 1, row, 0, velocity, SK_REACH_ANY, 0, 0, &box), there || velocity == 0) << velocity_max << " " << velocity;
      }
}

}  // namespace berm::core_test
