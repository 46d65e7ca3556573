// Whether a lidar's head turns: its sign of life is that of the sector of its turn that was fired into longest ago.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include "io/lidar_intake.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::int64_t kStart = 5000000;
constexpr std::int64_t kPacketNs = 24 * kVlp16FiringNs;  // of single return
using Bytes = std::array<std::uint8_t, kVlp16PacketBytes>;

// Nothing comes back. The head turns by so much from a block to the next.
Bytes blank_packet(std::uint32_t clock_us, double from_deg, double block_deg, bool dual) {
  Bytes b{};
  for (int block = 0; block < 12; ++block) {
    std::uint8_t* to = b.data() + 100 * block;
    const auto azimuth = static_cast<unsigned>(std::lround((from_deg + block_deg * (dual ? block / 2 : block)) * 100)) % 36000;
    to[0] = 0xFF;
    to[1] = 0xEE;
    to[2] = static_cast<std::uint8_t>(azimuth & 0xFF);
    to[3] = static_cast<std::uint8_t>(azimuth >> 8);
  }
  for (int i = 0; i < 4; ++i) b[1200 + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(clock_us >> (8 * i));
  b[1204] = dual ? 0x39 : 0x37;
  b[1205] = 0x22;
  return b;
}

class LidarTurning : public testing::Test {
 protected:
  void SetUp() override {
    parameters = berm::test::demo_parameters();
    parameters.lidars = 1;
    parameters.lidar[0] = {-2650, 1400, 1050, 0, 0, 0};
    sk_map_clear(map.get());
    renew();
  }
  void renew() {
    intake = std::make_unique<LidarIntake>(parameters);
    joints = std::make_unique<JointHistory>();
    sent = 0;
    at_deg = 0.0;
    now_us = kStart;
  }
  // A cycle of 10 ms with what is finished by then. arrives: of a packet's azimuth.
  template <class Arrives>
  void step(double turns_a_minute, Arrives arrives) {
    now_us += 10000;
    const std::int32_t pose[4] = {0, 870000, -1570000, -700000};
    joints->push(now_us, pose);
    const std::int64_t packet_ns = dual ? kPacketNs / 2 : kPacketNs;
    const double packet_deg = turns_a_minute * 6.0 * static_cast<double>(packet_ns) * 1e-9;
    for (; (sent + 1) * packet_ns / 1000 <= now_us - kStart; ++sent) {
      const Bytes b = blank_packet(static_cast<std::uint32_t>((sent + 1) * packet_ns / 1000), at_deg, packet_deg / (dual ? 6 : 12), dual);
      if (arrives(at_deg)) {
        ASSERT_TRUE(intake->take(0, b.data(), b.size(), *joints, now_us, *map, *shadow));
      }
      at_deg = std::fmod(at_deg + packet_deg, 360.0);
    }
  }
  void step(double turns_a_minute) {
    step(turns_a_minute, [](double) { return true; });
  }
  bool silent() const { return intake->silent(now_us, parameters.scanner_silent_us); }
  // Cycles of 10 ms until it is.
  template <class Step>
  int until_silent(Step one) {
    int cycles = 0;
    while (!silent() && cycles < 1000) {
      one();
      ++cycles;
    }
    return cycles;
  }

  berm_parameters parameters{};
  std::unique_ptr<LidarIntake> intake;
  std::unique_ptr<JointHistory> joints;
  std::unique_ptr<OwnShadow> shadow = std::make_unique<OwnShadow>(1000000);
  std::unique_ptr<sk_height_map> map = std::make_unique<sk_height_map>();
  bool dual = false;
  std::int64_t sent = 0, now_us = kStart;
  double at_deg = 0.0;
};

// verifies: SK-LI-9
TEST_F(LidarTurning, OneThatTurnsAsItMayIsNeverSilentThoughNothingComesBack) {
  ASSERT_EQ(parameters.scanner_silent_us, 200000);
  for (const bool pairs : {false, true}) {
    for (const double rate : {300.0, 600.0, 900.0, 1200.0}) {
      dual = pairs;
      renew();
      for (int k = 0; k < 25; ++k) step(rate);
      ASSERT_TRUE(intake->all_heard()) << rate;
      for (int k = 0; k < 500; ++k) {
        step(rate);
        ASSERT_FALSE(silent()) << rate << " turns a minute, cycle " << k << ", dual " << pairs;
      }
    }
  }
}

// Slower than a turn in 0.3 s it is not healthy, and no machine starts with it.
// verifies: SK-LI-9
TEST_F(LidarTurning, OneThatTurnsTooSlowlyIsSilent) {
  for (int k = 0; k < 100; ++k) step(180.0);
  ASSERT_TRUE(intake->all_heard());
  int silent_cycles = 0;
  for (int k = 0; k < 1000; ++k) {
    step(180.0);
    silent_cycles += silent() ? 1 : 0;
  }
  EXPECT_GT(silent_cycles, 900);
}

// verifies: SK-LI-9
TEST_F(LidarTurning, OneWhoseHeadStandsIsSilentWhateverItSends) {
  for (const bool pairs : {false, true}) {
    dual = pairs;
    renew();
    for (int k = 0; k < 100; ++k) step(600.0);
    ASSERT_FALSE(silent());
    const int cycles = until_silent([&] { step(0.0); });
    EXPECT_LE(cycles, 31) << "dual " << pairs;
    EXPECT_GE(cycles, 20) << "dual " << pairs;
    for (int k = 0; k < 9; ++k) step(600.0);
    EXPECT_TRUE(silent()) << "not all round again";
    for (int k = 0; k < 3; ++k) step(600.0);
    EXPECT_FALSE(silent());
  }
}

// Whichever sector it is: also the narrowest gap that holds a whole sector.
// verifies: SK-LI-9
TEST_F(LidarTurning, OneThatSendsAPartOfItsTurnAloneIsSilent) {
  for (double gap_deg = 0.0; gap_deg < 360.0; gap_deg += 10.0) {
    renew();
    for (int k = 0; k < 100; ++k) step(600.0);
    ASSERT_FALSE(silent());
    const auto beside_gap = [&](double at) { return std::fmod(at - gap_deg + 5.0 + 360.0, 360.0) >= 20.0; };
    const int cycles = until_silent([&] { step(600.0, beside_gap); });
    EXPECT_LE(cycles, 32) << gap_deg;
    EXPECT_GE(cycles, 20) << gap_deg;
  }
}

// verifies: SK-LI-9
TEST_F(LidarTurning, ItIsHeardWhenItHasFiredIntoEverySector) {
  const auto but_one = [](double at) { return at < 195.0 || at >= 215.0; };  // a packet is five degrees wide
  for (int k = 0; k < 100; ++k) step(600.0, but_one);
  EXPECT_FALSE(intake->all_heard());
  EXPECT_FALSE(silent()) << "what was never heard is not silent";
  for (int k = 0; k < 11; ++k) step(600.0);
  EXPECT_TRUE(intake->all_heard());
}

// As before a lidar may send nothing for the limit: what was due first when it fell silent had a turn to go.
// verifies: SK-LI-2, SK-LI-9
TEST_F(LidarTurning, AGapOfTheSilenceLimitIsNoFault) {
  for (int phase = 0; phase < 10; ++phase) {
    renew();
    for (int k = 0; k < 100 + phase; ++k) step(600.0);
    for (int k = 0; k < 19; ++k) {
      step(600.0, [](double) { return false; });
      ASSERT_FALSE(silent()) << phase << ", " << k;
    }
    for (int k = 0; k < 50; ++k) {
      step(600.0);
      ASSERT_FALSE(silent()) << phase << ", " << k;
    }
  }
}

}  // namespace
}  // namespace berm::kernel::test
