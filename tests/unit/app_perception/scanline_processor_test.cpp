#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "app_bench/bench_machine.hpp"
#include "drawn_scan.hpp"
#include "motion/arm_kinematics.hpp"
#include "perception/scanline_processor.hpp"

namespace {

using namespace berm::app;

const MachineModel& machine() {
  static const MachineModel m = berm::app_bench::zx200();
  return m;
}

MachineHistory history_of(double until_s, const drawn::Segment::Motion& motion) {
  drawn::Segment segment(motion);
  MachineHistory history;
  for (double t = 0.3; t < until_s; t += 0.3) {
    segment.run_to(t);
    history.take(*segment.at);
  }
  segment.run_to(until_s);
  history.take(*segment.at);
  return history;
}

MachineHistory standing() {
  return history_of(2.1, [](double) { return Joints{0.0, radians(70.0), radians(-60.0), radians(-60.0)}; });
}

// The returns of one block whose successor on the scanline never comes.
std::vector<ScanReturn> returns_of(ScanlineProcessor& processor, const MachineHistory& history, const berm_scan_block& block) {
  std::vector<ScanReturn> out;
  const auto keep = [&](std::span<const ScanlinePart> parts) {
    for (const ScanlinePart& p : parts)
      if (p.scanline == block.scanline) out.insert(out.end(), p.samples().begin(), p.samples().end());
  };
  keep(processor.take(block, history));
  berm_scan_block other = drawn::block(block.scanner, block.scanline + 7, 1, 0);
  keep(processor.take(other, history));
  return out;
}

// By plain trigonometry, with the machine swinging at nearly its largest speed while the pan turns against it.
TEST(ScanlineProcessor, PlacesEachSampleByTheMachinesPoseAtItsTime) {
  const double swing_0 = 0.4, rate = radians(38.0), pan_0 = 0.3, pan_rate = radians(-30.0);
  const MachineHistory history = history_of(2.1, [&](double t) { return Joints{swing_0 + rate * t, radians(70.0), radians(-60.0), radians(-60.0)}; });
  std::mt19937_64 random(3);
  for (std::uint8_t scanner = 0; scanner < 2; ++scanner) {
    ScanlineProcessor processor(machine());
    berm_scan_block b = drawn::block(scanner, 4, 120);
    const double span = 119 * 83333e-9;
    b.pan_start_urad = drawn::micro(pan_0);
    b.pan_end_urad = drawn::micro(pan_0 + pan_rate * span);
    for (int i = 0; i < 120; ++i) b.range_mm[i] = 700 + static_cast<std::uint32_t>(random() % 30000);
    const auto returns = returns_of(processor, history, b);
    const ScannerMount& head = machine().scanner[scanner];
    for (int i = 0; i < 120; ++i) {
      const double t = i * 83333e-9, range = b.range_mm[i] * 1e-3;
      const double up = 2.0 * std::numbers::pi * (280 + i) / 400.0, pan = pan_0 + pan_rate * t, turn = swing_0 + rate * (2.0 + t);
      const double x = head.x + range * std::cos(up) * std::cos(pan), y = head.y + range * std::cos(up) * std::sin(pan);
      const ScanReturn& s = returns[static_cast<std::size_t>(i)];
      EXPECT_NEAR(s.range, range, 1e-12);
      EXPECT_NEAR(s.x, x * std::cos(turn) - y * std::sin(turn), 1e-4) << i;
      EXPECT_NEAR(s.y, x * std::sin(turn) + y * std::cos(turn), 1e-4) << i;
      EXPECT_NEAR(s.z, head.z + range * std::sin(up), 1e-9) << i;
      EXPECT_NEAR(s.time_s, 2.0 + t, 1e-9);
    }
  }
}

TEST(ScanlineProcessor, TheChainsFrameIsTheScanPlane) {
  const ScannerMount& head = machine().scanner[1];
  const std::array<double, 2> joint{0.7, -0.4};
  const Eigen::Isometry3d frame = scanner_chain(head).pose(joint);
  EXPECT_LT((frame.linear().col(0) - Eigen::Vector3d(std::cos(0.3), std::sin(0.3), 0.0)).norm(), 1e-12) << "forward and level";
  EXPECT_LT((frame.linear().col(1) - Eigen::Vector3d::UnitZ()).norm(), 1e-12) << "upward";
  EXPECT_NEAR(frame.translation().z(), head.z, 1e-12);
  EXPECT_NEAR(frame.translation().head<2>().norm(), std::hypot(head.x, head.y), 1e-12);
}

TEST(ScanlineProcessor, WhatIsOutOfRangeOrHasNoPoseIsNoReturn) {
  ScanlineProcessor processor(machine());
  const MachineHistory history = standing();
  berm_scan_block b = drawn::block(0, 1, 5);
  b.range_mm[0] = 0;
  b.range_mm[1] = static_cast<std::uint32_t>(machine().range_min * 1e3) - 1;
  b.range_mm[2] = static_cast<std::uint32_t>(machine().range_max * 1e3) + 1;
  b.range_mm[3] = std::numeric_limits<std::uint32_t>::max();
  const auto returns = returns_of(processor, history, b);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(returns[i].range, 0.0) << i;
  EXPECT_GT(returns[4].range, 0.0);
  b = drawn::block(0, 2, 5);
  b.time_us = 1000;  // long forgotten
  for (const ScanReturn& s : returns_of(processor, history, b)) EXPECT_EQ(s.range, 0.0);
}

TEST(ScanlineProcessor, AnEchoBeforeTheLastIsASignOfDust) {
  ScanlineProcessor processor(machine());
  berm_scan_block b = drawn::block(0, 1, 10);
  b.echoes[4] = 2;
  b.echoes[6] = 3;
  const auto returns = returns_of(processor, standing(), b);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(returns[i].several_echoes, i == 4 || i == 6) << i;
    EXPECT_EQ(returns[i].flagged(), i == 4 || i == 6) << i;
    EXPECT_NEAR(returns[i].range, 8.0, 1e-12) << "the last echo is the return";
  }
}

