#include "plant/oracle/ground_gap.hpp"

#include <algorithm>
#include <cmath>

namespace berm::plant::oracle {
namespace {

using Corner = Eigen::Vector2d;

constexpr double rounding = 1e-9;  // m: more than that of the heights along an edge

// The part's lower boundary as a convex chain from the least r to the greatest.
std::vector<Corner> lower_chain(std::vector<Corner> p) {
  std::sort(p.begin(), p.end(), [](const Corner& a, const Corner& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Corner> chain;
  for (const Corner& q : p) {
    while (chain.size() >= 2) {
      const Corner u = chain.back() - chain[chain.size() - 2], v = q - chain.back();
      if (u.x() * v.y() - u.y() * v.x() > 0) break;
      chain.pop_back();
    }
    if (chain.empty() || q.x() > chain.back().x()) chain.push_back(q);
  }
  return chain;
}

double chain_at(const std::vector<Corner>& chain, double r) {
  size_t k = 1;
  while (k + 1 < chain.size() && chain[k].x() < r) ++k;
  const double f = (r - chain[k - 1].x()) / (chain[k].x() - chain[k - 1].x());
  return chain[k - 1].y() + f * (chain[k].y() - chain[k - 1].y());
}

// Least z of the chain for r in [low, high]; the interval meets the chain's.
double lowest_within(const std::vector<Corner>& chain, double low, double high) {
  const double a = std::max(low, chain.front().x()), b = std::min(high, chain.back().x());
  double z = std::min(chain_at(chain, a), chain_at(chain, b));
  for (const Corner& c : chain) {
    if (c.x() > a && c.x() < b) z = std::min(z, c.y());
  }
  return z;
}

bool wholly_inside(const std::vector<Zone>& zones, double x, double y, double half) {
  return std::any_of(zones.begin(), zones.end(), [&](const Zone& z) {
    return x - half >= z.x_low - 1e-9 && x + half <= z.x_high + 1e-9 && y - half >= z.y_low - 1e-9 && y + half <= z.y_high + 1e-9;
  });
}

}  // namespace

double gap_outside_zones(const Upright& upright, const Ground& g, const std::vector<Zone>& zones, double gap) {
  const Profile& part = upright.part;
  const std::vector<Corner> chain = lower_chain(part.corner);
  if (chain.size() < 2 || g.height == nullptr) return gap;
  const double c = std::cos(upright.bearing), s = std::sin(upright.bearing), half = g.cell / 2;
  // Half the sides of the bounding rectangle of a cell's square, along r and across.
  const double spread = half * (std::abs(c) + std::abs(s)), side = part.half_width + spread;
  const double r_low = chain.front().x() - spread, r_high = chain.back().x() + spread;
  const auto range = [&](double from, double to, double low, int count) {
    return std::pair{std::clamp(static_cast<int>(std::floor((from - low) / g.cell)), 0, count - 1), std::clamp(static_cast<int>(std::floor((to - low) / g.cell)), 0, count - 1)};
  };
  const auto [ix_low, ix_high] = range(upright.x + std::min(r_low * c, r_high * c) - side * std::abs(s), upright.x + std::max(r_low * c, r_high * c) + side * std::abs(s), g.x_low, g.count_x);
  const auto [iy_low, iy_high] = range(upright.y + std::min(r_low * s, r_high * s) - side * std::abs(c), upright.y + std::max(r_low * s, r_high * s) + side * std::abs(c), g.y_low, g.count_y);
  double lowest = chain.front().y();
  for (const Corner& q : chain) lowest = std::min(lowest, q.y());
  for (int iy = iy_low; iy <= iy_high; ++iy) {
    const double y = g.y_low + (iy + 0.5) * g.cell;
    const double* row = g.height + static_cast<ptrdiff_t>(iy) * g.count_x;
    for (int ix = ix_low; ix <= ix_high; ++ix) {
      if (lowest - row[ix] > gap + rounding) continue;  // whatever is over the cell
      const double x = g.x_low + (ix + 0.5) * g.cell;
      if (std::abs(c * (y - upright.y) - s * (x - upright.x)) > side) continue;
      const double r = c * (x - upright.x) + s * (y - upright.y);
      if (r < r_low || r > r_high) continue;
      const double here = lowest_within(chain, r - spread, r + spread) - row[ix];
      if (here < gap && !wholly_inside(zones, x, y, half)) gap = here;
    }
  }
  return gap;
}

double gap_over_floor(const Upright& upright, const std::vector<Zone>& zones) {
  const Profile& part = upright.part;
  const double c = std::cos(upright.bearing), s = std::sin(upright.bearing);
  double gap = 1e9;
  for (const Corner& q : part.corner) {
    for (const double across : {-part.half_width, part.half_width}) {
      const double x = upright.x + q.x() * c - across * s, y = upright.y + q.x() * s + across * c;
      for (const Zone& z : zones) {
        if (x >= z.x_low && x <= z.x_high && y >= z.y_low && y <= z.y_high) gap = std::min(gap, q.y() - z.floor);
      }
    }
  }
  return gap;
}

}  // namespace berm::plant::oracle
