// From stops to the table: a bound of every stop, monotone, complete, rounded up.
#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "ideal_stop.hpp"
#include "identify/bounds.hpp"

namespace berm::identify::test {
namespace {

constexpr double kDegree = 180.0 / std::numbers::pi;
constexpr double kAllowance = 0.1;

struct Machine {
  config::MachineFile file = config::load_machine_file(BERM_MACHINE_FILE);
  double speed(std::size_t joint, std::size_t column) const { return file.joint[joint].velocity_max * static_cast<double>(column) / 7.0; }

  StopRecord stop(std::size_t joint, std::size_t row, std::size_t column, double deceleration, double share = 1.0, bool between = false) const {
    const double asked = between ? 0.5 * (speed(joint, column) + speed(joint, column - 1)) : speed(joint, column);
    IdealStop ideal;
    ideal.speed = share * asked;
    ideal.deceleration = deceleration;
    StopPlan plan;
    plan.joint = joint;
    plan.row = row;
    plan.column = column;
    plan.between = between;
    plan.speed = asked;
    return evaluate_stop(plan, ideal.samples(), IdealStop::kSent, file.joint[joint].velocity_error);
  }
};

void expect_monotone_and_complete(const std::vector<std::vector<TableEntry>>& table) {
  ASSERT_EQ(table.size(), 4u);
  for (std::size_t r = 0; r < 4; ++r) {
    ASSERT_EQ(table[r].size(), 8u);
    EXPECT_EQ(table[r][0].angle, 0.0);
    for (std::size_t k = 1; k < 8; ++k) {
      EXPECT_GT(table[r][k].angle, 0.0);
      EXPECT_GT(table[r][k].time, 0.0);
      EXPECT_GE(table[r][k].angle, table[r][k - 1].angle);
      EXPECT_GE(table[r][k].time, table[r][k - 1].time);
      if (r > 0) {
        EXPECT_GE(table[r][k].angle, table[r - 1][k].angle);
        EXPECT_GE(table[r][k].time, table[r - 1][k].time);
      }
      const double grid = table[r][k].angle * kDegree / 0.01;
      EXPECT_NEAR(grid, std::round(grid), 1e-6);
    }
  }
}

// verifies: IF-CF-6 (the table)
TEST(Bounds, EveryEntryBoundsTheStopsOfItsSpeedWithErrorsAndAllowance) {
  const Machine m;
  BenchRecord run;
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t k = 1; k < 8; ++k) run.stops.push_back(m.stop(swing, row, k, 0.5 - 0.08 * static_cast<double>(row), 0.98));
  const Bounds b = bounds_of(m.file, {run}, {swing}, kAllowance);
  expect_monotone_and_complete(b.table[swing]);
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t k = 1; k < 8; ++k) {
      const double v = m.speed(swing, k), a = 0.5 - 0.08 * static_cast<double>(row), full = v * v / (2 * a);
      const TableEntry& e = b.table[swing][row][k];
      EXPECT_GE(e.angle, (full + 2 * m.file.joint[swing].angle_error) * (1 + kAllowance) - 1e-9) << "a stop from 98 % of the speed stands for the whole";
      EXPECT_LE(e.angle, (full + 2 * m.file.joint[swing].angle_error) * 1.4) << "row " << row << " column " << k;
      EXPECT_GE(e.time, v / a * (1 + kAllowance));
      EXPECT_EQ(e.runs, 1);
      EXPECT_FALSE(e.extrapolated);
    }
  }
  ASSERT_TRUE(b.command_latency);
  EXPECT_NEAR(b.window_s, m.file.state_latency + m.file.kernel.cycle + m.file.command_latency, 1e-9) << "not every joint was tested: the file's latency stays";
  EXPECT_NEAR(b.latest_obeyed, 0.06, 1e-6);
  EXPECT_NEAR(*b.command_latency, 0.08, 1e-9);
}

// verifies: IF-CF-6 (the table)
TEST(Bounds, AWorseStopOfALowerRowOrColumnRaisesAllBeyondIt) {
  const Machine m;
  BenchRecord run;
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t k = 1; k < 8; ++k) run.stops.push_back(m.stop(swing, row, k, row == 1 && k == 4 ? 0.05 : 0.5));
  const Bounds b = bounds_of(m.file, {run}, {swing}, kAllowance);
  expect_monotone_and_complete(b.table[swing]);
  const double worst = b.table[swing][1][4].angle;
  EXPECT_GT(worst, 2 * b.table[swing][0][4].angle);
  EXPECT_GE(b.table[swing][3][5].angle, worst);
}

