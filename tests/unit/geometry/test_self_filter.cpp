#include "geometry/self_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "machine_profile.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint64_t seed = 31;

JointAngles random_pose(const berm_parameters& p, std::mt19937_64& random) {
  int32_t urad[4];
  for (int j = 0; j < 4; ++j) urad[j] = static_cast<int32_t>(uniform(random, p.joint_low_urad[j], p.joint_high_urad[j]));
  return joint_angles(urad);
}

// A point of the surface of a part's prism (outline, or side), in the link's frame, and how far to leave it along the outward normal.
Eigen::Vector3d surface_point(const berm_part& part, std::mt19937_64& random, double outward) {
  const uint64_t edge = random() % static_cast<uint64_t>(part.vertices);
  const int32_t *a = part.vertex_mm[edge], *b = part.vertex_mm[(edge + 1) % static_cast<uint64_t>(part.vertices)];
  const double t = uniform(random, 0, 1), w = part.half_width_mm * 1e-3;
  const Eigen::Vector2d from(a[0] * 1e-3, a[1] * 1e-3), to(b[0] * 1e-3, b[1] * 1e-3);
  const Eigen::Vector2d along = (to - from).normalized(), out(along.y(), -along.x()); // counter-clockwise: outside lies to the right
  Eigen::Vector2d p = from + t * (to - from);
  if (random() % 3 == 0) { // a point of the side, off to the side
    const int32_t* c = part.vertex_mm[random() % static_cast<uint64_t>(part.vertices)];
    p = p + uniform(random, 0, 1) * (Eigen::Vector2d(c[0] * 1e-3, c[1] * 1e-3) - p);
    return {p.x(), (random() % 2 == 0 ? 1.0 : -1.0) * (w + outward), p.y()};
  }
  p += outward * out;
  return {p.x(), uniform(random, -w, w), p.y()};
}

// Distance of a point to the nearest part, from points spread over each outline (an upper bound, good to the spacing).
double sampled_distance(const berm_parameters& p, const Kinematics& k, JointAngles q, const Eigen::Vector3d& point) {
  q.swing = 0.0;
  double least = 1e9;
  for (int i = 0; i < p.parts; ++i) {
    const berm_part& part = p.part[i];
    const Eigen::Vector3d v = k.link_in_base(q, part.link).inverse() * point;
    const double to_side = std::max(0.0, std::fabs(v.y()) - part.half_width_mm * 1e-3);
    bool inside = true;
    double in_plane = 1e9;
    for (int a = 0; a < part.vertices; ++a) {
      const int b = (a + 1) % part.vertices;
      const Eigen::Vector2d from(part.vertex_mm[a][0] * 1e-3, part.vertex_mm[a][1] * 1e-3), to(part.vertex_mm[b][0] * 1e-3, part.vertex_mm[b][1] * 1e-3);
      inside = inside && (to.x() - from.x()) * (v.z() - from.y()) - (to.y() - from.y()) * (v.x() - from.x()) >= 0;
      for (int s = 0; s <= 400; ++s) in_plane = std::min(in_plane, (from + s / 400.0 * (to - from) - Eigen::Vector2d(v.x(), v.z())).norm());
    }
    least = std::min(least, std::max(inside ? 0.0 : in_plane, to_side)); // outline and side are judged apart: the margin is a box to the sides
  }
  return least;
}

} // namespace

// verifies: SK-GE-17
TEST(SelfFilter, KnowsTheImplementsAndWhatIsWithinTheMargin) {
  std::mt19937_64 random(seed);
  for (const Machine& machine : machine_profiles()) {
    const berm_parameters& p = machine.parameters;
    const SelfFilter filter(p);
    const Kinematics k(p);
    const double margin = p.self_margin_mm * 1e-3;
    for (int i = 0; i < 20000; ++i) {
      JointAngles q = random_pose(p, random);
      const berm_part& part = p.part[random() % static_cast<uint64_t>(p.parts)];
      const double outward = i % 2 == 0 ? 0.0 : uniform(random, 0, margin - 1e-9);
      const Eigen::Vector3d in_link = surface_point(part, random, outward);
      JointAngles level = q;
      level.swing = 0.0; // the upper body's frame turns with the swing
      ASSERT_TRUE(filter.is_own(k.link_in_base(level, part.link) * in_link, q)) << "seed " << seed << " case " << i;
    }
  }
}

// verifies: SK-GE-18
TEST(SelfFilter, LeavesWhatIsFartherAwayThanTheMargin) {
  std::mt19937_64 random(seed + 1);
  for (const Machine& machine : machine_profiles()) {
    const berm_parameters& p = machine.parameters;
    const SelfFilter filter(p);
    const Kinematics k(p);
    const double margin = p.self_margin_mm * 1e-3;
    int away = 0, near = 0;
    for (int i = 0; i < 4000; ++i) {
      const JointAngles q = random_pose(p, random);
      const berm_part& part = p.part[random() % static_cast<uint64_t>(p.parts)];
      JointAngles level = q;
      level.swing = 0.0;
      const Eigen::Vector3d point = k.link_in_base(level, part.link) * surface_point(part, random, uniform(random, 0, 3 * margin));
      if (point.z() < SelfFilter::body_height_m && std::hypot(point.x(), point.y()) < p.own_body_radius_mm * 1e-3) continue;
      const double distance = sampled_distance(p, k, q, point);
      if (distance > margin + 0.005) {
        ++away;
        ASSERT_FALSE(filter.is_own(point, q)) << "seed " << seed + 1 << " case " << i << " distance " << distance;
      } else if (distance <= margin) {
        ++near;
        ASSERT_TRUE(filter.is_own(point, q)) << "seed " << seed + 1 << " case " << i << " distance " << distance;
      }
    }
    EXPECT_GT(away, 500);
    EXPECT_GT(near, 500);
  }
}

// verifies: SK-GE-19
TEST(SelfFilter, TakesTheOwnBodysCylinderAndNothingAbove) {
  const berm_parameters p = machine_profiles().front().parameters;
  const SelfFilter filter(p);
  const double r = p.own_body_radius_mm * 1e-3;
  const JointAngles far{0.0, -0.9, -0.8, 0.0}; // implements low in front
  EXPECT_TRUE(filter.is_own({-r + 0.001, 0, 1.0}, far));
  EXPECT_FALSE(filter.is_own({-r - 0.001, 0, 1.0}, far));
  EXPECT_TRUE(filter.is_own({-1.0, 1.0, SelfFilter::body_height_m - 0.001}, far));
  EXPECT_FALSE(filter.is_own({-1.0, 1.0, SelfFilter::body_height_m + 0.001}, far));
  EXPECT_TRUE(filter.is_own({0, -r + 0.001, -5.0}, far));
  EXPECT_FALSE(filter.is_own({0.8 * r, 0.8 * r, 0.0}, far));
}

// verifies: SK-GE-18
TEST(SelfFilter, DoesNotTakeWhatIsNotANumber) {
  const berm_parameters p = machine_profiles().front().parameters;
  const SelfFilter filter(p);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf})
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d point(0.5, 0.2, 1.0);
      point[k] = bad;
      EXPECT_FALSE(filter.is_own(point, JointAngles{0.0, 0.5, -1.5, -1.0})) << bad << " at " << k;
    }
}

} // namespace berm::kernel::test
