#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "app_bench/bench_machine.hpp"
#include "motion/arm_kinematics.hpp"

namespace {

using namespace berm::app;

double within(double low, double high, int thousandths) { return low + (high - low) * thousandths / 1000.0; }

RC_GTEST_PROP(ArmKinematics, InverseOfForwardIsTheSamePose, ()) {
  static const MachineModel m = berm::app_bench::zx200();
  Joints q{};
  for (const std::size_t j : {boom, stick, bucket}) q[j] = within(m.joint[j].low, m.joint[j].high, *rc::gen::inRange(0, 1001));
  const ArmPoints p = forward(m, q);
  const auto by_pin = inverse_pin(m, p.bucket_pin, p.bucket_attitude);
  const auto by_tip = inverse_tip(m, p.tip, p.bucket_attitude);
  RC_ASSERT(by_pin.has_value());
  RC_ASSERT(by_tip.has_value());
  for (const std::size_t j : {boom, stick, bucket}) {
    RC_ASSERT(std::fabs((*by_pin)[j] - q[j]) < 1e-9);
    RC_ASSERT(std::fabs((*by_tip)[j] - q[j]) < 1e-9);
  }
}

RC_GTEST_PROP(ArmKinematics, ForwardOfInverseIsTheSamePoint, ()) {
  static const MachineModel m = berm::app_bench::zx200();
  const PlanePoint tip{within(3.0, 9.5, *rc::gen::inRange(0, 1001)), within(-4.0, 6.0, *rc::gen::inRange(0, 1001))};
  const double attitude = within(radians(-200.0), radians(-30.0), *rc::gen::inRange(0, 1001));
  const auto q = inverse_tip(m, tip, attitude);
  RC_PRE(q.has_value());
  const ArmPoints p = forward(m, *q);
  RC_ASSERT(std::hypot(p.tip.r - tip.r, p.tip.z - tip.z) < 1e-9);
  RC_ASSERT(std::fabs(wrapped(p.bucket_attitude - attitude)) < 1e-9);
  for (const std::size_t j : {boom, stick, bucket}) RC_ASSERT((*q)[j] >= m.joint[j].low - 1e-9 && (*q)[j] <= m.joint[j].high + 1e-9);
}

}  // namespace
