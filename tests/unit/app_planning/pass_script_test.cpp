// The shipped script of a pass against joint angles that a test prescribes.
#include <gtest/gtest.h>

#include "app_bench/bench_machine.hpp"
#include "app_bench/bench_site.hpp"
#include "planning/pass_script.hpp"

namespace {

using namespace berm::app;

// A bucket that let go of what it held too much stands open when the swing begins. It has to be closed and opened again over the bed before the arm
// goes where an opened bucket empties, or the arm never comes to where the bucket may open.
TEST(PassScript, ATrimmedBucketOpensOverTheBed) {
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
      script.evaluate(angle, event_weighed);
      const Joints goals = script.goals();
      for (std::size_t j = 0; j < joints; ++j) angle[j] += std::clamp(goals[j] - angle[j], -radians(1.0), radians(1.0));
    }
    EXPECT_TRUE(script.of(bucket).reached(RuleMark::opens)) << "bucket at " << degrees(at_start) << " degrees when the swing begins";
  }
}

}  // namespace
