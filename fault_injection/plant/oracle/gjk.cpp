#include "plant/oracle/gjk.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace berm::plant::oracle {
namespace {

constexpr double gap_wanted = 1e-7;
constexpr int rounds_max = 96;

struct Simplex {
  std::array<Point, 4> p;
  int n = 0;
};

// Nearest point to the origin of the affine hull of a subset, if it lies within the subset. Degenerate subsets give nothing: a
// smaller one of theirs holds the same point.
bool nearest_inside(const Simplex& s, Point& v) {
  if (s.n == 1) {
    v = s.p[0];
    return true;
  }
  if (s.n == 2) {
    const Point e = s.p[1] - s.p[0];
    const double length2 = e.squaredNorm(), t = -s.p[0].dot(e);
    if (length2 <= 0 || t < 0 || t > length2) return false;
    v = s.p[0] + (t / length2) * e;
    return true;
  }
  if (s.n == 3) {
    const Point n = (s.p[1] - s.p[0]).cross(s.p[2] - s.p[0]);
    const double n2 = n.squaredNorm();
    if (n2 < 1e-24) return false;
    // Areas of the triangles that the projected origin makes with each edge.
    for (int i = 0; i < 3; ++i) {
      const Point &a = s.p[static_cast<size_t>(i)], &b = s.p[static_cast<size_t>((i + 1) % 3)];
      if (n.dot(a.cross(b)) < 0) return false;
    }
    v = (s.p[0].dot(n) / n2) * n;
    return true;
  }
  // Four points: the origin lies inside when it is on the inner side of every face.
  for (size_t i = 0; i < 4; ++i) {
    const Point &a = s.p[(i + 1) % 4], &b = s.p[(i + 2) % 4], &c = s.p[(i + 3) % 4];
    const Point n = (b - a).cross(c - a);
    const double other = n.dot(s.p[i] - a), origin = -n.dot(a);
    if (std::abs(other) < 1e-15 || other * origin < 0) return false;
  }
  v = Point::Zero();
  return true;
}

// Reduces the simplex to the part that holds its nearest point, which always involves the newest corner (the last).
Point reduce(Simplex& s) {
  Simplex best;
  Point nearest = s.p[static_cast<size_t>(s.n - 1)];
  double least = std::numeric_limits<double>::infinity();
  const int others = s.n - 1;
  for (int mask = 0; mask < (1 << others); ++mask) {
    Simplex part;
    for (int i = 0; i < others; ++i) {
      if (mask & (1 << i)) part.p[static_cast<size_t>(part.n++)] = s.p[static_cast<size_t>(i)];
    }
    part.p[static_cast<size_t>(part.n++)] = s.p[static_cast<size_t>(others)];
    Point v;
    if (!nearest_inside(part, v)) continue;
    const double d = v.squaredNorm();
    if (d < least) {
      least = d;
      nearest = v;
      best = part;
    }
  }
  s = best;
  return nearest;
}

}  // namespace

Body Body::polytope(std::vector<Point> corners) {
  Body b;
  b.corner = std::move(corners);
  Point low = b.corner[0], high = b.corner[0];
  for (const Point& p : b.corner) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  b.middle = 0.5 * (low + high);
  for (const Point& p : b.corner) b.reach = std::max(b.reach, (p - b.middle).norm());
  return b;
}

Body Body::cylinder(const Point& foot, double radius, double height) {
  Body b;
  b.foot = foot;
  b.radius = radius;
  b.height = height;
  b.middle = foot + Point(0, 0, height / 2);
  b.reach = std::hypot(radius, height / 2);
  return b;
}

Point Body::support(const Point& d) const {
  if (corner.empty()) {
    const double flat = std::hypot(d.x(), d.y());
    const double s = flat > 0 ? radius / flat : 0.0;
    return {foot.x() + s * d.x(), foot.y() + s * d.y(), foot.z() + (d.z() > 0 ? height : 0.0)};
  }
  size_t best = 0;
  double most = d.dot(corner[0]);
  for (size_t i = 1; i < corner.size(); ++i) {
    const double here = d.dot(corner[i]);
    if (here > most) {
      most = here;
      best = i;
    }
  }
  return corner[best];
}

Distance distance(const Body& a, const Body& b) {
  const Point towards = b.middle - a.middle;
  Point v = a.support(towards) - b.support(-towards);
  Distance found{0, v.norm()};
  if (found.upper < 1e-9) return {};
  Simplex s;
  s.p[0] = v;
  s.n = 1;
  for (int round = 0; round < rounds_max; ++round) {
    const Point w = a.support(-v) - b.support(v);
    const double length = v.norm();
    found.lower = std::max(found.lower, v.dot(w) / length);
    if (found.upper - found.lower <= gap_wanted) break;
    if (std::any_of(s.p.begin(), s.p.begin() + s.n, [&](const Point& p) { return p == w; })) break;
    s.p[static_cast<size_t>(s.n++)] = w;
    v = reduce(s);
    const double now = v.norm();
    if (now < 1e-9) return {};
    if (now >= found.upper) break;  // rounding: no further
    found.upper = now;
  }
  return found;
}

}  // namespace berm::plant::oracle
