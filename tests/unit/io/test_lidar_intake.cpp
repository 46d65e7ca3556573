// From packets of a lidar on the upper body to the map: places, the own machine, what is refused, silence.
#include "io/lidar_intake.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <memory>
#include <random>
#include <vector>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::int64_t kNow = 5000000;
using Bytes = std::array<std::uint8_t, kVlp16PacketBytes>;

// Range in metres of a firing's laser, 0 where nothing comes back.
using Ranges = std::function<double(int firing, int laser)>;

// A packet of 24 firings, 0.2 degrees apart.
Bytes packet_of(std::uint32_t clock_us, double from_deg, const Ranges& range_m) {
  Bytes b{};
  for (int firing = 0; firing < 24; ++firing) {
    std::uint8_t* to = b.data() + 100 * (firing / 2);
    const auto azimuth = static_cast<unsigned>(std::lround((from_deg + 0.4 * (firing / 2)) * 100)) % 36000;
    to[0] = 0xFF;
    to[1] = 0xEE;
    to[2] = static_cast<std::uint8_t>(azimuth & 0xFF);
    to[3] = static_cast<std::uint8_t>(azimuth >> 8);
    for (int laser = 0; laser < 16; ++laser) {
      const auto range = static_cast<unsigned>(std::lround(range_m(firing, laser) * 500));
      std::uint8_t* shot = to + 4 + 3 * (16 * (firing % 2) + laser);
      shot[0] = static_cast<std::uint8_t>(range & 0xFF);
      shot[1] = static_cast<std::uint8_t>(range >> 8);
    }
  }
  for (int i = 0; i < 4; ++i) b[1200 + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(clock_us >> (8 * i));
  b[1204] = 0x37;
  b[1205] = 0x22;
  return b;
}

// Nothing comes back but to the given laser. Of the firings of 4.8 degrees those at multiples of 1.6 are taken.
Bytes packet(std::uint32_t clock_us, int laser = 0, double range_m = 0.0, double from_deg = 0.0) {
  return packet_of(clock_us, from_deg, [&](int, int of) { return of == laser ? range_m : 0.0; });
}

// The same, with a return of every shot.
Bytes seeing(std::uint32_t clock_us, double from_deg) {
  Bytes b = packet(clock_us, 0, 0.0, from_deg);
  for (std::size_t block = 0; block < 12; ++block)
    for (std::size_t shot = 0; shot < 32; ++shot) b[100 * block + 5 + 3 * shot] = 0x08;  // 4.1 m
  return b;
}

class LidarIntakeTest : public testing::Test {
 protected:
  void SetUp() override {
    parameters = berm::test::demo_parameters();
    parameters.lidars = 2;
    // The sensor's x axis points down, its z axis along the bearing of 145 degrees, its y axis to the left of that.
    parameters.lidar[0] = {-2650, 1400, 3400, 0, 1570796, berm::test::urad(145)};
    parameters.lidar[1] = {-2650, -1400, 3400, 0, 1570796, berm::test::urad(-145)};
    intake = std::make_unique<LidarIntake>(parameters);
    sk_map_clear(map.get());
    stand(0.0);
  }
  void stand(double swing_rad) {
    joints = std::make_unique<JointHistory>();
    const std::int32_t pose[4] = {static_cast<std::int32_t>(std::lround(swing_rad * 1e6)), 870000, -1570000, -700000};
    joints->push(kNow - 30000, pose);
    joints->push(kNow + 100000, pose);
  }
  bool take(const Bytes& b, int lidar = 0, std::int64_t now_us = kNow) { return intake->take(lidar, b.data(), b.size(), *joints, now_us, *map, *shadow); }
  // All round at once, which it cannot: 75 packets, a microsecond apart.
  bool turn(std::uint32_t clock_us, int lidar, std::int64_t now_us = kNow) {
    bool all = true;
    for (std::uint32_t k = 0; k < 75; ++k) all = take(packet(clock_us + k, 0, 0.0, 4.8 * k), lidar, now_us) && all;
    return all;
  }
  int observed() const {
    int count = 0;
    for (const auto& row : map->seen_us)
      for (const auto seen : row) count += seen >= 0 ? 1 : 0;
    return count;
  }

  berm_parameters parameters{};
  std::unique_ptr<LidarIntake> intake;
  std::unique_ptr<JointHistory> joints;
  std::unique_ptr<OwnShadow> shadow = std::make_unique<OwnShadow>(1000000);
  std::unique_ptr<sk_height_map> map = std::make_unique<sk_height_map>();
};

// Laser 15 looks 15 degrees from the level plane towards the sensor's z axis; azimuth grows clockwise, so that at 339.2 degrees it looks 20.8 degrees towards y.
// verifies: SK-LI-1
TEST_F(LidarIntakeTest, AReturnRaisesTheCellThatItCameFrom) {
  for (const double swing : {0.0, 1.0, -2.0}) {
    sk_map_clear(map.get());
    stand(swing);
    const double e = 15 * kPi / 180, h = 20.8 * kPi / 180, psi = 145 * kPi / 180, range = 3.4;
    const double down = range * std::cos(e) * std::cos(h), left = range * std::cos(e) * std::sin(h), out = range * std::sin(e);
    const double x = -2.65 + out * std::cos(psi) - left * std::sin(psi), y = 1.4 + out * std::sin(psi) + left * std::cos(psi), z = 3.4 - down;
    ASSERT_GT(std::hypot(x, y), 3.1) << "it must not be the own body's";
    ASSERT_TRUE(take(packet(1000, 15, range, 339.2)));
    const double bx = x * std::cos(swing) - y * std::sin(swing), by = x * std::sin(swing) + y * std::cos(swing);
    const int ix = sk_map_index(static_cast<std::int32_t>(std::lround(bx * 1e3))), iy = sk_map_index(static_cast<std::int32_t>(std::lround(by * 1e3)));
    ASSERT_GE(map->seen_us[iy][ix], 0) << swing;
    EXPECT_NEAR(sk_map_top(map.get(), iy, ix), z * 1e3, 120) << "the packet's other firings hit lower";
    EXPECT_EQ(intake->points(), 3U) << "of 4.8 degrees";
    intake = std::make_unique<LidarIntake>(parameters);
  }
}

// verifies: SK-LI-1
TEST_F(LidarIntakeTest, OwnBodyAndFarReturnsAreNotTaken) {
  ASSERT_TRUE(take(packet(1000, 0, 2.0)));  // laser 0 looks back under the upper body
  EXPECT_EQ(observed(), 0);
  ASSERT_TRUE(take(packet(2000, 15, 40.0, 268.8)));  // level, beyond 8 m
  EXPECT_EQ(observed(), 0);
  EXPECT_EQ(intake->points(), 0U);
}

// Laser 15 looks up by 15 degrees, 13 by 13, 11 by 11. Of the firings of this packet 4, 12 and 20 are taken; only the middle one has its returns.
// verifies: SK-LI-8
TEST_F(LidarIntakeTest, AReturnThatFewerThanTwoSupportIsSpurious) {
  struct Case {
    const char* what;
    Ranges range_m;
    unsigned kept;
  };
  const auto at = [](int firing, int laser) { return firing * 100 + laser; };
  const auto among = [at](std::initializer_list<int> shots) {
    return [at, seen = std::vector<int>(shots)](int firing, int laser) { return std::find(seen.begin(), seen.end(), at(firing, laser)) != seen.end() ? 3.4 : 0.0; };
  };
  const auto one_off = [](double off_m) { return [off_m](int firing, int laser) { return laser == 15 && firing >= 11 && firing <= 13 ? (firing == 13 ? 3.4 + off_m : 3.4) : 0.0; }; };
  const Case cases[] = {{"alone", among({1215}), 0},
                        {"one beside it", among({1215, 1315}), 0},
                        {"one below it", among({1215, 1213}), 0},
                        {"both beside it", among({1115, 1215, 1315}), 1},
                        {"one beside, one below it", among({1115, 1215, 1213}), 1},
                        {"two on one side: a thing's edge", among({1215, 1315, 1415}), 0},
                        {"two beside, and two below it", among({1215, 1315, 1213, 1313}), 2},
                        {"as far away", one_off(0.29), 1},
                        {"nearer", one_off(-0.29), 1},
                        {"farther than spurious_range", one_off(0.31), 0},
                        {"nearer than by spurious_range", one_off(-0.31), 0}};
  ASSERT_EQ(parameters.spurious_range_mm, 300);
  for (const Case& c : cases) {
    intake = std::make_unique<LidarIntake>(parameters);
    sk_map_clear(map.get());
    ASSERT_TRUE(take(packet_of(1000, 336.8, c.range_m))) << c.what;
    EXPECT_EQ(observed() > 0, c.kept > 0) << c.what;
    EXPECT_EQ(intake->points(), c.kept) << c.what;
  }
}

// verifies: SK-LI-8
TEST_F(LidarIntakeTest, WhatIsAFiringWideAndThreeLasersHighIsTaken) {
  ASSERT_TRUE(take(packet_of(1000, 336.8, [](int firing, int laser) { return firing == 12 && laser % 2 == 1 && laser >= 11 ? 3.4 : 0.0; })));
  EXPECT_EQ(intake->points(), 1U) << "the middle one of 11, 13 and 15 degrees";
}

// verifies: SK-LI-8
TEST_F(LidarIntakeTest, AtAPacketsEndsTheTwoFiringsInwardsSupport) {
  for (const bool first : {true, false}) {
    const double from_deg = first ? 339.2 : 339.2 - 23 * 0.2;
    const int edge = first ? 0 : 23, inward = first ? 1 : -1;
    for (const int seen : {3, 2}) {
      intake = std::make_unique<LidarIntake>(parameters);
      sk_map_clear(map.get());
      ASSERT_TRUE(take(packet_of(1000, from_deg, [&](int firing, int laser) { return laser == 15 && (firing - edge) * inward < seen ? 3.4 : 0.0; })));
      EXPECT_EQ(intake->points(), seen == 3 ? 1U : 0U) << first << ", " << seen;
    }
  }
}

// Firings that others are missing between are no neighbours.
// verifies: SK-LI-8
TEST_F(LidarIntakeTest, FiringsFarApartSupportNothing) {
  Bytes b = packet_of(1000, 336.8, [](int firing, int laser) { return laser == 15 && firing >= 11 && firing <= 13 ? 3.4 : 0.0; });
  ASSERT_TRUE(take(b));
  ASSERT_EQ(intake->points(), 1U);
  intake = std::make_unique<LidarIntake>(parameters);
  // Firings 10 and 11 are of block 5, at 338.8 degrees: two degrees before.
  b[500 + 2] = static_cast<std::uint8_t>(33680 & 0xFF);
  b[500 + 3] = static_cast<std::uint8_t>(33680 >> 8);
  ASSERT_TRUE(take(b));
  EXPECT_EQ(intake->points(), 0U);
}

// Over the edge of the own bucket returns of dust agree with the bucket's own: the bucket then hides the place, and the map would keep it.
// verifies: SK-LI-8
TEST_F(LidarIntakeTest, OwnReturnsSupportNothing) {
  constexpr int kAcross = 9;           // looks up by 9 degrees, over the bucket
  constexpr double kAcrossDeg = 342.4;  // to the left of ahead
  parameters.lidar[1] = {1000, -1500, 2400, 0, 0, 0};
  const auto kept = [&](double range_m, double beside_m) {
    intake = std::make_unique<LidarIntake>(parameters);
    sk_map_clear(map.get());
    const Ranges three = [&](int firing, int laser) { return laser != kAcross ? 0.0 : firing == 4 ? range_m : firing == 3 || firing == 5 ? beside_m : 0.0; };
    EXPECT_TRUE(take(packet_of(1000, kAcrossDeg - 0.8, three), 1));
    return intake->points() == 1;
  };
  double out_m = 0.0;  // just beyond the margin round the bucket, as seen from the lidar
  for (double range = 3.0; range < 8.0 && out_m == 0.0; range += 0.02)  // from beyond the own body
    if (!kept(range, range) && kept(range + 0.02, range + 0.02)) out_m = range + 0.04;
  ASSERT_GT(out_m, 4.0);
  EXPECT_TRUE(kept(out_m, out_m));
  EXPECT_FALSE(kept(out_m, out_m - 0.28)) << "beside it is the bucket";
  EXPECT_TRUE(kept(out_m, out_m + 0.28)) << "as far from it, and not the bucket";
}

// What is two degrees of the turn wide is always found, wherever it stands; returns anywhere on the way, in one shot of ten, hardly ever are.
// verifies: SK-LI-8
TEST_F(LidarIntakeTest, WideThingsAreFoundAndDustIsNot) {
  const std::uint32_t seed = 4711;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> start(0.0, 2.8), any(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    intake = std::make_unique<LidarIntake>(parameters);
    const double low_deg = start(random);
    ASSERT_TRUE(take(packet_of(1000, 339.2, [&](int firing, int laser) {
      const double at_deg = 0.2 * firing;
      return laser == 15 && at_deg >= low_deg && at_deg <= low_deg + 2.0 ? 3.4 : 0.0;
    })));
    EXPECT_GE(intake->points(), 1U) << "seed " << seed << ", from " << low_deg;
  }
  std::uint32_t dusty = 0, shots = 0;
  for (std::uint32_t turn = 0; turn < 400; ++turn) {
    intake = std::make_unique<LidarIntake>(parameters);
    ASSERT_TRUE(take(packet_of(1000, 339.2, [&](int, int) { return any(random) < 0.1 ? 3.3 + 4.0 * any(random) : 0.0; })));
    dusty += intake->points();
    shots += 3 * 16;
  }
  EXPECT_LE(dusty, shots / 1000) << "seed " << seed;
}

// verifies: SK-LI-2
TEST_F(LidarIntakeTest, RepeatedEarlierAndForeignPacketsAreRefused) {
  ASSERT_TRUE(take(packet(1000000)));
  EXPECT_FALSE(take(packet(1000000))) << "the same again";
  EXPECT_FALSE(take(packet(999000))) << "earlier";
  EXPECT_FALSE(take(packet(2000001))) << "more than a second on";
  EXPECT_FALSE(take(packet(3600000000U))) << "no time within an hour";
  EXPECT_TRUE(take(packet(1001327)));
  EXPECT_FALSE(take(packet(1002000), 2));
  EXPECT_FALSE(take(packet(1002000), -1));
  Bytes wrong = packet(1003000);
  wrong[1205] = 0x21;
  EXPECT_FALSE(take(wrong));
  EXPECT_FALSE(intake->take(0, wrong.data(), 1205, *joints, kNow, *map, *shadow));
  // The hour's end is no gap, and after a silence the clock may stand anywhere.
  EXPECT_TRUE(take(packet(3599999000U), 0, kNow + 300000));
  EXPECT_TRUE(take(packet(500), 0, kNow + 310000));
}

// verifies: SK-LI-7
TEST_F(LidarIntakeTest, APacketMuchLaterThanTheOneWithTheLeastDelayIsRefused) {
  ASSERT_TRUE(take(packet(1000000)));
  EXPECT_TRUE(turn(1050000, 0, kNow + 150000)) << "100 ms late";
  EXPECT_FALSE(take(packet(1060000), 0, kNow + 170000)) << "110 ms late";
  ASSERT_TRUE(turn(1000, 1, kNow + 170000));
  EXPECT_FALSE(intake->silent(kNow + 350000, 200000));
  EXPECT_TRUE(intake->silent(kNow + 350001, 200000)) << "what is refused is no sign of life";
  EXPECT_TRUE(take(packet(1180000), 0, kNow + 180000)) << "in time again";
}

// verifies: SK-LI-2
TEST_F(LidarIntakeTest, SilenceOfEitherCountsOnceBothWereHeard) {
  EXPECT_FALSE(intake->all_heard());
  ASSERT_TRUE(turn(1000, 0));
  EXPECT_FALSE(intake->all_heard());
  EXPECT_FALSE(intake->silent(kNow + 10000000, 200000));
  ASSERT_TRUE(turn(1000, 1));
  EXPECT_TRUE(intake->all_heard());
  EXPECT_FALSE(intake->silent(kNow + 200000, 200000));
  EXPECT_TRUE(intake->silent(kNow + 200001, 200000));
  ASSERT_TRUE(take(packet(151000), 0, kNow + 150000));
  EXPECT_TRUE(intake->silent(kNow + 200001, 200000)) << "the other";
}

// In the whole cycle: INIT lasts until the lidar is heard, and its silence is a fault.
// verifies: SK-LI-2
TEST(CycleLidar, ASilentLidarIsAFault) {
  berm_parameters parameters = berm::test::demo_parameters();
  parameters.lidars = 1;
  parameters.lidar[0] = {-2650, 1400, 3400, 0, 1570796, berm::test::urad(145)};
  CycleRig rig(parameters);
  EXPECT_FALSE(rig.reach_state(BERM_STATE_RUN, 300));
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_INIT);
  const auto step = [&] {
    rig.gather();
    for (std::uint32_t k = 0; k < 8; ++k) {  // 36 degrees in a cycle
      const Bytes bytes = seeing(10000 * (rig.machine.cycle() + 1) + k, std::fmod(36.0 * rig.machine.cycle() + 4.5 * k, 360.0));
      ASSERT_TRUE(rig.in->take_lidar(0, bytes.data(), bytes.size()));
    }
    rig.cycle->step(*rig.in, *rig.out);
    rig.obey();
  };
  for (int i = 0; i < 300; ++i) step();
  ASSERT_EQ(rig.state().kernel_state, BERM_STATE_RUN);
  rig.steps(parameters.scanner_silent_us / 10000 + 2);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_FAULT);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_SCANNER_SILENT);
}

}  // namespace
}  // namespace berm::kernel::test
