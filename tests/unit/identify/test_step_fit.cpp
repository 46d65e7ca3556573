// The fit finds the model that made the step responses, through noise, and says how surely.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "identify/step_fit.hpp"
#include "motion/joint_response.hpp"

namespace berm::identify::test {
namespace {

constexpr double kSpeedMax = 0.9, kCycle = 0.01;
constexpr std::size_t kReaches = 2;

app::JointResponse truth(bool loaded, std::size_t reach) {
  app::JointResponse r{0.063, loaded ? 0.25 : 0.35, kSpeedMax};
  r.lag = 0.12, r.stop_lag = 0.04, r.gain = 0.985;
  r.deceleration = (loaded ? 0.4 : 0.8) - 0.1 * static_cast<double>(reach);
  return r;
}

// In steps of a millisecond, to which the dead time is no whole cycle; read every cycle.
StepRecord made(const StepPlan& plan, double noise, std::mt19937_64& random) {
  constexpr int kSub = 10;
  const app::JointResponse r = truth(plan.loaded, plan.reach);
  StepRecord record;
  record.plan = plan;
  std::vector<double> commands;
  double speed = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double command = i < 10 ? 0.0 : i < 450 ? plan.speed : i < 700 ? 0.5 * plan.speed : 0.0;
    record.samples.push_back({i * kCycle, command, speed + std::uniform_real_distribution<double>(-noise, noise)(random)});
    for (int k = 0; k < kSub; ++k) {
      commands.push_back(command);
      const long due = static_cast<long>(commands.size()) - 1 - std::lround(r.dead_time * 1000.0);
      speed = app::speed_after(r, speed, due < 0 ? 0.0 : commands[static_cast<std::size_t>(due)], 0.001);
    }
  }
  return record;
}

std::vector<StepRecord> all(double noise, bool with_far_loaded = true) {
  std::mt19937_64 random(5);
  std::vector<StepRecord> records;
  for (const bool loaded : {false, true})
    for (std::size_t reach = 0; reach < kReaches; ++reach)
      for (const double speed : {0.2, 0.5, 0.8})
        if (with_far_loaded || !loaded || reach == 0) records.push_back(made({0, reach, loaded, speed, 1.0}, noise, random));
  return records;
}

StepFit fitted(const std::vector<StepRecord>& records) {
  std::vector<const StepRecord*> list;
  for (const StepRecord& record : records) list.push_back(&record);
  return fit_steps(list, kReaches, kSpeedMax, 0.5);
}

TEST(StepFit, FindsWhatMadeTheResponses) {
  const StepFit fit = fitted(all(0.0));
  EXPECT_NEAR(fit.dead_time.value, 0.063, 2e-4);
  EXPECT_NEAR(fit.lag.value, 0.12, 1e-3);
  EXPECT_NEAR(fit.stop_lag.value, 0.04, 1e-3);
  EXPECT_NEAR(fit.gain.value, 0.985, 1e-4);
  for (const bool loaded : {false, true}) {
    for (std::size_t reach = 0; reach < kReaches; ++reach) {
      EXPECT_NEAR(fit.speeding[loaded][reach].value, truth(loaded, reach).acceleration, 1e-3);
      EXPECT_NEAR(fit.slowing[loaded][reach].value, truth(loaded, reach).deceleration, 3e-3);
    }
  }
  EXPECT_LT(fit.residual, 1e-4);
  EXPECT_EQ(fit.records, 12u);
  EXPECT_EQ(fit.samples, 12000u);
}

TEST(StepFit, ThroughNoiseWithinFewTimesItsConfidence) {
  constexpr double kNoise = 0.004;
  const StepFit fit = fitted(all(kNoise));
  const auto near = [](const Fitted& f, double true_value) {
    EXPECT_GT(f.confidence, 0.0);
    EXPECT_LT(std::fabs(f.value - true_value), 3.0 * f.confidence) << f.value << " for " << true_value;
    EXPECT_LT(f.confidence, 0.1 * true_value);
  };
  near(fit.dead_time, 0.063);
  near(fit.lag, 0.12);
  near(fit.gain, 0.985);
  near(fit.slowing[1][1], 0.3);
  near(fit.speeding[0][0], 0.35);
  EXPECT_NEAR(fit.residual, kNoise / std::sqrt(3.0), 1e-4) << "what is left is the noise";
  EXPECT_GE(fit.worst_residual, fit.residual);
}

TEST(StepFit, WhatFollowsTheModelIsDrawnByIt) {
  const auto records = all(0.0);
  const StepFit fit = fitted(records);
  const auto speeds = fitted_speeds(fit, records[4], kSpeedMax);
  ASSERT_EQ(speeds.size(), records[4].samples.size());
  for (std::size_t i = 0; i < speeds.size(); ++i) EXPECT_NEAR(speeds[i], records[4].samples[i].speed, 2e-3);
}

TEST(StepFit, ALoadAndReachWithoutResponsesIsRefused) { EXPECT_THROW(fitted(all(0.0, false)), std::runtime_error); }

}  // namespace
}  // namespace berm::identify::test
