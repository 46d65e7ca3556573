// From packets of a lidar on the upper body to the map: places, the own machine, what is refused, silence.
#include "io/lidar_intake.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::int64_t kNow = 5000000;
using Bytes = std::array<std::uint8_t, kVlp16PacketBytes>;

// A packet whose blocks are 3.2 degrees apart, from a multiple of that on; nothing comes back but to the given laser's first firing of each block.
Bytes packet(std::uint32_t clock_us, int laser = 0, double range_m = 0.0, double from_deg = 0.0) {
  Bytes b{};
  for (std::size_t block = 0; block < 12; ++block) {
    std::uint8_t* to = b.data() + 100 * block;
    const auto azimuth = static_cast<unsigned>(std::lround((from_deg + 3.2 * static_cast<double>(block)) * 100)) % 36000;
    to[0] = 0xFF;
    to[1] = 0xEE;
    to[2] = static_cast<std::uint8_t>(azimuth & 0xFF);
    to[3] = static_cast<std::uint8_t>(azimuth >> 8);
    const auto range = static_cast<unsigned>(std::lround(range_m * 500));
    to[4 + 3 * laser] = static_cast<std::uint8_t>(range & 0xFF);
    to[5 + 3 * laser] = static_cast<std::uint8_t>(range >> 8);
  }
  for (int i = 0; i < 4; ++i) b[1200 + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(clock_us >> (8 * i));
  b[1204] = 0x37;
  b[1205] = 0x22;
  return b;
}

// The same, with a return of every shot.
Bytes seeing(std::uint32_t clock_us) {
  Bytes b = packet(clock_us);
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
    EXPECT_GT(intake->points(), 5U);
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
  EXPECT_TRUE(take(packet(1050000), 0, kNow + 150000)) << "100 ms late";
  EXPECT_FALSE(take(packet(1060000), 0, kNow + 170000)) << "110 ms late";
  ASSERT_TRUE(take(packet(1000), 1, kNow + 170000));
  EXPECT_FALSE(intake->silent(kNow + 350000, 200000));
  EXPECT_TRUE(intake->silent(kNow + 350001, 200000)) << "what is refused is no sign of life";
  EXPECT_TRUE(take(packet(1180000), 0, kNow + 180000)) << "in time again";
}

// verifies: SK-LI-2
TEST_F(LidarIntakeTest, SilenceOfEitherCountsOnceBothWereHeard) {
  EXPECT_FALSE(intake->all_heard());
  ASSERT_TRUE(take(packet(1000), 0));
  EXPECT_FALSE(intake->all_heard());
  EXPECT_FALSE(intake->silent(kNow + 10000000, 200000));
  ASSERT_TRUE(take(packet(1000), 1));
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
    const Bytes bytes = seeing(10000 * (rig.machine.cycle() + 1));
    ASSERT_TRUE(rig.in->take_lidar(0, bytes.data(), bytes.size()));
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
