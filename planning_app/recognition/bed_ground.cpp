#include "recognition/bed_ground.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kGroundSlack = 0.15;  // m: ruts
constexpr int kReturnsLeast = 25;

}  // namespace

double share_of_ground(const FanSweep& sweep, const BedPose& pose, const SizeRange& top_over_ground, std::size_t stride) {
  const Eigen::Matrix3d turn = pose.rotation().transpose();
  int all = 0, ground = 0;
  for (std::size_t k = 0; k < sweep.returns.size(); k += stride) {
    const Eigen::Vector3d p = turn * (sweep.returns[k].at - pose.middle);
    const double beyond = std::max(std::abs(p.x()) - pose.length / 2, std::abs(p.y()) - pose.width / 2) - pose.thickness;
    if (beyond < 0.2 || beyond > 2.5) continue;
    ++all;
    ground += -p.z() > top_over_ground[0] - kGroundSlack && -p.z() < top_over_ground[1] + 2 * kGroundSlack ? 1 : 0;
  }
  return all * static_cast<int>(stride) < kReturnsLeast ? 1.0 : static_cast<double>(ground) / all;
}

}  // namespace berm::app
