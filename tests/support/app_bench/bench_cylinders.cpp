#include "app_bench/bench_cylinders.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berm::app_bench {

using namespace app;

namespace {
constexpr double gravity = 9.81, boom_kg = 2000.0, stick_kg = 1000.0, bucket_kg = 700.0;
constexpr double brings = 12e-3;     // kg per N s
constexpr double hardest = 120e3;    // N
}  // namespace

PlaneForce soil_push(const MachineModel& machine, const Joints& before, const Joints& now, double taken_kg) {
  const PlanePoint from = forward(machine, before).tip, to = forward(machine, now).tip;
  const double way = std::hypot(to.r - from.r, to.z - from.z), force = std::min(hardest, taken_kg / (brings * machine.cycle));
  return way > 0.0 ? PlaneForce{-force * (to.r - from.r) / way, -force * (to.z - from.z) / way} : PlaneForce{};
}

CylinderPressures pressures(const MachineModel& machine, const Joints& angle, double load_kg, const PlaneForce& soil) {
  const ArmPoints arm = forward(machine, angle);
  const std::array<PlanePoint, 4> pin{arm.boom_pin, arm.stick_pin, arm.bucket_pin, arm.tip};
  const std::array<double, 3> mass{boom_kg, stick_kg, bucket_kg + load_kg};
  CylinderPressures out{};
  for (std::size_t c = 0; c < out.size(); ++c) {
    double moment = soil.r * (arm.tip.z - pin[c].z) - soil.z * (arm.tip.r - pin[c].r);
    for (std::size_t link = c; link < mass.size(); ++link) moment += gravity * mass[link] * (0.5 * (pin[link].r + pin[link + 1].r) - pin[c].r);
    const double extending = c == 0 ? moment : -moment;  // the boom's cylinder raises; stick's and bucket's crowd
    if (extending > 0.0) out[c].bottom_kpa = extending / machine.cylinder[c].bottom;
    else out[c].rod_kpa = -extending / machine.cylinder[c].rod;
  }
  return out;
}

}  // namespace berm::app_bench