TEST(ScanlineProcessor, AReturnThatHangsInTheAirIsLone) {
  ScanlineProcessor processor(machine());
  const MachineHistory history = standing();
  berm_scan_block b = drawn::block(0, 1, 20);
  b.range_mm[10] = 5000;   // far before its neighbours
  b.range_mm[15] = 12000;  // and far behind them
  auto returns = returns_of(processor, history, b);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(returns[i].lone, i == 10 || i == 15) << i;
  b = drawn::block(0, 2, 20);
  b.range_mm[10] = b.range_mm[11] = 5000;  // a thin thing that two beams meet
  for (const ScanReturn& s : returns_of(processor, history, b)) EXPECT_FALSE(s.lone);
  b = drawn::block(0, 3, 20, 0);
  b.range_mm[10] = 5000;  // with nothing about it at all
  returns = returns_of(processor, history, b);
  EXPECT_TRUE(returns[10].lone);
}

TEST(ScanlineProcessor, GroundThatRecedesIsNotLoneHoweverSteeply) {
  ScanlineProcessor processor(machine());
  berm_scan_block b = drawn::block(0, 1, 30);
  for (int i = 0; i < 30; ++i) b.range_mm[i] = static_cast<std::uint32_t>(6000 + 1200 * i);
  const auto returns = returns_of(processor, standing(), b);
  for (std::size_t i = 1; i < 29; ++i) EXPECT_FALSE(returns[i].lone) << i;
}

// However a scanline is cut into blocks, the same is said of every return.
TEST(ScanlineProcessor, BlocksOfOneScanlineAreNeighbours) {
  const MachineHistory history = standing();
  std::mt19937_64 random(9);
  for (int run = 0; run < 20; ++run) {
    berm_scan_block whole = drawn::block(0, 5, 120);
    for (int i = 0; i < 120; ++i) whole.range_mm[i] = random() % 6 == 0 ? 2000 + static_cast<std::uint32_t>(random() % 9000) : 8000;
    ScanlineProcessor one(machine()), cut(machine());
    const auto expected = one.take(whole, history);  // it ends its turn of the mirror
    ASSERT_EQ(expected.size(), 1u);
    std::vector<ScanReturn> returns;
    for (int at = 0; at < 120;) {
      const int count = std::min<int>(120 - at, 1 + static_cast<int>(random() % 40));
      berm_scan_block b = drawn::block(0, 5, count);
      b.first_index = static_cast<std::uint16_t>(280 + at);
      b.time_us = whole.time_us + at * 83333 / 1000;
      std::copy_n(whole.range_mm + at, count, b.range_mm);
      for (const ScanlinePart& p : cut.take(b, history)) returns.insert(returns.end(), p.samples().begin(), p.samples().end());
      at += count;
    }
    ASSERT_EQ(returns.size(), 120u);
    for (std::size_t i = 0; i < 120; ++i) EXPECT_EQ(returns[i].lone, expected[0].sample[i].lone) << run << " " << i;
  }
}

TEST(ScanlineProcessor, BlocksOfTwoScanlinesAndOfTwoScannersAreNot) {
  const MachineHistory history = standing();
  ScanlineProcessor processor(machine());
  berm_scan_block first = drawn::block(0, 5, 10), second = drawn::block(0, 6, 1), of_other = drawn::block(1, 5, 1);
  first.first_index = 350;
  second.first_index = of_other.first_index = 360;
  EXPECT_TRUE(processor.take(first, history).empty());
  EXPECT_TRUE(processor.take(of_other, history).empty());
  const auto done = processor.take(second, history);
  ASSERT_EQ(done.size(), 1u);
  EXPECT_EQ(done[0].count, 10);
  second.scanline = 9;
  const auto next = processor.take(second, history);
  ASSERT_EQ(next.size(), 1u);
  EXPECT_TRUE(next[0].sample[0].lone) << "a single sample, alone on its scanline";
}

