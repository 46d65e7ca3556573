#include "io/dig_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berm::kernel {

namespace {

constexpr int kBucket = 3;
constexpr double kHalfCellM = 0.0005 * SK_CELL_MM;

// The bucket in the swing plane, m.
struct Outline {
  double r_low = std::numeric_limits<double>::infinity(), r_high = -std::numeric_limits<double>::infinity(), lowest = r_low, half_width = 0.0;
};

Outline bucket_of(const berm_parameters& parameters, const ImplementPose& pose) {
  Outline o;
  for (int i = 0; i < std::clamp<int>(parameters.parts, 0, BERM_PARTS); ++i) {
    const berm_part& part = parameters.part[i];
    if (part.link != kBucket) continue;
    o.half_width = std::max(o.half_width, part.half_width_mm * 1e-3);
    for (int v = 0; v < std::clamp<int>(part.vertices, 0, BERM_PART_VERTICES); ++v) {
      const Eigen::Vector2d at = pose.link[kBucket - 1].to_plane({part.vertex_mm[v][0] * 1e-3, part.vertex_mm[v][1] * 1e-3});
      o.r_low = std::min(o.r_low, at.x());
      o.r_high = std::max(o.r_high, at.x());
      o.lowest = std::min(o.lowest, at.y());
    }
  }
  return o;
}

}  // namespace

DigWatch::DigWatch(const berm_parameters& parameters) : parameters_(parameters), kinematics_(parameters) {
  const auto middle_m = [](std::int32_t i) { return (SK_MAP_ORIGIN_MM + SK_CELL_MM * i + SK_CELL_MM / 2) * 1e-3; };
  for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) {
      double ceiling_m = -std::numeric_limits<double>::infinity();
      for (int k = 0; k < std::clamp<int>(parameters.dig_zones, 0, BERM_DIG_ZONES); ++k) {
        const berm_dig_zone& zone = parameters.dig_zone[k];
        const bool touched = sk_is_touched(iy, ix, zone.x_low_mm, zone.y_low_mm, zone.x_high_mm, zone.y_high_mm);
        if (touched) ceiling_m = std::max(ceiling_m, zone.ceiling_mm * 1e-3);
      }
      if (std::isfinite(ceiling_m)) cells_.push_back({{iy, ix}, middle_m(ix), middle_m(iy), ceiling_m, false, false, -1});
    }
}

void DigWatch::step(const JointAngles& joints, bool stands, bool held, std::int64_t now_us) {
  const Outline bucket = bucket_of(parameters_, kinematics_.implements(joints));
  const double c = std::cos(joints.swing), s = std::sin(joints.swing), cell_m = kHalfCellM * std::sqrt(2.0);
  for (Cell& cell : cells_) {
    const double r = c * cell.x_m + s * cell.y_m, aside = std::fabs(c * cell.y_m - s * cell.x_m);
    const bool near = !stands && bucket.lowest < cell.ceiling_m && r > bucket.r_low - kBehindM - cell_m && r < bucket.r_high + kBeyondM + cell_m &&
                      aside < bucket.half_width + kBesideM + cell_m;
    if (near) cell.stirred_us = now_us;
    cell.was_stirred = cell.stirred;
    cell.stirred = near || (cell.stirred_us >= 0 && !held && now_us - cell.stirred_us < kLearnsOnUs);
    if (!cell.stirred) cell.stirred_us = -1;
  }
}

}  // namespace berm::kernel
