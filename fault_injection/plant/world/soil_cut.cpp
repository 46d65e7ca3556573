#include "plant/world/soil_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berm::plant {
namespace {

constexpr double full_rate = 0.5;    // bank m3/s at which the resistance is fully felt
constexpr double rate_time = 0.10;   // s, smoothing of the rate
constexpr double least_factor = 0.35;
constexpr double stall_force = 120e3;  // N at the edge that stops a machine of the 20 t class
constexpr double edge_at_rest = 0.01;  // m/s
constexpr double push_near = 0.05, push_far = 0.45;  // where pushed soil lands ahead of the bucket, m
constexpr double inf = std::numeric_limits<double>::infinity();

double cross(const SwingPlanePoint& a, const SwingPlanePoint& b, const SwingPlanePoint& c) { return (b.r - a.r) * (c.z - a.z) - (b.z - a.z) * (c.r - a.r); }

// Lower hull of points, from the least r to the greatest.
void lower_hull(std::vector<SwingPlanePoint>& p, std::vector<SwingPlanePoint>& hull) {
  std::sort(p.begin(), p.end(), [](const SwingPlanePoint& a, const SwingPlanePoint& b) { return a.r < b.r || (a.r == b.r && a.z < b.z); });
  hull.clear();
  for (const SwingPlanePoint& q : p) {
    while (hull.size() >= 2 && cross(hull[hull.size() - 2], hull.back(), q) <= 0) hull.pop_back();
    if (hull.empty() || q.r > hull.back().r) hull.push_back(q);
  }
}

double lowest_at(const std::vector<SwingPlanePoint>& hull, double r) {
  if (hull.size() < 2 || r < hull.front().r || r > hull.back().r) return inf;
  size_t k = 1;
  while (k + 1 < hull.size() && hull[k].r < r) ++k;
  const double f = (r - hull[k - 1].r) / (hull[k].r - hull[k - 1].r);
  return hull[k - 1].z + f * (hull[k].z - hull[k - 1].z);
}

// The cells whose centres lie in r in [r_low, r_high], |lateral| <= half_width of the swing plane: calls visit(ix, iy, r, lateral).
template <class Visit>
void for_cells(const HeightGrid& g, const BucketPose& p, double r_low, double r_high, double half_width, Visit visit) {
  const double c = p.cos_swing, s = p.sin_swing;
  const double x1 = p.x + r_low * c, x2 = p.x + r_high * c, y1 = p.y + r_low * s, y2 = p.y + r_high * s, wx = half_width * std::abs(s), wy = half_width * std::abs(c);
  const int ix_low = g.index_x(std::min(x1, x2) - wx), ix_high = g.index_x(std::max(x1, x2) + wx);
  const int iy_low = g.index_y(std::min(y1, y2) - wy), iy_high = g.index_y(std::max(y1, y2) + wy);
  for (int iy = iy_low; iy <= iy_high; ++iy) {
    for (int ix = ix_low; ix <= ix_high; ++ix) {
      const double x = g.centre_x(ix) - p.x, y = g.centre_y(iy) - p.y, r = c * x + s * y, lateral = -s * x + c * y;
      if (r >= r_low && r <= r_high && std::abs(lateral) <= half_width) visit(ix, iy, r, lateral);
    }
  }
}

}  // namespace

SoilCut::SoilCut(const ImplementShape& shape, const SoilConfig& soil) : shape_(shape), resistance_(soil.resistance), swell_(soil.swell) {}

BucketPose SoilCut::pose(const LinkFrames& level, const BasePose& base) const {
  const LinkFrames links = standing(level, base);
  BucketPose p;
  p.x = base.x;
  p.y = base.y;
  p.swing = links.swing;
  p.cos_swing = std::cos(links.swing);
  p.sin_swing = std::sin(links.swing);
  p.frame = links.link[3];
  for (const SolidPart& part : shape_.parts) {
    if (part.link != 3) continue;
    for (const OutlinePoint& q : part.outline) p.outline.push_back(p.frame.out(q.x, q.z));
  }
  return p;
}

// Velocity of the cutting edge in (r, lateral, z) of the swing plane.
Vec3 SoilCut::motion(const BucketPose& before, const BucketPose& now, double dt) const {
  const SwingPlanePoint a = before.frame.out(shape_.bucket, 0), b = now.frame.out(shape_.bucket, 0);
  return {(b.r - a.r) / dt, b.r * (now.swing - before.swing) / dt, (b.z - a.z) / dt};
}

