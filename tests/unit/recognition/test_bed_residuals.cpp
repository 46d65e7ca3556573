// The closed derivatives of a fit's residuals, against differences of the residuals themselves, for drawn statements.
#include <gtest/gtest.h>

#include "drawn_beds.hpp"

namespace berm::app {
namespace {

constexpr unsigned kSeed = 20261123;
constexpr double kDifference = 1e-6;

class DrawnStatements : public DrawnBeds {
 public:
  DrawnStatements() : DrawnBeds(kSeed) {}
  BedPlane plane(int axis) { return {axis, side(), axis < 2 && side() > 0}; }
  BedConstraint statement(const BedVector& values) {
    BedConstraint c;
    c.head = Eigen::Vector3d(between(-1, 1), between(-1, 1), between(3, 4)).cast<float>();
    c.at = (values.head<3>() + Eigen::Vector3d(between(-3, 3), between(-3, 3), between(-1.5, 0.5))).cast<float>();
    c.edge = side() > 0;
    const int axis = static_cast<int>(between(0.0, 2.999));
    c.plane = plane(axis);
    c.bound = plane((axis + (side() > 0 ? 1 : 2)) % 3);
    c.sense = side();
    c.offset = between(-0.01, 0.01);
    c.deviation = c.edge ? between(0.3, 1.0) : between(0.01, 0.05);  // so wide that drawn rays are near an edge
    return c;
  }
};

TEST(BedResiduals, SlopesAreThoseOfTheResiduals) {
  DrawnStatements draw;
  int edges = 0, sloped = 0;
  for (int k = 0; k < 4000; ++k) {
    const BedVector values = draw.values();
    const BedConstraint c = draw.statement(values);
    const int open_end = k % 3 - 1;
    BedVector slope;
    const double at = residual(c, BedAxes(values), values, open_end, &slope);
    ASSERT_DOUBLE_EQ(at, residual(c, BedAxes(values), values, open_end, nullptr));
    if (c.edge && slope.norm() > 1e3) continue;  // the ray nearly lies in the plane that it crosses: differences tell nothing
    edges += c.edge ? 1 : 0, sloped += slope.norm() > 1e-3 ? 1 : 0;
    for (int i = 0; i < kBedValues; ++i) {
      BedVector more = values, less = values;
      more[i] += kDifference, less[i] -= kDifference;
      const double by_differences = (residual(c, BedAxes(more), more, open_end, nullptr) - residual(c, BedAxes(less), less, open_end, nullptr)) / (2 * kDifference);
      ASSERT_NEAR(slope[i], by_differences, 1e-3 * std::max(1.0, slope.norm())) << "statement " << k << " of seed " << kSeed << ", value " << i;
    }
  }
  EXPECT_GT(edges, 1500);
  EXPECT_GT(sloped, 3000);
}

// Half an edge's squared residual is the negative logarithm of the logistic function, far on either side too.
TEST(BedResiduals, EdgesAreLogistic) {
  BedVector values;
  values << 0, 0, 0, 0, 0, 0, 5, 2.5, 0.1;
  // Straight down through the plane of the tops, about the inner edge at y = 1.25; places that single precision holds exactly.
  const auto passing = [&](double y) {
    BedConstraint c;
    c.head = Eigen::Vector3d(0.0, y, 2.0).cast<float>(), c.at = Eigen::Vector3d(0.0, y, -1.0).cast<float>();
    c.edge = true, c.plane = {2, 1, false}, c.bound = {1, 1, false}, c.sense = 1, c.deviation = 0.01;
    return residual(c, BedAxes(values), values, 0, nullptr);
  };
  EXPECT_NEAR(0.5 * std::pow(passing(1.25), 2), std::log(2.0), 1e-9);
  EXPECT_NEAR(0.5 * std::pow(passing(1.3125), 2), 6.25 + std::log1p(std::exp(-6.25)), 1e-9);
  EXPECT_NEAR(0.5 * std::pow(passing(1.625), 2), 37.5, 1e-9);
  EXPECT_EQ(passing(0.75), 0.0);
}

}  // namespace
}  // namespace berm::app