// verifies: IF-CF-6 (the table)
TEST(Bounds, AStopBetweenTheColumnsThatNeedsMoreThanTheChordRaisesTheUpperOne) {
  const Machine m;
  for (const bool worse : {false, true}) {
    BenchRecord run;
    for (std::size_t k = 1; k < 8; ++k) {
      run.stops.push_back(m.stop(swing, 3, k, 0.25));
      run.stops.push_back(m.stop(swing, 3, k, worse && k == 5 ? 0.1 : 0.25, 1.0, true));
    }
    const Bounds b = bounds_of(m.file, {run}, {swing}, kAllowance);
    expect_monotone_and_complete(b.table[swing]);
    const auto& row = b.table[swing][3];
    for (std::size_t k = 1; k < 8; ++k) {
      EXPECT_EQ(row[k].runs, 1) << "a stop between is none of the column";
      EXPECT_GT(row[k].between_share, 0.4);
      if (k > 1) {
        EXPECT_EQ(row[k].between_share > 1.0, worse && k == 5) << "column " << k;
      }
      const double v = 0.5 * (m.speed(swing, k) + m.speed(swing, k - 1)), angle = v * v / (2 * (worse && k == 5 ? 0.1 : 0.25));
      EXPECT_GE(0.5 * (row[k - 1].angle + row[k].angle), (angle + 2 * m.file.joint[swing].angle_error) * (1 + kAllowance) - 1e-9) << "column " << k;
    }
  }
}

// verifies: IF-CF-6 (the table)
TEST(Bounds, WhatWasNotTestedIsCoveredFromAboveOrMarkedAsExtrapolated) {
  const Machine m;
  BenchRecord run;
  run.stops.push_back(m.stop(stick, 3, 4, 3.0));
  run.stops.push_back(m.stop(stick, 3, 2, 3.0));
  const Bounds b = bounds_of(m.file, {run}, {stick}, kAllowance);
  expect_monotone_and_complete(b.table[stick]);
  for (std::size_t row = 0; row < 4; ++row) {
    const auto& t = b.table[stick][row];
    EXPECT_EQ(t[1].angle, t[2].angle);
    EXPECT_EQ(t[3].angle, t[4].angle);
    EXPECT_FALSE(t[3].extrapolated);
    EXPECT_TRUE(t[7].extrapolated);
    const double v = m.speed(stick, 7);
    EXPECT_GE(t[7].angle, v * v / (2 * 3.0) * (1 + kAllowance));
    EXPECT_GE(t[7].time, v / 3.0 * (1 + kAllowance));
  }
}

// verifies: IF-CF-6 (the table)
TEST(Bounds, ASpeedThatWasNotReachedIsMarkedAndScaledUp) {
  const Machine m;
  BenchRecord run;
  for (std::size_t k = 1; k < 8; ++k) run.stops.push_back(m.stop(swing, 3, k, 0.25, k == 7 ? 0.8 : 1.0));
  const Bounds b = bounds_of(m.file, {run}, {swing}, 0.0);
  const TableEntry& top = b.table[swing][3][7];
  EXPECT_TRUE(top.extrapolated);
  EXPECT_NEAR(top.slowest_speed, 0.8 * m.speed(swing, 7), 1e-9);
  EXPECT_GE(top.angle, std::pow(m.speed(swing, 7), 2) / (2 * 0.25));
  expect_monotone_and_complete(b.table[swing]);  // reaches without a pose are covered by the next
}

TEST(Bounds, AMachineFasterThanItsFileIsAnError) {
  const Machine m;
  BenchRecord run;
  run.stops.push_back(m.stop(stick, 3, 7, 3.0));
  run.fastest_reading[stick] = m.file.joint[stick].velocity_max + 1.01 * m.file.joint[stick].velocity_error;
  EXPECT_THROW(bounds_of(m.file, {run}, {stick}, kAllowance), std::runtime_error);
}

}  // namespace
}  // namespace berm::identify::test
