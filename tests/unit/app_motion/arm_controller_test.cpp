#include <gtest/gtest.h>

#include "app_bench/bench_machine.hpp"
#include "motion/arm_controller.hpp"

namespace {

using namespace berm::app;

TEST(ArmController, WhatIsTakenUpMostOfALagLaterLiesFartherOnTheWayThatJointsGo) {
  const MachineModel m = berm::app_bench::zx200();
  ArmController arm(m);
  const Joints angle{0.1, 0.4, -1.6, -1.2}, still{}, going{0.3, -0.4, 0.5, 0.0};
  for (int k = 0; k < 50; ++k) arm.sent(still);
  EXPECT_EQ(arm.taken_up(angle, still), arm.predicted(angle, still));
  for (int k = 0; k < 50; ++k) arm.sent(going);
  const Joints then = arm.predicted(angle, going), later = arm.taken_up(angle, going);
  for (std::size_t j = 0; j < joints; ++j) EXPECT_NEAR(later[j] - then[j], 0.6 * response_of(m, j).lag * going[j], 1e-3) << j;
  EXPECT_LT(later[boom], then[boom] - radians(0.5));
  EXPECT_EQ(later[bucket], then[bucket]);
}

}  // namespace
