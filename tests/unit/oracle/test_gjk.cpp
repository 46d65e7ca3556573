#include <gtest/gtest.h>

#include <cmath>

#include "plant/oracle/oracle.hpp"

namespace berm::plant::oracle {
namespace {

Body box(double x, double y, double z, double side, double yaw = 0) {
  const double h = side / 2;
  return body_of({"", x, y, z, yaw, {-h, -h, -h}, {h, h, h}});
}

void expect_distance(const Body& a, const Body& b, double expected) {
  const Distance d = distance(a, b);
  EXPECT_NEAR(d.upper, expected, 1e-6);
  EXPECT_NEAR(d.lower, expected, 1e-6);
  const Distance other = distance(b, a);
  EXPECT_NEAR(other.upper, expected, 1e-6);
}

TEST(Gjk, FaceToFaceEdgeToEdgeCornerToCorner) {
  expect_distance(box(0, 0, 0, 2), box(5, 0, 0, 2), 3);
  expect_distance(box(0, 0, 0, 2), box(5, 5, 0, 2), std::hypot(3, 3));
  expect_distance(box(0, 0, 0, 2), box(5, 5, 5, 2), std::sqrt(27.0));
  expect_distance(box(0, 0, 0, 2), box(5, 0, 0, 2, 3.14159265358979 / 4), 4 - std::sqrt(2.0));
}

TEST(Gjk, BoxAndCylinder) {
  const Body person = Body::cylinder({4, 0, 0}, 0.25, 1.8);
  expect_distance(box(0, 0, 1, 2), person, 2.75);
  expect_distance(box(4, 0, 4, 2), person, 1.2);
  expect_distance(box(3, 3, 1, 1), person, std::hypot(0.5, 2.5) - 0.25);
  expect_distance(box(4.1, 0.05, 3.3, 2), person, 0.5);
  // A corner over the rim.
  expect_distance(box(6, 0, 3.8, 2), person, std::hypot(0.75, 1.0));
}

TEST(Gjk, MeetingBodiesHaveNoDistance) {
  EXPECT_TRUE(distance(box(0, 0, 0, 2), box(1.9, 0, 0, 2)).meet());
  EXPECT_TRUE(distance(box(0, 0, 0, 2), box(0, 0, 0, 1)).meet()) << "one inside the other";
  EXPECT_TRUE(distance(box(0, 0, 0, 2), Body::cylinder({0.3, 0.3, -3}, 0.25, 6)).meet()) << "run through";
  EXPECT_TRUE(distance(box(0, 0, 0, 2), box(2, 0.3, 0.2, 2)).meet()) << "touching";
  EXPECT_FALSE(distance(box(0, 0, 0, 2), box(2.00001, 0.3, 0.2, 2)).meet());
}

TEST(Gjk, HoldsSmallAndFarBodies) {
  expect_distance(box(0, 0, 0, 0.01), box(0.02, 0, 0, 0.01), 0.01);
  expect_distance(box(100, 100, 0, 1), box(100, 104, 0, 1), 3);
}

TEST(Gjk, SphereHoldsTheBody) {
  const Body b = box(1, 2, 3, 2, 0.7);
  for (const Point& p : b.corner) EXPECT_LE((p - b.middle).norm(), b.reach + 1e-12);
  const Body c = Body::cylinder({1, 1, 0}, 0.3, 2);
  for (double a = 0; a < 6.3; a += 0.1) EXPECT_LE((c.support({std::cos(a), std::sin(a), 1}) - c.middle).norm(), c.reach + 1e-12);
}

}  // namespace
}  // namespace berm::plant::oracle
