// Sums over statements, four at a time and in single precision, against their residuals and slopes one by one.
#include "recognition/bed_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "drawn_beds.hpp"

namespace berm::app {
namespace {

constexpr unsigned kDrawnSumsSeed = 20262;

// Near the faces and edges of the bed at the values, as a fit has them.
class NearStatements : public DrawnBeds {
 public:
  NearStatements() : DrawnBeds(kDrawnSumsSeed) {}
  BedConstraint draw(const BedVector& values) {
    BedPose pose;
    set_values(pose, values);
    BedConstraint c;
    c.edge = side() > 0;
    const int axis = static_cast<int>(between(0.0, 2.999));
    c.plane = {axis, axis == 2 ? 1 : side(), axis < 2 && side() > 0};
    const int other = (axis + (side() > 0 ? 1 : 2)) % 3;
    c.bound = {other, other == 2 ? 1 : side(), other < 2 && side() > 0};
    c.sense = side();
    c.offset = c.edge ? 0.0 : between(-0.01, 0.01);
    c.deviation = between(0.01, 0.04);
    const auto limit = [&](const BedPlane& p) { return p.axis == 2 ? 0.0 : p.side * pose.face(p.axis, p.side, p.outer); };
    Eigen::Vector3d on(between(-2, 2), between(-1, 1), between(-0.5, 0.0)), from(between(-5, 5), between(-5, 5), between(2, 4));
    on[axis] = limit(c.plane) + (c.edge ? 0.0 : between(-0.1, 0.1));
    if (c.edge) {
      on[c.bound.axis] = limit(c.bound) + between(-0.3, 0.3);
      from[axis] = limit(c.plane) + (side() > 0 ? 3.0 : -3.0);  // well across the plane
    }
    c.head = (pose.middle + pose.rotation() * from).cast<float>();
    c.at = (pose.middle + pose.rotation() * (c.edge ? Eigen::Vector3d(on + 0.3 * (on - from)) : on)).cast<float>();
    return c;
  }
};

TEST(BedSums, AreThoseOfTheResiduals) {
  NearStatements draw;
  for (int round = 0; round < 60; ++round) {
    const BedVector values = draw.values();
    const int open_end = 0;
    std::vector<BedConstraint> statements;
    for (int k = 0; k < 1 + 3 * round; ++k) statements.push_back(draw.draw(values));
    BedSums one_by_one;
    for (const BedConstraint& c : statements) {
      BedVector slope;
      const double r = residual(c, BedAxes(values), values, open_end, &slope), s = r * r / (kRobust * kRobust);
      const double t = std::copysign(kRobust * std::sqrt(std::log1p(s)), r), by = std::abs(t) > 1e-9 ? r / (t * (1.0 + s)) : 1.0;
      one_by_one.square += t * t;
      one_by_one.products += by * by * slope * slope.transpose();
      one_by_one.downhill -= t * by * slope;
    }
    const BedSums sums = sums_of(PackedStatements(statements, open_end), values);
    EXPECT_NEAR(sums.square, one_by_one.square, 2e-4 * (1.0 + one_by_one.square)) << "seed " << kDrawnSumsSeed << ", round " << round;
    EXPECT_LT((sums.products - one_by_one.products).norm(), 1e-3 * one_by_one.products.norm()) << round;
    EXPECT_LT((sums.downhill - one_by_one.downhill).norm(), 1e-3 * std::sqrt((1.0 + one_by_one.square) * one_by_one.products.norm())) << round;
  }
}

// An open end is the sides' own: no wall's thickness lies beyond it.
TEST(BedSums, OfAnOpenEndHaveNoThickness) {
  NearStatements draw;
  const BedVector values = draw.values();
  BedConstraint c;
  do c = draw.draw(values);
  while (c.edge || c.plane.axis != 0 || !c.plane.outer);
  EXPECT_GT(sums_of(PackedStatements({c}, 0), values).products(kBedThickness, kBedThickness), 1.0);
  EXPECT_EQ(sums_of(PackedStatements({c}, c.plane.side), values).products(kBedThickness, kBedThickness), 0.0);
}

TEST(BedSums, OfNothingAreNothing) {
  NearStatements draw;
  const BedSums sums = sums_of(PackedStatements({}, 0), draw.values());
  EXPECT_EQ(sums.square, 0.0);
  EXPECT_EQ(sums.products.norm(), 0.0);
  EXPECT_EQ(sums.downhill.norm(), 0.0);
}

TEST(Lanes, LogarithmsAndExponentialsAreThose) {
  for (double x = -24.0; x <= 12.0; x += 0.0137) {
    const double e = std::exp(x);
    EXPECT_NEAR(static_cast<double>(exp8(eight(x))[2]), e, 3e-6 * e) << x;
    EXPECT_NEAR(static_cast<double>(log8(eight(e))[1]), x, 3e-7 * std::max(1.0, std::abs(x))) << x;
    EXPECT_NEAR(static_cast<double>(log1p8(eight(e))[3]), std::log1p(e), 1e-4 * std::log1p(e)) << x;
  }
}

}  // namespace
}  // namespace berm::app
