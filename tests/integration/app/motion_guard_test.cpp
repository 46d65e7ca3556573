// What the guard makes of a request where something too high to be passed over stands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/motion_guard.hpp"
#include "app_bench/bench_machine.hpp"

namespace berm::app {
namespace {

class MotionGuard : public testing::Test {
protected:
  // A cell of the kernel's map, at 3.7 m from the swing axis, under the boom.
  static Skyline post(const MachineModel& machine, const SiteModel& site, double bearing, double top) {
    TerrainMap terrain;
    for (double dx = -0.1; dx < 0.15; dx += 0.1)
      for (double dy = -0.1; dy < 0.15; dy += 0.1) terrain.insert(3.7 * std::cos(bearing) + dx, 3.7 * std::sin(bearing) + dy, top, 1.0);
    return Skyline(machine, site, ground_of(terrain), Skyline::OverHigh::refused);
  }
  static bool stands(const Joints& v) { return std::all_of(v.begin(), v.end(), [](double x) { return x == 0.0; }); }

  const MachineModel machine_ = app_bench::zx200();
  const SiteModel site_ = app_bench::bench_with_truck();
  const Joints carried_{radians(40.0), radians(42.0), radians(-88.0), radians(-127.0)};
  const Joints to_left_{radians(30.0), 0.0, 0.0, 0.0}, to_right_{radians(-30.0), 0.0, 0.0, 0.0};
};

TEST_F(MotionGuard, FarFromWhatIsTooHighNothingIsSlowed) {
  EXPECT_EQ(guarded(machine_, post(machine_, site_, radians(110.0), 1.4), carried_, to_left_), to_left_);
  EXPECT_EQ(guarded(machine_, post(machine_, site_, radians(49.0), 0.7), carried_, to_left_), to_left_) << "low enough to be passed over";
}

TEST_F(MotionGuard, BeforeItTheSwingIsSlowedSoThatItCanStop) {
  const Joints allowed = guarded(machine_, post(machine_, site_, radians(65.0), 1.4), carried_, to_left_);
  EXPECT_LT(allowed[swing], to_left_[swing]);
  EXPECT_EQ(guarded(machine_, post(machine_, site_, radians(65.0), 1.4), carried_, to_right_), to_right_);
}

// Nearer than its own margins allow, but not nearer than the kernel's: towards it would end in a stop.
TEST_F(MotionGuard, BesideItNothingCreepsTowardsItButAwayFromIt) {
  for (const double side : {1.0, -1.0}) {
    const Skyline beside = post(machine_, site_, carried_[swing] + side * radians(13.0), 1.4);
    ASSERT_FALSE(beside.clear(carried_, {})) << "it stands too near";
    const Joints& towards = side > 0.0 ? to_left_ : to_right_;
    const Joints& away = side > 0.0 ? to_right_ : to_left_;
    EXPECT_TRUE(stands(guarded(machine_, beside, carried_, towards))) << side;
    EXPECT_EQ(guarded(machine_, beside, carried_, away), crept(machine_, away)) << side;
    EXPECT_FALSE(stands(crept(machine_, away)));
  }
}

}  // namespace
}  // namespace berm::app
