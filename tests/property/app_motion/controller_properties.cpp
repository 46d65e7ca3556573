// Every joint lands within a degree of any goal, without overshoot, on a joint as its file promises, on slower ones, and behind a kernel that cuts.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "app_bench/bench_machine.hpp"
#include "motion/arm_controller.hpp"

namespace {

using namespace berm::app;

struct Landing { double overshoot = 0.0, error = 0.0, seconds = 0.0; };

Landing land(const MachineModel& m, std::size_t j, double start, double goal, double weakness, double noise_deg, unsigned seed) {
  JointResponse response = response_of(m, j);
  response.acceleration *= weakness;
  JointModel plant(response, m.cycle);
  plant.reset(start, 0.0);
  JointController controller(response_of(m, j), m.cycle);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> noise(-radians(noise_deg), radians(noise_deg));
  const ControllerLimits limits = limits_of(m, j, 7.0);
  const double direction = goal > start ? 1.0 : -1.0;
  Landing result;
  double quiet = 0.0;
  for (int k = 0; k < 3000 && quiet < 0.5; ++k) {
    const double command = controller.toward(goal, plant.angle() + noise(random), plant.velocity(), limits);
    controller.sent(command);
    plant.advance(command);
    result.overshoot = std::max(result.overshoot, direction * (plant.angle() - goal));
    quiet = std::fabs(plant.angle() - goal) < radians(0.5) && std::fabs(plant.velocity()) < radians(0.5) ? quiet + m.cycle : 0.0;
    result.seconds += m.cycle;
  }
  result.error = std::fabs(plant.angle() - goal);
  return result;
}

RC_GTEST_PROP(JointController, LandsWithoutOvershoot, ()) {
  static const MachineModel m = berm::app_bench::zx200();
  const std::size_t j = static_cast<std::size_t>(*rc::gen::inRange(0, 4));
  const double low = j == swing ? radians(-90.0) : m.joint[j].low, high = j == swing ? radians(120.0) : m.joint[j].high;
  const double start = low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0, goal = low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0;
  const double weakness = *rc::gen::inRange(85, 101) / 100.0;
  const Landing landing = land(m, j, start, goal, weakness, 0.0, 1);
  RC_ASSERT(landing.error < radians(1.0));
  RC_ASSERT(landing.overshoot < radians(0.3));
  RC_ASSERT(landing.seconds < 15.0);
}

RC_GTEST_PROP(JointController, LandsInMeasurementNoise, ()) {
  static const MachineModel m = berm::app_bench::zx200();
  const std::size_t j = static_cast<std::size_t>(*rc::gen::inRange(0, 4));
  const double start = radians(-70.0), goal = start + radians(*rc::gen::inRange(3, 60));
  const Landing landing = land(m, j, start, goal, 1.0, 0.15, *rc::gen::inRange(1u, 1000u));
  RC_ASSERT(landing.error < radians(1.0));
  RC_ASSERT(landing.overshoot < radians(1.0));
}

// A kernel that cuts to something else every so often; where it cuts, it permits what it lets out.
RC_GTEST_PROP(JointController, LandsWithoutOvershootThoughTheKernelCuts, ()) {
  static const MachineModel m = berm::app_bench::zx200();
  const std::size_t j = static_cast<std::size_t>(*rc::gen::inRange(0, 4));
  const double low = j == swing ? radians(-90.0) : m.joint[j].low, high = j == swing ? radians(120.0) : m.joint[j].high;
  const double start = low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0, goal = low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0;
  std::mt19937_64 random(*rc::gen::inRange(1u, 100000u));
  std::uniform_real_distribution<double> share(0.0, 1.5);
  std::uniform_int_distribution<int> steps(1, 80);
  const ControllerLimits limits = limits_of(m, j, 7.0);
  const double largest = m.joint[j].velocity_max, up = limits.acceleration * m.cycle, direction = goal > start ? 1.0 : -1.0;
  JointModel plant(response_of(m, j), m.cycle);
  plant.reset(start, 0.0);
  JointController controller(response_of(m, j), m.cycle);
  double let_out = 0.0, permitted_low = -largest, permitted_high = largest, most = largest, overshoot = 0.0;
  for (int k = 0, left = 0; k < 3000; ++k) {
    if (left-- == 0) {
      most = k < 1500 ? share(random) * limits.velocity : largest;  // in the end nothing is cut: it must arrive
      left = steps(random);
    }
    controller.heard(let_out, permitted_low, permitted_high);
    // A joint that lags, and is to speed up as it can, is asked for so much more than its speed when that acts; of a speed that was cut none of it.
    constexpr double bus_step = 0.0005;
    const double whole = controller.share(), off = whole > 0.0 ? std::fabs(let_out) * (1.0 / whole - 1.0) : largest;
    const double ahead = std::fabs(controller.predict(plant.angle(), plant.velocity()).velocity) + limits.acceleration * response_of(m, j).lag;
    const double asked = controller.toward(goal, plant.angle(), plant.velocity(), limits);
    controller.asked(asked);
    RC_ASSERT(asked >= permitted_low && asked <= permitted_high);
    RC_ASSERT(std::fabs(asked) <= std::max(std::fabs(let_out) + up, off > bus_step ? 0.0 : ahead) + 1e-12);
    let_out = std::clamp(asked, -most, most);
    permitted_low = let_out == asked ? -largest : std::min(0.0, let_out);
    permitted_high = let_out == asked ? largest : std::max(0.0, let_out);
    plant.advance(let_out);
    overshoot = std::max(overshoot, direction * (plant.angle() - goal));
  }
  RC_ASSERT(std::fabs(plant.angle() - goal) < radians(1.0));
  RC_ASSERT(overshoot < radians(0.3));
}

}  // namespace
