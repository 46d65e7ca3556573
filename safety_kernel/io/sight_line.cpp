#include "io/sight_line.hpp"

#include <algorithm>

namespace berm::kernel {

SightLine::SightLine(const berm_parameters& p)
    : half_length_(p.own_body_radius_mm * 1e-3),
      half_width_(p.tail_half_width_mm * 1e-3),
      underside_(p.tail_low_mm * 1e-3),
      top_(p.tail_high_mm * 1e-3) {}

// Of the box about the axis, up to top: by the bounds of the part of the ray's beginning that is so low, which may be met where the ray is not.
bool SightLine::meets(const Eigen::Vector3d& head, const Eigen::Vector3d& direction, double top, double aside) const {
  const double from = std::max(0.0, (head.z() - top) / -direction.z());
  if (from >= kNearM) return false;
  const Eigen::Vector3d first = head + from * direction, last = head + kNearM * direction;
  const auto within = [](double a, double b, double half) { return std::min(a, b) < half && std::max(a, b) > -half; };
  return within(first.x(), last.x(), half_length_ + aside) && within(first.y(), last.y(), half_width_ + aside);
}

SightLine::Kind SightLine::of(const Eigen::Vector3d& head, const Eigen::Vector3d& direction) const {
  if (direction.z() > -kDownSine) return kOpen;
  const bool outwards = head.head<2>().dot(direction.head<2>()) >= 0.0;
  if (!outwards && meets(head, direction, top_, 0.0)) return kOpen;
  return (head.z() - underside_) / -direction.z() < kNearM ? kOverTracks : kExpected;
}

bool SightLine::over_tracks(const Eigen::Vector3d& head, const Eigen::Vector3d& direction, double swing_cosine, double swing_sine) const {
  const auto in_base = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(swing_cosine * v.x() - swing_sine * v.y(), swing_sine * v.x() + swing_cosine * v.y(), v.z());
  };
  return meets(in_base(head), in_base(direction), underside_, kSwungM);
}

}  // namespace berm::kernel
