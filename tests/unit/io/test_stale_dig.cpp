// Stale ground in a dig zone: a bucket that hides it may be folded in and up, and nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "geometry/kinematics.hpp"
#include "io/motion_check.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::int64_t kNow = 100'000'000;
constexpr std::int32_t kCreep = 20000;  // urad/s, below every joint's creep speed

// The bucket's tip in level ground 8 m out, all of it in a dig zone.
class StaleDig : public testing::Test {
 protected:
  StaleDig() : parameters(berm::test::demo_parameters()) {
    parameters.dig_zones = 1;
    parameters.dig_zone[0].x_low_mm = parameters.dig_zone[0].y_low_mm = -14000;
    parameters.dig_zone[0].x_high_mm = parameters.dig_zone[0].y_high_mm = 14000;
    parameters.dig_zone[0].floor_mm = -3000;
    parameters.dig_zone[0].ceiling_mm = 1000;
    own_cells = std::make_unique<OwnCells>(parameters);
    check = std::make_unique<MotionCheck>(parameters, *own_cells);
    const Kinematics kinematics(parameters);
    JointAngles angles{0.0, 0.9, -1.6, -0.6};
    while (kinematics.tip_in_base(angles).z() > -0.1 && angles.boom > -0.5) angles.boom -= 0.005;
    const double at[] = {angles.swing, angles.boom, angles.stick, angles.bucket};
    for (int j = 0; j < SK_JOINTS; ++j) angle_urad[j] = static_cast<std::int32_t>(std::lround(at[j] * 1e6));
  }
  void seen(std::int64_t age_us) {
    sk_map_clear(&map);
    for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) sk_map_insert(&map, iy, ix, 0, kNow - age_us, parameters.generation_us);
    own_cells->stamp(map, kNow, parameters.generation_us);
  }
  MotionVerdict ask(std::int32_t swing, std::int32_t boom, std::int32_t stick, std::int32_t bucket) {
    MotionQuery query{};
    query.now_us = kNow;
    const std::int32_t wanted[] = {swing, boom, stick, bucket};
    for (int j = 0; j < SK_JOINTS; ++j) {
      query.angle_urad[j] = angle_urad[j];
      query.velocity_urad_s[j] = velocity_urad_s[j];
      query.requested_urad_s[j] = wanted[j];
    }
    MotionVerdict verdict{};
    check->check(query, map, verdict);
    return verdict;
  }
  berm_parameters parameters;
  std::unique_ptr<OwnCells> own_cells;
  std::unique_ptr<MotionCheck> check;
  std::int32_t angle_urad[SK_JOINTS], velocity_urad_s[SK_JOINTS] = {};
  sk_height_map map;
};

// verifies: SK-CY-22
TEST_F(StaleDig, FreshGroundMayBeTouchedEveryWay) {
  seen(0);
  for (int joint = 0; joint < SK_JOINTS; ++joint)
    for (const std::int32_t way : {kCreep, -kCreep}) {
      std::int32_t v[SK_JOINTS] = {};
      v[joint] = way;
      EXPECT_NE(ask(v[0], v[1], v[2], v[3]).permission, Permission::kHeld) << joint << ", " << way;
    }
}

// verifies: SK-CY-22
TEST_F(StaleDig, OverStaleGroundTheArmFoldsInAndUpAndNothingElseMoves) {
  seen(parameters.fresh_us + 1);
  EXPECT_EQ(ask(0, kCreep, 0, 0).permission, Permission::kCreep) << "boom up";
  EXPECT_EQ(ask(0, 0, -kCreep, 0).permission, Permission::kCreep) << "stick in";
  EXPECT_EQ(ask(0, 0, 0, -kCreep).permission, Permission::kCreep) << "bucket curled";
  EXPECT_EQ(ask(0, kCreep, -kCreep, -kCreep).permission, Permission::kCreep);
  for (const std::int32_t way : {kCreep, -kCreep}) {
    EXPECT_EQ(ask(way, 0, 0, 0).permission, Permission::kHeld) << "to a side";
    EXPECT_EQ(ask(way, kCreep, 0, 0).permission, Permission::kHeld) << "to a side and up";
  }
  EXPECT_EQ(ask(0, -kCreep, 0, 0).permission, Permission::kHeld) << "down";
  EXPECT_EQ(ask(0, 0, kCreep, 0).permission, Permission::kHeld) << "outward";
  EXPECT_EQ(ask(0, 0, 0, kCreep).permission, Permission::kHeld) << "opened";
  EXPECT_EQ(ask(0, -kCreep, 0, 0).reason, BERM_STOP_STALE_GROUND);
}

// What goes on after its command would sweep to a side, down or outward all the same.
// verifies: SK-CY-22
TEST_F(StaleDig, NorDoesAnArmFoldThatYetMovesAnotherWay) {
  seen(parameters.fresh_us + 1);
  const std::int32_t moves = parameters.standstill_urad_s + 1;
  ASSERT_LT(moves, kCreep);
  for (int joint = 0; joint < SK_JOINTS; ++joint)
    for (const std::int32_t way : {moves, -moves}) {
      velocity_urad_s[joint] = way;
      const bool folds = joint == BERM_BOOM ? way > 0 : joint != BERM_SWING && way < 0;
      EXPECT_EQ(ask(0, kCreep, 0, 0).permission, folds ? Permission::kCreep : Permission::kHeld) << joint << ", " << way;
      velocity_urad_s[joint] = folds ? way : parameters.standstill_urad_s;
      EXPECT_EQ(ask(0, kCreep, 0, 0).permission, Permission::kCreep) << joint << ", at rest";
      velocity_urad_s[joint] = 0;
    }
}

}  // namespace
}  // namespace berm::kernel::test
