#include <gtest/gtest.h>

#include <cmath>

#include "machine_file.hpp"
#include "plant/machine/cylinder_pressures.hpp"
#include "plant/machine/kinematics.hpp"

namespace berm::plant::testing {
namespace {

constexpr double kGravity = 9.81;

class CylinderPressures : public ::testing::Test {
 protected:
  std::array<double, 3> moments(const JointState& s, double kg, const EdgeForce& edge = {}) const { return holding_moments(p.dynamics.inertia, p.shape, s, kg, edge); }
  double boom_bottom(const JointState& s, double kg) const { return cylinder_pressures(p.dynamics, p.shape, s, kg, {})[0].bottom_kpa; }
  const PlantProfile p = profile();
};

TEST_F(CylinderPressures, BoomRisesWithPayloadAndReach) {
  const JointState near = pose(0, 55, -130, -60), far = pose(0, 30, -60, -60);
  EXPECT_LT(boom_bottom(near, 0), boom_bottom(near, 1500));
  EXPECT_LT(boom_bottom(near, 1500), boom_bottom(far, 1500));
  EXPECT_LT(boom_bottom(far, 1800), 41000) << "the frame's largest value";
}

// Virtual work: the moments times small turns of the joints are the rise of the weights, less what the soil's force does.
TEST_F(CylinderPressures, MomentsDoTheWorkOfWeightsAndSoil) {
  const InertiaConfig& m = p.dynamics.inertia;
  const EdgeForce edge{31e3, -12e3};
  constexpr double kg = 1400, turn = 1e-6;
  const auto energy = [&](const JointState& s) {
    const ImplementPose q = implement_pose(p.shape, s);
    const double boom_z = q.boom.origin.z + (m.boom_radius - p.shape.boom_pin_x) * std::sin(q.boom.angle);
    return kGravity * (m.boom_mass * boom_z + m.stick_mass * place(q.stick, m.stick_centre).z + (m.bucket_mass + kg) * place(q.bucket, m.bucket_centre).z) -
           (edge.r_n * q.tip.r + edge.z_n * q.tip.z);
  };
  for (const JointState& s : {pose(0, 40, -100, -60), pose(0, -5, -55, -35), pose(0, 12, -75, -120)}) {
    const auto hold = moments(s, kg, edge);
    for (std::size_t c = 0; c < 3; ++c) {
      JointState low = s, high = s;
      low.angle[c + 1] -= turn;
      high.angle[c + 1] += turn;
      EXPECT_NEAR(hold[c], (energy(high) - energy(low)) / (2 * turn), 5.0) << "cylinder " << c;
    }
  }
}

TEST_F(CylinderPressures, OneSideCarriesAndGivesTheMomentBack) {
  for (const EdgeForce& edge : {EdgeForce{0, 0}, EdgeForce{50e3, 0}, EdgeForce{-20e3, 90e3}}) {
    const JointState s = pose(0, 2, -60, -60);
    const auto hold = moments(s, 800, edge);
    const auto sides = cylinder_pressures(p.dynamics, p.shape, s, 800, edge);
    for (std::size_t c = 0; c < 3; ++c) {
      const CylinderConfig& cylinder = p.dynamics.cylinder[c];
      EXPECT_DOUBLE_EQ(std::min(sides[c].bottom_kpa, sides[c].rod_kpa), 500.0);
      const double extending = sides[c].bottom_kpa * cylinder.bottom - sides[c].rod_kpa * cylinder.rod;
      EXPECT_NEAR(c == 0 ? extending : -extending, hold[c], 1e-6 + 1e-9 * std::abs(hold[c]));
    }
  }
}

}  // namespace
}  // namespace berm::plant::testing
