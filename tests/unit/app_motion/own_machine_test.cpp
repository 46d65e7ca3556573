#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app_bench/bench_machine.hpp"
#include "motion/arm_kinematics.hpp"
#include "motion/own_machine.hpp"

namespace {

using namespace berm::app;

// Distance to a convex outline, 0 inside, in the link's frame.
double distance_to(const std::vector<std::array<double, 2>>& outline, double x, double z) {
  double nearest = 1e9;
  bool inside = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double ex = b[0] - a[0], ez = b[1] - a[1];
    const double t = std::clamp(((x - a[0]) * ex + (z - a[1]) * ez) / (ex * ex + ez * ez), 0.0, 1.0);
    nearest = std::min(nearest, std::hypot(x - a[0] - t * ex, z - a[1] - t * ez));
    inside = inside && ex * (z - a[1]) - ez * (x - a[0]) >= 0.0;
  }
  return inside ? 0.0 : nearest;
}

TEST(OwnMachine, HoldsWhatIsWithinTheMarginOfAPartAndNothingFarFromAll) {
  const MachineModel machine = berm::app_bench::zx200();
  ASSERT_GT(machine.self_margin, 0.1);
  OwnMachine own(machine);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int held = 0, beside = 0;
  for (int k = 0; k < 200; ++k) {
    Joints q{};
    for (const std::size_t j : {boom, stick, bucket}) q[j] = machine.joint[j].low + share(random) * (machine.joint[j].high - machine.joint[j].low);
    own.pose(q);
    const ArmPoints arm = forward(machine, q);
    for (int n = 0; n < 300; ++n) {
      const double x = 2.6 + 8.0 * share(random), y = -1.5 + 3.0 * share(random), z = -4.0 + 12.0 * share(random);
      if (std::hypot(x, y) < machine.own_body_radius) continue;
      double nearest = 1e9;  // to a part whose width the point is within, so far as the margin reaches
      for (const Prism& part : machine.parts) {
        const PlanePoint pin = part.link == boom ? arm.boom_pin : part.link == stick ? arm.stick_pin : arm.bucket_pin;
        const double a = part.link == boom ? q[boom] : part.link == stick ? arm.stick_attitude : arm.bucket_attitude;
        const double dx = x - pin.r, dz = z - pin.z;
        if (std::fabs(y) > part.half_width + machine.self_margin) continue;
        nearest = std::min(nearest, distance_to(part.outline, dx * std::cos(a) + dz * std::sin(a), dz * std::cos(a) - dx * std::sin(a)));
      }
      const bool holds = own.holds(x, y, z);
      if (nearest < machine.self_margin - 1e-9) {
        EXPECT_TRUE(holds) << nearest;
        ++held;
      } else if (nearest > 1.5 * machine.self_margin) {
        EXPECT_FALSE(holds) << nearest;
        ++beside;
      }
    }
  }
  EXPECT_GT(held, 1000);
  EXPECT_GT(beside, 10000);
}

TEST(OwnMachine, HoldsItsOwnBodyAtWhateverHeight) {
  const MachineModel machine = berm::app_bench::zx200();
  const OwnMachine own(machine);
  for (const double z : {-1.0, 2.0, 6.0}) {
    EXPECT_TRUE(own.holds(-0.9 * machine.own_body_radius, 0.0, z));
    EXPECT_FALSE(own.holds(-1.1 * machine.own_body_radius, 0.0, z));
  }
}

}  // namespace
