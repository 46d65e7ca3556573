#include "validate/seen_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace berm::validate {

namespace {

constexpr double micro = 1e-6, never = 1e9;
constexpr double step = 0.05;  // m along a beam: a voxel that it only grazes may be left out

}  // namespace

SeenSpace::SeenSpace(const plant::ImplementShape& shape)
    : mount_{shape.scanner[0], shape.scanner[1]}, first_s_(static_cast<std::size_t>(across) * across * high, never) {}

void SeenSpace::mark(const std::array<double, 3>& from, const std::array<double, 3>& direction, double range, double t) {
  for (double r = 0.0; r < range; r += step) {
    const auto index = [&](std::size_t axis) { return static_cast<int>(std::floor((from[axis] + r * direction[axis]) / side)); };
    const int ix = index(0) + across / 2, iy = index(1) + across / 2, iz = index(2);
    if (ix < 0 || ix >= across || iy < 0 || iy >= across) return;
    if (iz < 0 || iz >= high) continue;
    double& first = first_s_[static_cast<std::size_t>((iy * across + ix) * high + iz)];
    first = std::min(first, t);
  }
}

void SeenSpace::take(const berm_scan_packet& packet, double t, const plant::JointState& joints) {
  const auto& head = mount_[packet.scanner].position;
  const double period = packet.sample_period_ns * 1e-9, turn = 2.0 * std::numbers::pi / packet.samples_per_revolution;
  for (int i = 0; i < packet.count; ++i) {
    double range = 0.0;  // the farthest echo
    for (int e = 0; e < packet.echoes_per_sample; ++e)
      if (packet.range[i][e] != 0) range = packet.range[i][e] * BERM_SCAN_RANGE_LSB_MM * 1e-3;
    if (range == 0.0) continue;
    const double share = packet.count > 1 ? static_cast<double>(i) / (packet.count - 1) : 0.0;
    const double pan = (packet.pan_start_urad + share * (packet.pan_end_urad - packet.pan_start_urad)) * micro;
    const double swing = joints.angle[0] - joints.velocity[0] * period * (packet.count - 1 - i);
    const double elevation = turn * (packet.first_index + i), c = std::cos(swing), s = std::sin(swing);
    mark({head[0] * c - head[1] * s, head[0] * s + head[1] * c, head[2]},
         {std::cos(elevation) * std::cos(pan + swing), std::cos(elevation) * std::sin(pan + swing), std::sin(elevation)}, range, t);
  }
}

std::vector<SeenSpace::Hidden> SeenSpace::hidden_against(const SeenSpace& without, double t) const {
  std::vector<Hidden> hidden;
  for (int iy = 1; iy + 1 < across; ++iy) {
    for (int ix = 1; ix + 1 < across; ++ix) {
      int top = -1;
      for (int iz = 0; iz < high; ++iz) {
        const bool beside = seen(ix - 1, iy, iz, t) || seen(ix + 1, iy, iz, t) || seen(ix, iy - 1, iz, t) || seen(ix, iy + 1, iz, t);
        if (!seen(ix, iy, iz, t) && !beside && without.seen(ix, iy, iz, t)) top = iz;
      }
      if (top >= 0) hidden.push_back({(ix - across / 2 + 0.5) * side, (iy - across / 2 + 0.5) * side, (top + 1) * side});
    }
  }
  return hidden;
}

}  // namespace berm::validate
