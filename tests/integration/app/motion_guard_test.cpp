// What the guard makes of a request where something too high to be passed over stands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
  // The same under the bucket, as the kernel's map has it. distance: from the swing axis, m.
  static Skyline cell_of_map(const MachineModel& machine, const SiteModel& site, double bearing, double distance, double top) {
    const auto index = [](double v) { return std::floor(v / 0.3); };
    const double ix = index(distance * std::cos(bearing)), iy = index(distance * std::sin(bearing));
    return Skyline(machine, site, [=](double x, double y) { return index(x) == ix && index(y) == iy ? top : 0.01; }, Skyline::OverHigh::refused);
  }
  static bool stands(const Joints& v) { return std::all_of(v.begin(), v.end(), [](double x) { return x == 0.0; }); }

  const MachineModel machine_ = app_bench::zx200();
  const SiteModel site_ = app_bench::bench_with_truck();
  const Joints carried_{radians(40.0), radians(42.0), radians(-88.0), radians(-127.0)}, low_{radians(40.0), radians(26.0), radians(-88.0), radians(-127.0)};
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

// Standing is clear of it yet, and creeping is not.
TEST_F(MotionGuard, NothingCreepsTowardsItWhereOnlyStandingIsClearEither) {
  const Skyline beside = post(machine_, site_, carried_[swing] + radians(20.0), 1.4);
  Joints near = carried_;
  while (beside.clear(near, crept(machine_, to_left_))) near[swing] += radians(0.02);
  ASSERT_TRUE(beside.clear(near, {})) << "it stands too near";
  EXPECT_TRUE(stands(guarded(machine_, beside, near, to_left_)));
  EXPECT_EQ(guarded(machine_, beside, near, to_right_), to_right_);
}

// What a box meets first of it is ground that is too near below the bucket; that it is too high besides tells that no creeping will help.
TEST_F(MotionGuard, NorWhereItReachesUpToTheBucket) {
  const double distance = reach_of(machine_, carried_) - 0.6, underside = bucket_underside(machine_, carried_);
  const double too_high = std::max(1.4, underside + 0.2);
  for (const double side : {1.0, -1.0}) {
    const Joints& towards = side > 0.0 ? to_left_ : to_right_;
    double aside = radians(25.0);  // the farthest at which it is too near
    const auto cell = [&] { return cell_of_map(machine_, site_, carried_[swing] + side * aside, distance, too_high); };
    while (aside > 0.0 && cell().clear(carried_, {})) aside -= radians(0.5);
    const Skyline beside = cell();
    const auto met = beside.blocking(preview(machine_, carried_, {}));
    ASSERT_TRUE(met && met->what == Skyline::Blocking::What::ground) << "it stands too near";
    EXPECT_TRUE(beside.stands_too_high(*met));
    EXPECT_TRUE(stands(guarded(machine_, beside, carried_, towards))) << side;
  }
}

// A heap in the bed, or the face: close below the bucket, but no higher than the site's limits.
TEST_F(MotionGuard, BesideWhatIsNotTooHighItCreeps) {
  const Joints lowered{carried_[swing], carried_[boom] - radians(35.0), carried_[stick], carried_[bucket]};
  const double distance = reach_of(machine_, lowered) - 0.6, top = bucket_underside(machine_, lowered) + 0.1;
  ASSERT_LT(top, 0.7) << "or it would be too high";
  const Skyline beside = cell_of_map(machine_, site_, carried_[swing] + radians(10.0), distance, top);
  const auto met = beside.blocking(preview(machine_, lowered, {}));
  ASSERT_TRUE(met && met->what == Skyline::Blocking::What::ground);
  EXPECT_FALSE(beside.stands_too_high(*met));
  EXPECT_EQ(guarded(machine_, beside, lowered, to_left_), crept(machine_, to_left_));
}

// Where a pose is clear by so little that no motion is: what begins slowly from standing would never begin.
TEST_F(MotionGuard, WhereOnlyStandingIsClearItCreeps) {
  const auto at = [&](double height) { return Skyline(machine_, site_, [=](double, double) { return height; }, Skyline::OverHigh::refused); };
  double height = 0.6;
  while (!at(height).clear(low_, {})) height -= 0.001;
  const Joints begins{0.0, radians(-1.0), 0.0, 0.0};
  const Skyline ground = at(height);
  ASSERT_FALSE(ground.clear(low_, begins)) << "the test shows nothing";
  EXPECT_EQ(guarded(machine_, ground, low_, begins), begins);
  const Joints lowers{0.0, radians(-20.0), 0.0, 0.0};
  EXPECT_EQ(guarded(machine_, ground, low_, lowers), crept(machine_, lowers));
  EXPECT_FALSE(stands(crept(machine_, lowers)));
}

// Slower in small steps, before it creeps.
TEST_F(MotionGuard, TheArmIsSlowedToAsMuchAsIsClear) {
  const Joints lowers{0.0, radians(-20.0), 0.0, 0.0};
  Joints slow = lowers;
  slow[boom] *= 0.15;
  const auto at = [&](double height) { return Skyline(machine_, site_, [=](double, double) { return height; }, Skyline::OverHigh::refused); };
  double height = 0.6;
  while (!at(height).clear(low_, slow)) height -= 0.001;
  EXPECT_EQ(guarded(machine_, at(height), low_, lowers), slow);
}

// What nobody has seen below the bucket may be nothing: the kernel decides.
TEST_F(MotionGuard, OverUnseenGroundItCreeps) {
  const double distance = reach_of(machine_, carried_) - 0.6;
  const Skyline beside = cell_of_map(machine_, site_, carried_[swing] + radians(10.0), distance, std::numeric_limits<double>::infinity());
  const auto met = beside.blocking(preview(machine_, carried_, {}));
  ASSERT_TRUE(met && met->what == Skyline::Blocking::What::ground && met->unseen());
  EXPECT_EQ(guarded(machine_, beside, carried_, to_left_), crept(machine_, to_left_));
}

TEST(CutShort, IsWhatDoesNotGetToItsGoal) {
  const Joints angle{radians(179.0), 0.0, 0.0, 0.0}, wanted{radians(5.0), radians(2.0), 0.0, 0.0};
  const Joints far{radians(-178.5), radians(20.0), 0.0, 0.0}, there{radians(-180.2), radians(0.9), 0.0, 0.0};
  EXPECT_FALSE(cut_short(angle, wanted, wanted, far));
  EXPECT_FALSE(cut_short(angle, wanted, wanted, std::nullopt));
  for (const Joints& allowed : {Joints{}, Joints{wanted[swing] / 2.0, wanted[boom], 0.0, 0.0}, Joints{wanted[swing], 0.0, 0.0, 0.0}}) {
    EXPECT_TRUE(cut_short(angle, wanted, allowed, far));
    EXPECT_TRUE(cut_short(angle, wanted, allowed, std::nullopt)) << "a dig has no goals";
    EXPECT_FALSE(cut_short(angle, wanted, allowed, there)) << "it trembles at its goal";
  }
  EXPECT_TRUE(cut_short(angle, wanted, {}, Joints{there[swing], far[boom], 0.0, 0.0})) << "one of them is not there";
}

}  // namespace
}  // namespace berm::app
