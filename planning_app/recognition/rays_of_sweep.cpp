#include "recognition/rays_of_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "recognition/cab_profile.hpp"
#include "recognition/lanes.hpp"

namespace berm::app {
namespace {

using Eigen::Vector2d;

constexpr double kBeside = 0.6;  // m
constexpr double kAround = 7.0;  // m: half of the longest bed and a cab
constexpr double kAroundBelow = 2.2, kAroundAbove = 1.0;  // m of the walls' tops

BERM_APP_INLINE Eight eight_of(const std::vector<float>& all, std::size_t first, std::size_t count) {
  Eight out{};
  if (count == kLanes) std::memcpy(&out, all.data() + first, sizeof out);  // known where it is compiled, and so one move
  else std::memcpy(&out, all.data() + first, count * sizeof(float));
  return out;
}

// A return's ray passes within radius of middle, in plan, and comes there between the heights low and high. out: as long as there are returns, and eight more.
BERM_APP_LANES std::size_t find_passing(const FanSweep& sweep, const Surroundings& place, std::uint32_t* out) {
  std::size_t found = 0;
  const Eight radius = eight(place.radius), square_radius = eight(place.radius * place.radius), low = eight(place.low), high = eight(place.high);
  for (std::size_t fan = 0; fan < sweep.heads.size(); ++fan) {
    const Eigen::Vector3d& head = sweep.heads[fan];
    const double to_x = place.middle.x() - head.x(), to_y = place.middle.y() - head.y(), square = to_x * to_x + to_y * to_y;
    const FanPlan& plan = sweep.plans[fan];
    if (std::abs(plan.normal[0] * to_x + plan.normal[1] * to_y) > place.radius + plan.spread * std::sqrt(square) + 1e-5) continue;  // the whole fan passes it
    const Eight x = eight(to_x), y = eight(to_y), beyond = eight(square) - square_radius, z = eight(head.z());
    for (std::size_t k = sweep.begin[fan]; k < sweep.begin[fan + 1]; k += kLanes) {
      const std::size_t count = std::min(kLanes, sweep.begin[fan + 1] - k);
      const Eight slope = eight_of(sweep.directions.slope, k, count);
      const Eight along = eight_of(sweep.directions.x, k, count) * x + eight_of(sweep.directions.y, k, count) * y;
      const Eight near = z + slope * (along - radius), far = z + slope * (along + radius);
      const EightInt passes = (along > 0.0F) & (along * along >= beyond) & (most8(near, far) >= low) & (least8(near, far) <= high);
      if (!any8(passes)) continue;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        out[found] = static_cast<std::uint32_t>(k + lane);
        found += passes[lane] != 0 ? 1 : 0;
      }
    }
  }
  return found;
}

}  // namespace

PassingRays::PassingRays(const FanSweep& sweep, const Surroundings& place)
    : sweep_(sweep), numbers_(std::make_unique_for_overwrite<std::uint32_t[]>(sweep.returns.size() + kLanes)), count_(find_passing(sweep, place, numbers_.get())) {}

std::vector<Ray> PassingRays::rays(std::size_t stride) const {
  std::vector<Ray> out;
  out.reserve(count_ / stride + 1);
  visit_with_heads(stride, [&](const Eigen::Vector3f& head, const FanReturn& r) { out.push_back({head, r.place, r.upright}); });
  return out;
}

PackedRays PassingRays::packed(std::size_t stride) const {
  PackedRays out;
  out.reserve(count_ / stride + 1);
  visit_with_heads(stride, [&](const Eigen::Vector3f& head, const FanReturn& r) { out.add(head, r.place, r.upright); });
  return out;
}

Surroundings near_bed(const BedPose& pose, double below) {
  const double radius = std::hypot(pose.length / 2, pose.width / 2) + pose.thickness + kBeside;
  return {pose.middle.head<2>(), radius, pose.middle.z() - below, pose.middle.z() + kBeside};
}

Surroundings around_bed(const Eigen::Vector3d& middle) { return {middle.head<2>(), kAround, middle.z() - kAroundBelow, middle.z() + kAroundAbove}; }

Surroundings around_cabs(const BedPose& pose, double farthest) {
  return {pose.middle.head<2>(), std::hypot(pose.length / 2 + pose.thickness + farthest, kCabAside), pose.middle.z() - kAroundBelow, pose.middle.z() + kAroundAbove};
}

std::vector<Ray> rays_near(const FanSweep& sweep, const BedPose& pose, double below, std::size_t stride) {
  return PassingRays(sweep, near_bed(pose, below)).rays(stride);
}

std::vector<Ray> every(const std::vector<Ray>& rays, std::size_t stride) {
  std::vector<Ray> some;
  some.reserve(rays.size() / stride + 1);
  for (std::size_t i = 0; i < rays.size(); i += stride) some.push_back(rays[i]);
  return some;
}

SomeRays about(const FanSweep& sweep, const Surroundings& place, std::size_t most, std::size_t least) {
  const PassingRays passing(sweep, place);
  const std::size_t stride = std::max(least, passing.size() / most);
  return {passing.packed(stride), static_cast<double>(stride)};
}

}  // namespace berm::app
