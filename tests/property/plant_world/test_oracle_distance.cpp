// The oracle's distance against other ways to find it: all pairs of edges and of corners with faces for polytopes, alternating
// projections for cylinders, and points drawn inside both bodies.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "bench.hpp"
#include "plant/oracle/oracle.hpp"

namespace berm::plant::oracle {
namespace {

using Random = std::mt19937_64;
double draw(Random& r, double low, double high) { return low + (high - low) * static_cast<double>(r() >> 11) * 0x1.0p-53; }

using Face = std::vector<Point>;  // a convex polygon in space, in order

// A prism from a polygon's corners, by its faces.
struct Solid {
  Body body;
  std::vector<Face> face;
  std::vector<std::pair<Point, Point>> edge;
};

Solid prism(const std::vector<Eigen::Vector2d>& outline, double half_width, const Eigen::Matrix3d& turn, const Point& shift) {
  Solid s;
  Face left, right;
  for (const auto& q : outline) {
    left.push_back(turn * Point(q.x(), half_width, q.y()) + shift);
    right.push_back(turn * Point(q.x(), -half_width, q.y()) + shift);
  }
  const size_t n = outline.size();
  for (size_t i = 0; i < n; ++i) {
    const size_t k = (i + 1) % n;
    s.face.push_back({left[i], left[k], right[k], right[i]});
    s.edge.insert(s.edge.end(), {{left[i], left[k]}, {right[i], right[k]}, {left[i], right[i]}});
  }
  s.face.push_back(left);
  s.face.push_back(right);
  std::vector<Point> all = left;
  all.insert(all.end(), right.begin(), right.end());
  s.body = Body::polytope(all);
  return s;
}

Solid random_solid(Random& r, const Point& near) {
  // Corners on an ellipse, in order, are convex.
  std::vector<double> angle(3 + r() % 6);
  for (double& a : angle) a = draw(r, 0, 6.28);
  std::sort(angle.begin(), angle.end());
  const double a = draw(r, 0.1, 2), b = draw(r, 0.1, 2);
  std::vector<Eigen::Vector2d> outline;
  for (const double p : angle) outline.emplace_back(a * std::cos(p), b * std::sin(p));
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(draw(r, -3, 3), Point::UnitZ()) * Eigen::AngleAxisd(r() % 4 == 0 ? 0 : draw(r, -3, 3), Point::UnitX())).toRotationMatrix();
  return prism(outline, draw(r, 0.05, 1), turn, near + Point(draw(r, -2, 2), draw(r, -2, 2), draw(r, -2, 2)));
}

double segments(const Point& p1, const Point& q1, const Point& p2, const Point& q2) {
  // Least of the squared distance over the unit square: inner stationary point, or on one of its sides.
  const Point d1 = q1 - p1, d2 = q2 - p2, w = p1 - p2;
  const auto at = [&](double s, double t) { return (w + s * d1 - t * d2).norm(); };
  const auto best_t = [&](double s) { return std::clamp((w + s * d1).dot(d2) / d2.squaredNorm(), 0.0, 1.0); };
  const auto best_s = [&](double t) { return std::clamp((t * d2 - w).dot(d1) / d1.squaredNorm(), 0.0, 1.0); };
  double least = std::min({at(0, best_t(0)), at(1, best_t(1)), at(best_s(0), 0), at(best_s(1), 1)});
  const double a = d1.squaredNorm(), b = d1.dot(d2), c = d2.squaredNorm(), det = a * c - b * b;
  if (det > 1e-12 * a * c) {
    const double s = (b * w.dot(d2) - c * w.dot(d1)) / det, t = (a * w.dot(d2) - b * w.dot(d1)) / det;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) least = std::min(least, at(s, t));
  }
  return least;
}

// Distance to a face if the point projects into it; a large number otherwise (then an edge is nearer).
double to_face(const Point& p, const Face& f) {
  const Point n = (f[1] - f[0]).cross(f[2] - f[0]).normalized();
  if (!n.allFinite()) return 1e9;
  double sign = 0;
  for (size_t i = 0; i < f.size(); ++i) {
    const double side = (f[(i + 1) % f.size()] - f[i]).cross(p - f[i]).dot(n);
    if (sign * side < 0) return 1e9;
    if (side != 0) sign = side;
  }
  return std::abs((p - f[0]).dot(n));
}

// Of bodies that do not meet.
double brute_distance(const Solid& a, const Solid& b) {
  double least = 1e9;
  for (const auto& [p, q] : a.edge) {
    for (const auto& [u, v] : b.edge) least = std::min(least, segments(p, q, u, v));
  }
  for (const Point& p : a.body.corner) {
    for (const Face& f : b.face) least = std::min(least, to_face(p, f));
  }
  for (const Point& p : b.body.corner) {
    for (const Face& f : a.face) least = std::min(least, to_face(p, f));
  }
  return least;
}

bool contains(const Solid& s, const Point& p) {
  Point inner = Point::Zero();
  for (const Point& c : s.body.corner) inner += c / static_cast<double>(s.body.corner.size());
  return std::all_of(s.face.begin(), s.face.end(), [&](const Face& f) {
    const Point n = (f[1] - f[0]).cross(f[2] - f[0]);
    return n.dot(p - f[0]) * n.dot(inner - f[0]) >= 0;
  });
}