TEST(ScanlineProcessor, TheOwnImplementsAreTold) {
  // The bucket hangs before the machine; the beams of both scanners that point at its pin end there.
  const Joints pose{0.5, radians(20.0), radians(-60.0), radians(-90.0)};
  const MachineHistory history = history_of(2.1, [&](double) { return pose; });
  const ArmPoints arm = forward(machine(), pose);
  for (std::uint8_t scanner = 0; scanner < 2; ++scanner) {
    const ScannerMount& head = machine().scanner[scanner];
    const double dx = arm.bucket_pin.r - head.x, dy = -head.y, dz = arm.bucket_pin.z - head.z;
    ScanlineProcessor processor(machine());
    berm_scan_block b = drawn::block(scanner, 1, 3, 0, std::atan2(dy, dx));
    const double below = std::atan2(-dz, std::hypot(dx, dy));
    b.first_index = static_cast<std::uint16_t>(std::lround(400.0 - below * 400.0 / (2.0 * std::numbers::pi)) - 1);
    for (int i = 0; i < 3; ++i) b.range_mm[i] = static_cast<std::uint32_t>(std::lround(1e3 * std::sqrt(dx * dx + dy * dy + dz * dz)));
    for (const ScanReturn& s : returns_of(processor, history, b)) EXPECT_TRUE(s.own);
    for (int i = 0; i < 3; ++i) b.range_mm[i] += 3000;
    b.scanline = 2;
    for (const ScanReturn& s : returns_of(processor, history, b)) EXPECT_FALSE(s.own);
  }
}

TEST(ScanlineProcessor, RefusesWhatTheContractDoesNotAllow) {
  const berm_scan_block good = drawn::block(1, 3, 120);
  ASSERT_TRUE(well_formed(good));
  const auto spoilt = [&](auto&& change) {
    berm_scan_block b = good;
    change(b);
    return !well_formed(b);
  };
  EXPECT_TRUE(spoilt([](auto& b) { b.scanner = 2; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.scanner = 255; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.count = 0; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.count = 121; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.count = 65535; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.first_index = 281; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.samples_per_revolution = 0; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.sample_period_ns = 0; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.sample_period_ns = 0xFFFFFFFFu; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.time_us = -1; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.time_us = INT64_MAX; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.pan_start_urad = INT32_MIN; }));
  EXPECT_TRUE(spoilt([](auto& b) { b.pan_end_urad = INT32_MAX; }));
}

// Millimetres as the kernel would round them, x and y to the nearest, z up.
void place(berm_scan_block& b, int i, const ScanReturn& s, double off_x = 0.0, double off_z = 0.0) {
  b.point_mm[i][0] = static_cast<std::int32_t>(std::lround((s.x + off_x) * 1e3));
  b.point_mm[i][1] = static_cast<std::int32_t>(std::lround(s.y * 1e3));
  b.point_mm[i][2] = static_cast<std::int32_t>(std::ceil((s.z + off_z) * 1e3));
}

TEST(ScanlineProcessor, APointOfTheKernelsThatLiesElsewhereIsCounted) {
  const MachineHistory history = standing();
  berm_scan_block b = drawn::block(0, 1, 100);
  ScanlineProcessor blind(machine());
  const auto returns = returns_of(blind, history, b);
  EXPECT_EQ(blind.check().compared(), 0u) << "the kernel has placed nothing";
  for (int i = 0; i < 100; ++i) place(b, i, returns[static_cast<std::size_t>(i)]);
  ScanlineProcessor processor(machine());
  returns_of(processor, history, b);
  EXPECT_EQ(processor.check().compared(), 100u);
  EXPECT_EQ(processor.check().disagreeing(), 0u);
  EXPECT_FALSE(processor.check().first());

  place(b, 40, returns[40], 0.005);
  place(b, 70, returns[70], 0.0, -0.2);
  b.scanline = 2;
  returns_of(processor, history, b);
  EXPECT_EQ(processor.check().compared(), 200u);
  EXPECT_EQ(processor.check().disagreeing(), 2u);
  ASSERT_TRUE(processor.check().first());
  EXPECT_NEAR(processor.check().first()->distance(), 0.005, 0.0016);
  EXPECT_NEAR(processor.check().first()->time_s, returns[40].time_s, 1e-9);
}

// Of a state that is missing nobody can tell what the other made of it.
TEST(ScanlineProcessor, BetweenStatesThatAreNoNeighboursNothingIsCompared) {
  MachineHistory history;
  for (const std::int64_t us : {1'990'000, 2'020'000}) history.push(drawn::state_at(us, {0.0, 1.2, -1.0, -1.0}));
  berm_scan_block b = drawn::block(0, 1, 100);
  for (int i = 0; i < 100; ++i) b.point_mm[i][0] = 5000;
  ScanlineProcessor processor(machine());
  for (const ScanReturn& s : returns_of(processor, history, b)) EXPECT_GT(s.range, 0.0);
  EXPECT_EQ(processor.check().compared(), 0u);
}

}  // namespace
