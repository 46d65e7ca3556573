// Where the raised implements stand while the machine is moved: on the same cells of the kernel's map whatever the noise of the swing angle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/move_bearing.hpp"
#include "app_bench/bench_machine.hpp"
#include "motion/arm_kinematics.hpp"
#include "planning/pass_script.hpp"

namespace {

using namespace berm::app;

constexpr double cell = 0.3;
constexpr double noise = radians(0.4);  // either way: two errors of the swing angle, and what a standing swing may still do

// Whether the side of some part lies on other cells, somewhere along it and beyond the machine's own body, when the swing is turned by the noise.
bool trembles(const MachineModel& machine, double bearing) {
  const ArmPoints arm = forward(machine, *raised_pose(machine, 0.4, false));
  for (const Prism& part : machine.parts) {
    const double near = part.link == boom ? machine.own_body_radius : part.link == stick ? arm.bucket_pin.r : std::min(arm.bucket_pin.r, arm.tip.r);
    const double far = part.link == bucket ? std::max(arm.bucket_pin.r, arm.tip.r) : arm.stick_pin.r;
    for (const double side : {-part.half_width, part.half_width})
      for (double r = near; r < far; r += 0.01) {
        const auto row = [&](double swing) { return std::floor((r * std::sin(swing) + side * std::cos(swing)) / cell); };
        if (row(bearing - noise) != row(bearing + noise)) return true;
      }
  }
  return false;
}

double bearing_for(const MachineModel& machine, double middle) { return move_bearing(machine, *raised_pose(machine, 0.4, false), middle, cell); }

TEST(MoveBearing, TheStandingImplementsAreOverTheSameCellsWhateverTheNoise) {
  EXPECT_TRUE(trembles(berm::app_bench::zx200(), 0.0)) << "straight ahead their sides lie on the edges of cells";
  for (const char* name : {"zx200", "excavator_12t"}) {
    const MachineModel machine = berm::app_bench::shipped_machine(name);
    EXPECT_FALSE(trembles(machine, bearing_for(machine, 0.0))) << name;
  }
}

TEST(MoveBearing, IsNearTheMiddle) {
  for (const char* name : {"zx200", "excavator_12t", "excavator_25t"})
    for (const double middle : {0.0, radians(-20.0), radians(45.0)}) {
      const MachineModel machine = berm::app_bench::shipped_machine(name);
      EXPECT_LE(std::fabs(bearing_for(machine, middle) - middle), radians(3.0) + 1e-9) << name;
    }
}

}  // namespace
