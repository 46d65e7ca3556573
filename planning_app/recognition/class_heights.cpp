#include "recognition/class_heights.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kBeyondOften = 0.03;  // to each truck of a class, before any return
constexpr double kSoftSteps = 4.0;     // of kStep, over which a class ends

}  // namespace

bool ClassHeights::any() const {
  return std::any_of(within.begin(), within.end(), [](double w) { return w > kImpossible; });
}

ClassHeights class_heights(const TruckRangeSet& ranges, bool half_pipe, double width) {
  ClassHeights out;
  for (DepthWeights* w : {&out.within, &out.in_slack, &out.beyond}) w->fill(kImpossible);
  const double rare = std::log(kBeyondOften * static_cast<double>(ranges.classes.size()) / (kDeepestSeen - kShallowest));
  for (std::size_t i = 0; i < kDepths; ++i) {
    const double depth = depth_of(i);
    bool allowed = false;
    for (const TruckRanges& c : ranges.classes) {
      if (c.half_round != half_pipe) continue;
      const double off = outside_by(depth, c.wall_height), steps = off / kStep;
      allowed = allowed || off <= ranges.slack;
      if (steps < kSoftSteps) out.within[i] = add_logs(out.within[i], -0.5 * steps * steps - std::log(std::max(c.wall_height[1] - c.wall_height[0], kStep)));
    }
    if (!half_pipe || depth > width / 2) (allowed ? out.in_slack : out.beyond)[i] = rare;
  }
  return out;
}

}  // namespace berm::app
