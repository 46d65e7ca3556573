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
constexpr double at_most = radians(3.0);  // from the middle

Joints raised(const MachineModel& machine) { return *raised_pose(machine, 0.4, false); }

double bearing_for(const MachineModel& machine, double middle) { return move_bearing(machine, raised(machine), middle, cell); }

// By how much the swing may turn either way before a side of some part lies on another cell, somewhere along it and beyond the machine's own body. Rad, in steps.
double turns_before_it_trembles(const MachineModel& machine, double bearing) {
  const ArmPoints arm = forward(machine, raised(machine));
  const auto trembles = [&](double turn) {
    for (const Prism& part : machine.parts) {
      const double near = part.link == boom ? machine.own_body_radius : part.link == stick ? arm.bucket_pin.r : std::min(arm.bucket_pin.r, arm.tip.r);
      const double far = part.link == bucket ? std::max(arm.bucket_pin.r, arm.tip.r) : arm.stick_pin.r;
      for (const double side : {-part.half_width, part.half_width})
        for (double r = near; r < far; r += 0.01) {
          const auto row = [&](double swing) { return std::floor((r * std::sin(swing) + side * std::cos(swing)) / cell); };
          if (row(bearing - turn) != row(bearing + turn)) return true;
        }
    }
    return false;
  };
  constexpr double step = radians(0.05);
  double turn = 0.0;
  while (turn < at_most && !trembles(turn + step)) turn += step;
  return turn;
}

TEST(MoveBearing, TheStandingImplementsAreOverTheSameCellsWhateverTheNoise) {
  EXPECT_EQ(turns_before_it_trembles(berm::app_bench::zx200(), 0.0), 0.0) << "straight ahead their sides lie on the edges of cells";
  // Either way: half a degree that it may stand off its goal, two errors of the swing angle, and what a standing swing may still do; of the 12 t machine the latter two.
  struct Turn { const char* name; double deg; };
  for (const auto& [name, deg] : {Turn{"zx200", 0.9}, Turn{"excavator_12t", 0.6}}) {
    const MachineModel machine = berm::app_bench::shipped_machine(name);
    EXPECT_GE(turns_before_it_trembles(machine, bearing_for(machine, 0.0)), radians(deg)) << name;
  }
}

TEST(MoveBearing, IsNearTheMiddleAndNoWorseThanIt) {
  for (const char* name : {"zx200", "excavator_12t", "excavator_25t"})
    for (const double middle : {0.0, radians(-1.0), radians(2.0)}) {
      const MachineModel machine = berm::app_bench::shipped_machine(name);
      const double found = bearing_for(machine, middle);
      EXPECT_LE(std::fabs(found - middle), at_most + 1e-9) << name;
      EXPECT_GE(turns_before_it_trembles(machine, found), turns_before_it_trembles(machine, middle)) << name << ", " << degrees(middle) << " degrees";
    }
}

}  // namespace
