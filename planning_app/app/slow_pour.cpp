#include "app/slow_pour.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

double share_run_out_over(const MachineModel& machine, double way_back) {
  constexpr double runs_out = radians(115.0);  // of the bucket: from where its load begins to slide until all of it has
  constexpr double spare = 0.8;                // the bucket is not as far as the swing, or slower than its share
  const double bucket_for_swing = machine.joint[bucket].velocity_max / machine.joint[swing].velocity_max;
  return std::clamp(spare * bucket_for_swing * way_back / runs_out, 0.0, 1.0);
}

bool lip_still_comes(double share_beside, const Joints& goals, const Joints& angle, const Joints& velocity) {
  constexpr double least_beside = 0.1, there = radians(2.0), moves = radians(0.3);  // 1/s
  if (share_beside < least_beside) return false;
  for (const Joint j : {swing, boom, stick}) {
    const double to_go = goals[j] - angle[j];
    if (std::fabs(to_go) > there && to_go * velocity[j] > 0.0 && std::fabs(velocity[j]) > moves) return true;
  }
  return false;
}

}  // namespace berm::app
