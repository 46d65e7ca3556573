#include "plant/world/solids.hpp"

#include <limits>

namespace berm::plant {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

}  // namespace

PrismSolid::PrismSolid(const std::vector<SwingPlanePoint>& outline, double half_width) : low_{inf, -half_width, inf}, high_{-inf, half_width, -inf} {
  for (size_t i = 0; i < outline.size(); ++i) {
    const SwingPlanePoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double nx = b.z - a.z, nz = a.r - b.r;
    edge_.push_back({nx, nz, nx * a.r + nz * a.z});
    low_ = {std::min(low_.x, a.r), low_.y, std::min(low_.z, a.z)};
    high_ = {std::max(high_.x, a.r), high_.y, std::max(high_.z, a.z)};
  }
}

}  // namespace berm::plant