// Do an edge of one and a face of the other cross, or does one hold the other?
bool brute_meet(const Solid& a, const Solid& b) {
  const auto crosses = [](const Solid& x, const Solid& y) {
    if (contains(y, x.body.corner[0])) return true;
    for (const auto& [p, q] : x.edge) {
      for (const Face& f : y.face) {
        const Point n = (f[1] - f[0]).cross(f[2] - f[0]);
        const double u = n.dot(p - f[0]), v = n.dot(q - f[0]);
        if (u * v >= 0) continue;
        if (to_face(p + u / (u - v) * (q - p), f) < 1e8) return true;
      }
    }
    return false;
  };
  return crosses(a, b) || crosses(b, a);
}

bool degenerate(const Solid& s) {
  // Slivers whose faces have no area to speak of say nothing about the oracle.
  return std::any_of(s.face.begin(), s.face.end(), [](const Face& f) { return (f[1] - f[0]).cross(f[2] - f[0]).norm() < 1e-6; });
}

TEST(OracleDistance, AgreesWithAllPairsOfEdgesAndFaces) {
  Random r(20240611);
  int apart = 0, meeting = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    SCOPED_TRACE(trial);
    const Solid a = random_solid(r, Point(0, 0, 0)), b = random_solid(r, Point(draw(r, -2, 2), draw(r, -2, 2), 0));
    if (degenerate(a) || degenerate(b)) continue;
    const Distance d = distance(a.body, b.body);
    ASSERT_LE(d.lower, d.upper + 1e-9);
    const bool meet = brute_meet(a, b);
    const double expected = meet ? 0.0 : brute_distance(a, b);
    if (expected < 1e-6) {
      ASSERT_LE(d.upper, 1e-5);
      ++meeting;
    } else {
      ASSERT_NEAR(d.upper, expected, 1e-6);
      ASSERT_NEAR(d.lower, expected, 1e-6);
      ++apart;
    }
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(meeting, 300);
}

Point project(const Body& cylinder, const Point& p) {
  Point q = p;
  const double dx = p.x() - cylinder.foot.x(), dy = p.y() - cylinder.foot.y(), d = std::hypot(dx, dy);
  if (d > cylinder.radius) {
    q.x() = cylinder.foot.x() + cylinder.radius / d * dx;
    q.y() = cylinder.foot.y() + cylinder.radius / d * dy;
  }
  q.z() = std::clamp(p.z(), cylinder.foot.z(), cylinder.foot.z() + cylinder.height);
  return q;
}

Point project(const Solid& s, const Point& p) {
  if (contains(s, p)) return p;
  double least = 1e18;
  Point best = p;
  const auto offer = [&](const Point& q) {
    if ((p - q).squaredNorm() < least) {
      least = (p - q).squaredNorm();
      best = q;
    }
  };
  for (const auto& [u, v] : s.edge) offer(u + std::clamp((p - u).dot(v - u) / (v - u).squaredNorm(), 0.0, 1.0) * (v - u));
  for (const Face& f : s.face) {
    const Point n = (f[1] - f[0]).cross(f[2] - f[0]).normalized(), q = p - (p - f[0]).dot(n) * n;
    if (to_face(q, f) < 1e8) offer(q);
  }
  return best;
}

TEST(OracleDistance, PersonAgainstPrismByAlternatingProjections) {
  Random r(777);
  int apart = 0, meeting = 0;
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE(trial);
    const Solid a = random_solid(r, Point(0, 0, 0));
    if (degenerate(a)) continue;
    const Body person = Body::cylinder({draw(r, -3, 3), draw(r, -3, 3), draw(r, -2, 1)}, draw(r, 0.1, 0.5), draw(r, 0.5, 2));
    Point p = person.middle, q = p;
    for (int i = 0; i < 3000; ++i) {
      q = project(a, p);
      const Point next = project(person, q);
      if ((next - p).norm() < 1e-12) break;
      p = next;
    }
    const double expected = (p - q).norm();  // from above
    const Distance d = distance(a.body, person);
    ASSERT_LE(d.lower, expected + 1e-9);
    ASSERT_LE(d.upper - d.lower, 1e-5);
    ASSERT_NEAR(d.upper, expected, 3e-3);
    (expected > 3e-3 ? apart : meeting)++;
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(meeting, 30);
}

// Nothing that points drawn inside the bodies show is ever missed.
TEST(OracleDistance, DrawnPointsOfTheMachineAndAPersonAreNeverNearer) {
  const ImplementShape shape = bench::machine();
  const Oracle oracle(shape);
  Random r(99);
  int contacts = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    const std::array<double, 4> q = {draw(r, -3, 3), draw(r, -0.8, 1.1), draw(r, -2.4, -0.8), draw(r, -2.3, 0.6)};
    const double a = draw(r, -3.1, 3.1), reach = draw(r, 2, 9);
    Site site;
    site.people = {{"person", reach * std::cos(q[0] + 0.1 * a), reach * std::sin(q[0] + 0.1 * a), draw(r, -2.2, 0), 0.25, 1.8}};
    const Judgement j = oracle.judge(q, site);
    const Body person = Body::cylinder({site.people[0].x, site.people[0].y, site.people[0].z}, 0.25, 1.8);
    double least = 1e9;
    for (const Body& part : oracle.machine(q)) {
      for (int i = 0; i < 400; ++i) {
        Point p = Point::Zero();
        double sum = 0;
        for (const Point& corner : part.corner) {
          const double w = -std::log(draw(r, 1e-9, 1));
          p += w * corner;
          sum += w;
        }
        p /= sum;
        least = std::min(least, (p - project(person, p)).norm());
      }
    }
    ASSERT_GE(least, j.closest - 1e-9);
    if (j.contact) ++contacts;
    else ASSERT_LT(least, j.closest + 1.6) << "the drawn points come near the nearest one";
  }
  EXPECT_GT(contacts, 20);
}

}  // namespace
}  // namespace berm::plant::oracle