double SoilCut::cut(const BucketPose& before, const BucketPose& now, double dt, Terrain& terrain, BucketLoad& load, SoilBook& book) {
  corner_ = now.outline;
  corner_.insert(corner_.end(), before.outline.begin(), before.outline.end());
  lower_hull(corner_, hull_);
  if (hull_.size() < 2) return 0;
  const double lowest = std::min_element(hull_.begin(), hull_.end(), [](const SwingPlanePoint& a, const SwingPlanePoint& b) { return a.z < b.z; })->z;
  if (lowest > terrain.grid().highest()) return 0;
  double taken = 0;
  for_cells(terrain.grid(), now, hull_.front().r, hull_.back().r, shape_.bucket_half_width, [&](int ix, int iy, double r, double) {
    if (terrain.grid().at(ix, iy) > lowest) taken += terrain.cut(ix, iy, lowest_at(hull_, r));
  });
  if (taken <= 0) return 0;
  // It fills while the edge does not back away from the mouth's side and the soil is not met sideways.
  const Vec3 v = motion(before, now, dt);
  const double speed = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  const double into_mouth = v.x * now.frame.sin_angle - v.z * now.frame.cos_angle;  // along the mouth's outward normal
  const bool fills = into_mouth > -0.1 * speed && std::abs(v.y) < 0.7 * speed;
  const double excess = fills ? load.take(taken) : taken;
  book.dug += taken - excess;
  push(now, v, excess, terrain);
  return taken;
}

void SoilCut::push(const BucketPose& now, const Vec3& v, double volume, Terrain& terrain) const {
  if (volume <= 0) return;
  const HeightGrid& g = terrain.grid();
  const double half = shape_.bucket_half_width;
  std::vector<std::pair<int, int>> cell;
  double r_low = inf, r_high = -inf;
  for (const SwingPlanePoint& p : now.outline) {
    r_low = std::min(r_low, p.r);
    r_high = std::max(r_high, p.r);
  }
  if (std::abs(v.y) > std::abs(v.x) && std::abs(v.y) > 0.05) {
    // Swinging through soil heaps it up beside the bucket.
    const double side = v.y > 0 ? 1 : -1;
    for_cells(g, now, r_low, r_high, half + push_far, [&](int ix, int iy, double, double lateral) {
      if (side * lateral > half + push_near) cell.emplace_back(ix, iy);
    });
  } else {
    const double direction = std::abs(v.x) > 0.02 ? v.x : now.frame.sin_angle;
    const double from = direction < 0 ? r_low - push_far : r_high + push_near, to = direction < 0 ? r_low - push_near : r_high + push_far;
    for_cells(g, now, from, to, half, [&](int ix, int iy, double, double) { cell.emplace_back(ix, iy); });
  }
  if (cell.empty()) {  // off the map's rim
    const double r = std::max(0.0, r_low - push_near);
    cell.emplace_back(g.index_x(now.x + r * now.cos_swing), g.index_y(now.y + r * now.sin_swing));
  }
  for (const auto& [ix, iy] : cell) terrain.deposit(ix, iy, volume / static_cast<double>(cell.size()));
}

bool SoilCut::held_by_ground(const BucketPose& now, const Terrain& terrain) const {
  // Is the lip below the ground just before the mouth, somewhere over its width?
  const SwingPlanePoint lip = now.frame.out(shape_.bucket, 0);
  const double ahead = now.frame.sin_angle >= 0 ? 0.15 : -0.15;
  for (const double lateral : {-0.6 * shape_.bucket_half_width, 0.0, 0.6 * shape_.bucket_half_width}) {
    const double r = lip.r + ahead, x = now.x + r * now.cos_swing - lateral * now.sin_swing, y = now.y + r * now.sin_swing + lateral * now.cos_swing;
    if (terrain.grid().contains(x, y) && terrain.height(terrain.grid().index_x(x), terrain.grid().index_y(y)) > lip.z + 0.02) return true;
  }
  return false;
}

void SoilCut::empty(const BucketPose& now, double dt, const Terrain& terrain, BucketLoad& load, Landing& landing, SoilBook& book) const {
  const double out = load.release(BucketLoad::mouth_tilt(now.frame), dt, held_by_ground(now, terrain));
  if (out <= 0) return;
  // Over the lower edge of the mouth: the lip, or the back when curled too far.
  const SwingPlanePoint lip = now.frame.out(shape_.bucket, 0), back = now.frame.out(0.1, 0);
  const SwingPlanePoint edge = lip.z <= back.z ? lip : back;
  const double spread = now.frame.sin_angle >= 0 ? 0.1 : -0.1;  // the stream is not thin: it leaves up to this far before the edge
  constexpr int across = 12, along = 3;
  for (int i = 0; i < across; ++i) {
    for (int k = 0; k < along; ++k) {
      const double lateral = shape_.bucket_half_width * ((2 * i + 1.0) / across - 1.0), r = edge.r + spread * k;
      landing.drop(now.x + r * now.cos_swing - lateral * now.sin_swing, now.y + r * now.sin_swing + lateral * now.cos_swing, out / (across * along), book);
    }
  }
}

EdgeForce SoilCut::edge_force(const BucketPose& before, const BucketPose& now, double dt, double speed_factor) const {
  const Vec3 v = motion(before, now, dt);
  const double speed = std::max(edge_at_rest, std::hypot(v.x, v.z)), force = (1.0 - speed_factor) * stall_force;
  return {-force * v.x / speed, -force * v.z / speed};
}

double SoilCut::speed_factor(double cut_volume, double dt) {
  const double rate = cut_volume / swell_ / dt;
  cut_rate_ += (rate - cut_rate_) * (1 - std::exp(-dt / rate_time));
  return std::max(least_factor, 1 - resistance_ * std::min(1.3, cut_rate_ / full_rate));
}

}  // namespace berm::plant
