// The shipped script of a pass against joint angles that a test prescribes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "app_bench/bench_machine.hpp"
#include "app_bench/bench_site.hpp"
#include "motion/arm_kinematics.hpp"
#include "planning/pass_search.hpp"
#include "planning/skyline.hpp"

namespace {

using namespace berm::app;

// Without a dump point.
PassTask on_the_bench() {
  PassTask task;
  task.truck_bearing = radians(96.0);
  task.next_entry = {7.4, -1.6};
  task.truck_top = task.wall_top = berm::app_bench::bench_bed().wall_top;
  return task;
}

// A bucket may stand open when the swing begins. It has to be closed and opened again over the bed before the arm goes where an opened bucket empties, or the
// arm never comes to where the bucket may open.
TEST(PassScript, ABucketThatStandsOpenWhenTheSwingBeginsOpensOverTheBed) {
  const MachineModel m = berm::app_bench::zx200();
  const ScriptSet scripts = berm::app_bench::shipped_scripts();
  PassTask task;
  task.truck_bearing = radians(35.0);  // near enough that the arm reaches out before the bucket is closed
  task.dump_radius = 6.8;
  task.next_entry = {7.4, -1.6};
  task.truck_top = task.wall_top = berm::app_bench::bench_bed().wall_top;
  const auto poses = pass_poses(m, task);
  ASSERT_TRUE(poses);
  task.lifted_from = poses->carry;
  PassThresholds thresholds;
  thresholds.swing_start_boom = poses->carry[boom] - radians(5.0);
  thresholds.fold_boom = thresholds.swing_start_boom;
  thresholds.extend_offset = radians(30.0);
  thresholds.open_offset = radians(8.0);
  thresholds.open_stick = poses->spill[stick] - radians(6.0);
  thresholds.pour_bucket = poses->spill[bucket] + radians(20.0);
  thresholds.hover_offset = thresholds.lower_offset = radians(10.0);
  for (const double at_start : {poses->carry[bucket], thresholds.pour_bucket + radians(40.0)}) {
    Script script = pass_script(scripts, m, task, *poses, thresholds);
    Joints angle = poses->carry;
    angle[bucket] = at_start;
    script.start();
    for (int step = 0; step < 1000 && !script.of(bucket).reached(RuleMark::opens); ++step) {
      script.evaluate(angle, event_weighed | event_scanned);
      const Joints goals = script.goals();
      for (std::size_t j = 0; j < joints; ++j) angle[j] += std::clamp(goals[j] - angle[j], -radians(1.0), radians(1.0));
    }
    EXPECT_TRUE(script.of(bucket).reached(RuleMark::opens)) << "bucket at " << degrees(at_start) << " degrees when the swing begins";
  }
}

// Where it can be held level it opens while the stick still reaches out, for what lies level slides late; not where soil slides as soon as it opens.
TEST(PassScript, TheBucketOpensEarlierWhereItIsHeldLevel) {
  const MachineModel m = berm::app_bench::zx200();
  const ScriptSet scripts = berm::app_bench::shipped_scripts();
  const SiteModel site = berm::app_bench::bench_with_truck();
  const Skyline sky(m, site, ground_of(TerrainMap()));
  PassTask task = on_the_bench();
  const auto before_spill = [&](double dump_radius) {
    task.dump_radius = dump_radius;
    const auto poses = pass_poses(m, task);
    EXPECT_TRUE(poses) << dump_radius;
    if (!poses) return std::tuple(0.0, 0.0, 0.0);
    task.lifted_from = poses->carry;
    const PassThresholds first = PassSearch(scripts, m, sky, task, *poses).thresholds();
    // The swing's landing is v = sqrt(2 a d) with a as it is at that reach.
    const double brake = limits_of(m, swing, reach_of(m, poses->spill)).deceleration;
    return std::tuple(degrees(forward(m, poses->spill).bucket_attitude), degrees(poses->spill[stick] - first.open_stick), std::sqrt(2.0 * first.open_offset / brake));
  };
  const auto [level, early, before_s] = before_spill(6.4);
  const auto [tilted, late, tilted_before_s] = before_spill(farthest_dump(m, task.wall_top));
  EXPECT_LT(level, -160.0);
  EXPECT_GT(tilted, -157.0);
  EXPECT_NEAR(early, 14.0, 1e-9);
  EXPECT_NEAR(late, 6.0, 1e-9);
  EXPECT_NEAR(before_s, 1.0, 1e-9) << "s before the swing stands, at the soonest";
  EXPECT_NEAR(tilted_before_s, 0.5, 0.03) << "no nearer than 2 degrees";
}

// Beyond the easy reach a heap slides off short of the near wall: the farther, the less is to be in the bucket.
TEST(PassScript, AHeapIsNotDumpedWhereTheBucketCannotBeHeldLevel) {
  const MachineModel m = berm::app_bench::zx200();
  const double wall_top = on_the_bench().wall_top, farthest = farthest_dump(m, wall_top);
  EXPECT_EQ(share_at_reach(m, wall_top, 5.0), 1.0);
  EXPECT_NEAR(share_at_reach(m, wall_top, farthest - 0.25), 1.0, 1e-9);
  EXPECT_NEAR(share_at_reach(m, wall_top, farthest - 0.10), 0.91, 1e-9);
  EXPECT_NEAR(share_at_reach(m, wall_top, farthest), 0.85, 1e-9);
  EXPECT_NEAR(share_at_reach(m, wall_top, farthest + 1.0), 0.85, 1e-9) << "nothing is dumped there";
}

// What sticks lets go last, when the bucket is open farthest: it has to fall where the load fell, not beyond the far wall.
TEST(PassScript, ABucketThatOpensFartherKeepsItsLipOverTheBed) {
  const MachineModel m = berm::app_bench::zx200();
  PassTask task = on_the_bench();
  for (const double dump_radius : {6.2, 6.8, 7.2}) {
    task.dump_radius = dump_radius;
    task.open_farther = 0.0;
    const auto usual = pass_poses(m, task);
    ASSERT_TRUE(usual) << dump_radius;
    for (const double farther : {13.0, 26.0, 38.0}) {
      task.open_farther = radians(farther);
      const auto opened = pass_poses(m, task);
      ASSERT_TRUE(opened) << dump_radius;
      const ArmPoints before = forward(m, usual->dump), now = forward(m, opened->dump);
      EXPECT_GT(now.bucket_attitude, before.bucket_attitude + radians(5.0)) << dump_radius << " m, " << farther << " degrees farther";
      EXPECT_NEAR(now.tip.r, before.tip.r, 1e-6) << dump_radius << " m, " << farther << " degrees farther";
      EXPECT_NEAR(now.bucket_pin.z, before.bucket_pin.z, 1e-6);
    }
  }
}

// Passing over something high draws the stick in: it is carried farther out, or the guard would let the swing creep all the way.
TEST(PassScript, TheArmIsCarriedClearOfTheMachine) {
  const MachineModel m = berm::app_bench::zx200();
  const Skyline nothing(m, SiteModel{}, [](double, double) { return -5.0; });
  PassTask task = on_the_bench();
  task.dump_radius = 6.8;
  for (double top = task.wall_top; top < 1.3; top += 0.1) {
    task.truck_top = top;
    const auto poses = pass_poses(m, task);
    ASSERT_TRUE(poses) << top;
    for (const Joints& pose : {poses->carry, poses->back}) {
      const auto blocking = nothing.blocking(preview(m, pose, {}));
      EXPECT_FALSE(blocking) << blocking->name() << " over " << top << " m";
      EXPECT_LT(forward(m, pose).bucket_pin.r, 6.4 + (top < 0.5 ? 0.001 : 0.5)) << "no farther out than it must be";
    }
  }
}

// Over a high load the pin is high and drawn in: no nearer than the kernel lets stick and bucket come to the machine's own body, and no farther out than it must be.
TEST(PassScript, AnOpenBucketStaysClearOfTheMachine) {
  const MachineModel m = berm::app_bench::zx200();
  const Skyline nothing(m, SiteModel{}, [](double, double) { return -5.0; });
  PassTask task = on_the_bench();
  for (const double load : {0.0, 0.3, 0.6})
    for (double dump_radius = 5.7; dump_radius < 7.3; dump_radius += 0.1) {
      double usual_r = 100.0;
      for (const double farther : {0.0, 13.0, 26.0, 38.0}) {
        task.truck_top = task.wall_top + load;
        task.dump_radius = dump_radius;
        task.open_farther = radians(farther);
        const auto poses = pass_poses(m, task);
        ASSERT_TRUE(poses);
        const auto blocking = nothing.blocking(preview(m, poses->dump, {}));
        const ArmPoints open = forward(m, poses->dump);
        EXPECT_FALSE(blocking) << blocking->name() << ", " << dump_radius << " m, load " << load << " m, " << farther << " degrees farther";
        EXPECT_GT(open.bucket_attitude, radians(-49.0));
        EXPECT_LT(open.bucket_pin.r, dump_radius + 0.26);
        if (load == 0.0) {
          EXPECT_LT(open.bucket_pin.r, dump_radius - 0.24) << "it need not be";
        }
        EXPECT_LT(open.bucket_pin.r, usual_r + 1e-6) << "for what sticks it is opened less far rather than farther out";
        usual_r = std::min(usual_r, open.bucket_pin.r);
      }
    }
}

// A part of a load slides while the bucket tilts on as far as that takes: the lip stays short of where soil falls beside the far wall, and the pin as high as it was.
TEST(PassScript, ALoadThatIsPouredInPartKeepsItsLipOverTheBed) {
  const MachineModel m = berm::app_bench::zx200();
  PassTask task = on_the_bench();
  for (const double dump_radius : {6.2, 6.8, 7.2}) {
    task.dump_radius = dump_radius;
    const auto poses = pass_poses(m, task);
    ASSERT_TRUE(poses) << dump_radius;
    const ArmPoints spill = forward(m, poses->spill);
    double drawn_in = 0.0;
    for (double attitude = -175.0; attitude <= -50.0; attitude += 5.0) {
      Joints pose = part_pose(m, task, *poses, radians(attitude));
      pose[bucket] = radians(attitude) - pose[boom] - pose[stick];
      const ArmPoints arm = forward(m, pose);
      EXPECT_LT(arm.tip.r, dump_radius + 0.31) << dump_radius << " m, " << attitude << " degrees";
      pose[bucket] = std::min(pose[bucket] + radians(15.0), radians(-48.0) - pose[boom] - pose[stick]);
      EXPECT_LT(forward(m, pose).tip.r, dump_radius + 0.31) << dump_radius << " m, the bucket ahead, " << attitude << " degrees";
      EXPECT_NEAR(arm.bucket_pin.z, spill.bucket_pin.z, 1e-6);
      EXPECT_GE(spill.bucket_pin.r - arm.bucket_pin.r, drawn_in - 1e-9) << "goes out again, " << dump_radius << " m, " << attitude << " degrees";
      drawn_in = spill.bucket_pin.r - arm.bucket_pin.r;
      if (attitude < -125.0) {
        EXPECT_EQ(drawn_in, 0.0) << "the lip is not there yet";
      }
    }
    EXPECT_GT(drawn_in, 0.5);
  }
}

// Mouth up at any attitude of the stick, as far as the bucket's range goes.
TEST(PassScript, ALevelBucketIsAsLevelAsItsRangeAllows) {
  const MachineModel m = berm::app_bench::zx200();
  for (double stick_attitude = -100.0; stick_attitude <= 60.0; stick_attitude += 5.0) {
    const double angle = level_bucket(m, radians(stick_attitude)), attitude = stick_attitude + degrees(angle);
    EXPECT_GE(angle, m.joint[bucket].low);
    if (angle > m.joint[bucket].low + radians(10.0)) {
      EXPECT_NEAR(attitude, -178.0, 1e-9) << stick_attitude;
    } else {
      EXPECT_GE(attitude, -178.0 - 1e-9) << stick_attitude;
    }
  }
}

}  // namespace
