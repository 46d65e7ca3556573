#include "recognition/bed_ground.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kGroundSlack = 0.15;  // m: ruts
constexpr std::size_t kReturnsLeast = 25;
constexpr double kBesideFrom = 0.2, kBesideTo = 2.5;         // m beyond the outer faces
constexpr double kFarFrom = 0.2, kFarTo = 1.5;             // m beyond the outer faces of the far walls
constexpr double kAtTops = 0.3, kLow = 1.8;                 // m of the tops; below them
constexpr int kLevelLeast = 30, kLevelToLow = 20;          // returns; level ones to each that lies low

}  // namespace

std::vector<double> depths_beside(const FanSweep& sweep, const BedPose& pose, std::size_t stride) {
  const Eigen::Matrix3d turn = pose.rotation().transpose();
  std::vector<double> out;
  for (std::size_t k = 0; k < sweep.returns.size(); k += stride) {
    const Eigen::Vector3d from = sweep.returns[k].at() - pose.middle;
    const double across = std::abs(turn.row(1).dot(from)) - pose.width / 2 - pose.thickness;  // first, for most lie too far off
    if (across > kBesideTo) continue;
    const double beyond = std::max(std::abs(turn.row(0).dot(from)) - pose.length / 2 - pose.thickness, across);
    if (beyond < kBesideFrom || beyond > kBesideTo) continue;
    out.push_back(-turn.row(2).dot(from));
  }
  return out;
}

std::optional<double> ground_below(std::vector<double> depths) {
  if (depths.size() < kReturnsLeast) return std::nullopt;
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

double share_of_ground(const std::vector<double>& depths, const SizeRange& top_over_ground, std::size_t stride) {
  if (depths.size() * stride < kReturnsLeast) return 1.0;
  const auto ground = std::count_if(depths.begin(), depths.end(), [&](double below) { return below > top_over_ground[0] - kGroundSlack && below < top_over_ground[1] + 2 * kGroundSlack; });
  return static_cast<double>(ground) / static_cast<double>(depths.size());
}

bool lies_in_level_ground(const FanSweep& sweep, const BedPose& pose, int cab_end) {
  const Placing place(pose);
  int all = 0, level = 0, low = 0;
  for (std::size_t fan = 0; fan < sweep.heads.size(); ++fan) {
    const Eigen::Vector3d sensor = place.of(sweep.heads[fan]);
    for (const FanReturn& r : sweep.of(fan)) {
      const Eigen::Vector3d p = place.of(r.at());
      const double along = std::abs(p.x()) - pose.length / 2 - pose.thickness, across = std::abs(p.y()) - pose.width / 2 - pose.thickness, beyond = std::max(along, across);
      if (beyond < kFarFrom || beyond > kFarTo || (along > 0.0 && p.x() * cab_end > 0.0)) continue;
      const bool far = (along > kFarFrom && p.x() * sensor.x() < 0.0) || (across > kFarFrom && p.y() * sensor.y() < 0.0);
      if (!far) continue;
      ++all;
      level += std::abs(p.z()) < kAtTops ? 1 : 0;
      low += p.z() < -kLow ? 1 : 0;
    }
  }
  return level >= kLevelLeast && 2 * level > all && level > kLevelToLow * low;
}

}  // namespace berm::app
