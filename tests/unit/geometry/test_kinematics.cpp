#include "geometry/kinematics.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <iostream>

#include "machine_profile.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint64_t seed = 1;
constexpr double tolerance_m = 1e-12;

} // namespace

// verifies: SK-GE-1
TEST(Kinematics, AgreesWithTheFigureAtKnownAngles) {
  for (const Machine& machine : machine_profiles()) {
    const berm_parameters& p = machine.parameters;
    const Kinematics k(p);
    const double pin_x = p.boom_pin_x_mm * 1e-3, pin_z = p.boom_pin_z_mm * 1e-3;
    const double boom = p.boom_length_mm * 1e-3, stick = p.stick_length_mm * 1e-3, bucket = p.bucket_length_mm * 1e-3;
    const double quarter = 1.5707963267948966;
    EXPECT_LT((k.tip_in_base({}) - Eigen::Vector3d(pin_x + boom + stick + bucket, 0, pin_z)).norm(), tolerance_m);
    // boom up, stick level forward, bucket down; swung to the left
    EXPECT_LT((k.tip_in_base({quarter, quarter, -quarter, -quarter}) - Eigen::Vector3d(0, pin_x + stick, pin_z + boom - bucket)).norm(), tolerance_m);
  }
}

// Against an independent form: a sum of complex numbers in the swing plane, turned in the ground plane.
// verifies: SK-GE-1
// verifies: SK-GE-2
TEST(Kinematics, AgreesWithComplexNumbersAtRandomAngles) {
  std::mt19937_64 random(seed);
  using C = std::complex<double>;
  for (const Machine& machine : machine_profiles()) {
    const berm_parameters& p = machine.parameters;
    const Kinematics k(p);
    const double length[3] = {p.boom_length_mm * 1e-3, p.stick_length_mm * 1e-3, p.bucket_length_mm * 1e-3};
    for (int i = 0; i < 2000; ++i) {
      int32_t urad[4];
      for (int j = 0; j < 4; ++j) urad[j] = static_cast<int32_t>(uniform(random, p.joint_low_urad[j], p.joint_high_urad[j]));
      const JointAngles q = joint_angles(urad);
      const C swing = std::polar(1.0, urad[0] * 1e-6);
      C at(p.boom_pin_x_mm * 1e-3, p.boom_pin_z_mm * 1e-3), heading(1.0);
      const ImplementPose pose = k.implements(q);
      for (int link = 1; link <= 3; ++link) {
        heading *= std::polar(1.0, urad[link] * 1e-6);
        const Eigen::Vector3d v(uniform(random, -2, 2), uniform(random, -1, 1), uniform(random, -2, 2)); // link frame: along, left, up
        const C plane = at + heading * C(v.x(), v.z());
        const C ground = swing * C(plane.real(), v.y());
        const Eigen::Isometry3d frame = k.link_in_base(q, link);
        ASSERT_LT((frame * v - Eigen::Vector3d(ground.real(), ground.imag(), plane.imag())).norm(), tolerance_m) << "seed " << seed;
        ASSERT_LT((frame.linear() * frame.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), tolerance_m);
        ASSERT_GT(frame.linear().determinant(), 0.5);
        const Eigen::Vector2d in_plane = pose.link[link - 1].to_plane({v.x(), v.z()});
        ASSERT_LT((in_plane - Eigen::Vector2d(plane.real(), plane.imag())).norm(), tolerance_m);
        ASSERT_LT((pose.link[link - 1].to_link(in_plane) - Eigen::Vector2d(v.x(), v.z())).norm(), tolerance_m);
        at += heading * length[link - 1];
      }
      const C ground = swing * C(at.real(), 0.0);
      ASSERT_LT((k.tip_in_base(q) - Eigen::Vector3d(ground.real(), ground.imag(), at.imag())).norm(), tolerance_m);
    }
  }
}

} // namespace berm::kernel::test
