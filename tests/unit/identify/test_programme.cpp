// Which poses are tested: each in its row, above the ground, with every row reached.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "identify/programme.hpp"

namespace berm::identify::test {
namespace {

TEST(Programme, EveryRowOfTheSwingHasAPoseJustWithinItsReach) {
  const auto m = config::load_machine_file(BERM_MACHINE_FILE);
  std::array<int, 4> poses{};
  for (const Station& s : stations(m, {swing})) {
    ASSERT_EQ(s.joint, swing);
    ++poses[s.row];
    EXPECT_NEAR(s.reach_m, reach_m(m, s.pose), 1e-12);
    EXPECT_LT(s.reach_m, m.braking.reach[s.row]);
    EXPECT_GT(s.reach_m, m.braking.reach[s.row] - (s.row == 3 ? 0.9 : 0.2)) << "row " << s.row;  // no pose reaches the last row's end
    EXPECT_GT(lowest_m(m, s.pose), 0.5);
    EXPECT_GT(s.span.high - s.span.low, 5.0);
  }
  for (const int count : poses) EXPECT_GE(count, 1);
}

TEST(Programme, ArmJointsKeepAboveTheGroundOverTheirWholeSpan) {
  const auto m = config::load_machine_file(BERM_MACHINE_FILE);
  for (const std::size_t joint : {boom, stick, bucket}) {
    const auto all = stations(m, {joint});
    EXPECT_GE(all.size(), 2u);
    for (const Station& s : all) {
      Joints pose = s.pose;
      for (pose[joint] = s.span.low; pose[joint] <= s.span.high; pose[joint] += 0.01) EXPECT_GT(lowest_m(m, pose), 0.5);
      EXPECT_GE(s.span.low, m.joint[joint].low);
      EXPECT_LE(s.span.high, m.joint[joint].high);
    }
  }
}

// Straight out over the ground: pins and tip in one line.
TEST(Programme, ReachAndHeightOfAStretchedPose) {
  const auto m = config::load_machine_file(BERM_MACHINE_FILE);
  const Joints level{};
  EXPECT_NEAR(reach_m(m, level), std::hypot(m.boom_pin_x + m.boom + m.stick + 1.62, 0.6), 1e-9);
  EXPECT_NEAR(lowest_m(m, level), m.boom_pin_z - 0.45, 1e-9);
  EXPECT_GT(middle_m(m, level, 3), middle_m(m, level, 2));
}

}  // namespace
}  // namespace berm::identify::test
