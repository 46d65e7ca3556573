// Random points of the upper body's tail, and of what must be free round it, at random swing angles.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "config/parameter_block.h"
#include "core/reach_box.h"

namespace berm::test {

struct TailPoint {
  double swing, x, y, z;  // rad; base frame, mm
};

// The tail by the words of CONFIG.md: behind the swing axis, within half width and radius, from underside to top; grown: moved to the sides by up to the clearance, or
// as far behind as the clearance beyond the own body. Half the draws sit on the borders, where coverage fails first.
inline TailPoint draw_tail_point(const berm_parameters& p, const sk_reach_box& box, std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto extreme = [&](double low, double high) {
    const auto kind = random() % 4;
    return kind == 0 ? low : kind == 1 ? high : uniform(low, high);
  };
  const bool grown = random() % 2 == 0;
  const double clearance = p.tail_clearance_mm;
  const double radius = grown ? std::max(p.tail_radius_mm, p.own_body_radius_mm) + clearance : p.tail_radius_mm;
  const double side = std::min(p.tail_half_width_mm + (grown ? clearance : 0.0), radius);
  const double y = extreme(-side, side), back = std::sqrt(radius * radius - y * y);
  const double x = -extreme(0.0, back);
  TailPoint out{};
  out.swing = extreme(box.low_urad[0] * 1e-6, box.high_urad[0] * 1e-6);
  out.x = x * std::cos(out.swing) - y * std::sin(out.swing);
  out.y = x * std::sin(out.swing) + y * std::cos(out.swing);
  out.z = extreme(p.tail_low_mm, p.tail_high_mm);
  return out;
}

}  // namespace berm::test
