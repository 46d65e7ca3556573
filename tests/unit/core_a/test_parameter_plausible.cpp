// Blocks within every format that no machine has, and that would void what the kernel promises: no way to brake, no margin, no latency, no error, full
// speed where it is to be slow, cycles that all count as late. Each limit is met from both sides.
#include <gtest/gtest.h>

#include <functional>

#include "core/parameter_check.h"
#include "valid_parameters.hpp"

namespace berm::core_test {
namespace {

using Edit = std::function<void(berm_parameters&)>;

class ParameterPlausible : public testing::Test {
 protected:
  std::int32_t with(const Edit& edit) const {
    berm_parameters p = ok;
    edit(p);
    return sk_parameters_check(&p);
  }
  // Passes at the limit, is refused one beyond it.
  void expect_limit(std::int32_t rule, std::int32_t limit, std::int32_t beyond, const std::function<void(berm_parameters&, std::int32_t)>& set) const {
    EXPECT_EQ(with([&](auto& p) { set(p, limit); }), SK_RULE_NONE) << limit;
    EXPECT_EQ(with([&](auto& p) { set(p, beyond); }), rule) << beyond;
  }
  const berm_parameters ok = valid_parameters();
};

// verifies: SK-PC-42
TEST_F(ParameterPlausible, Margin) {
  expect_limit(SK_RULE_MARGIN, 100, 99, [](auto& p, std::int32_t v) { p.margin_mm = v; });
}

// verifies: SK-PC-16, SK-PC-17
TEST_F(ParameterPlausible, ErrorsAreNotBelowWhatTheFramesRound) {
  for (int j = 0; j < SK_JOINTS; ++j) {
    expect_limit(SK_RULE_ANGLE_ERROR, 200, 199, [j](auto& p, std::int32_t v) { p.angle_error_urad[j] = v; });
    expect_limit(SK_RULE_VELOCITY_ERROR, 100, 99, [j](auto& p, std::int32_t v) { p.velocity_error_urad_s[j] = v; });
  }
}

// verifies: SK-PC-18, SK-PC-19, SK-PC-55
TEST_F(ParameterPlausible, NeitherLatencyIsBelowACycle) {
  const auto least_cycle = [](auto& p) { p.cycle_us = 1000; };
  expect_limit(SK_RULE_STATE_LATENCY, 1000, 999, [&](auto& p, std::int32_t v) { least_cycle(p), p.state_latency_us = v; });
  expect_limit(SK_RULE_COMMAND_LATENCY, 1000, 999, [&](auto& p, std::int32_t v) { least_cycle(p), p.command_latency_us = v; });
  expect_limit(SK_RULE_CYCLE, ok.cycle_us, ok.cycle_us - 1, [](auto& p, std::int32_t v) { p.state_latency_us = v; });
  expect_limit(SK_RULE_CYCLE, ok.cycle_us, ok.cycle_us - 1, [](auto& p, std::int32_t v) { p.command_latency_us = v; });
}

// verifies: SK-PC-55
TEST_F(ParameterPlausible, NoCycleCountsAsLate) {
  expect_limit(SK_RULE_CYCLE, 20000, 20001, [](auto& p, std::int32_t v) { p.state_latency_us = p.command_latency_us = 30000, p.cycle_us = v; });
}

// verifies: SK-PC-15, SK-PC-45
TEST_F(ParameterPlausible, SlowIsSlow) {
  for (int j = 0; j < SK_JOINTS; ++j) {
    expect_limit(SK_RULE_CREEP_VELOCITY, 261799, 261800, [j](auto& p, std::int32_t v) { p.creep_velocity_urad_s[j] = v; });
    expect_limit(SK_RULE_CREEP_VELOCITY, 200000, 200001, [j](auto& p, std::int32_t v) { p.velocity_max_urad_s[j] = 200000, p.creep_velocity_urad_s[j] = v; });
    EXPECT_EQ(with([j](auto& p) { p.creep_velocity_urad_s[j] = p.velocity_max_urad_s[j]; }), SK_RULE_CREEP_VELOCITY);
  }
  expect_limit(SK_RULE_DIG_SWING_LIMIT, 261799, 261800, [](auto& p, std::int32_t v) { p.dig_swing_limit_urad_s = v; });
  expect_limit(SK_RULE_DIG_SWING_LIMIT, 200000, 200001, [](auto& p, std::int32_t v) { p.velocity_max_urad_s[0] = 200000, p.dig_swing_limit_urad_s = v; });
  EXPECT_EQ(with([](auto& p) { p.dig_swing_limit_urad_s = p.velocity_max_urad_s[0]; }), SK_RULE_DIG_SWING_LIMIT);
}

// The least whole number that is no less than numerator / denominator.
std::int32_t least(std::int64_t numerator, std::int64_t denominator) { return static_cast<std::int32_t>((numerator + denominator - 1) / denominator); }

// A table of the shortest stops there may be: from speed v with four times the acceleration a the way is v^2 / 8 a, the time v / 4 a.
void shortest_stops(berm_parameters& p) {
  for (int j = 0; j < SK_JOINTS; ++j)
    for (int r = 0; r < BERM_BRAKE_REACHES; ++r)
      for (int k = 0; k < BERM_BRAKE_SPEEDS; ++k) {
        const std::int64_t sevenfold = std::int64_t{k} * p.velocity_max_urad_s[j], a = p.acceleration_max_urad_s2[j];
        p.brake_angle_urad[j][r][k] = least(sevenfold * sevenfold, 49 * 8 * a);
        p.brake_time_us[j][r][k] = least(sevenfold * 1'000'000, 7 * 4 * a);
      }
}

// verifies: SK-PC-96, SK-PC-97
TEST_F(ParameterPlausible, NoStopIsShorterThanAnyMachines) {
  EXPECT_EQ(with(shortest_stops), SK_RULE_NONE);
  for (int j = 0; j < SK_JOINTS; ++j)
    for (int k = 1; k < BERM_BRAKE_SPEEDS; ++k) {
      SCOPED_TRACE(testing::Message() << "joint " << j << " column " << k);
      EXPECT_EQ(with([j, k](auto& p) { shortest_stops(p), p.brake_angle_urad[j][0][k] -= 1; }), SK_RULE_STOP_ANGLE);
      EXPECT_EQ(with([j, k](auto& p) { shortest_stops(p), p.brake_time_us[j][0][k] -= 1; }), SK_RULE_STOP_TIME);
    }
}

// At the largest and least speeds and accelerations that pass, where products are largest, and where they are least a stop still takes a way and a time.
// verifies: SK-PC-96, SK-PC-97, SK-PC-101
TEST_F(ParameterPlausible, NoStopIsShorterThanAnyMachinesAtTheEndsOfTheRanges) {
  for (const std::int32_t velocity : {1000, 4'000'000})
    for (const std::int32_t acceleration : {1'500'000, 50'000'000}) {
      const auto ends = [&](auto& p) {
        for (int j = 0; j < SK_JOINTS; ++j) p.velocity_max_urad_s[j] = velocity, p.acceleration_max_urad_s2[j] = acceleration, p.creep_velocity_urad_s[j] = 0;
        p.dig_swing_limit_urad_s = 0;
        shortest_stops(p);
      };
      SCOPED_TRACE(testing::Message() << velocity << ", " << acceleration);
      EXPECT_EQ(with(ends), SK_RULE_NONE);
      const auto lowered = [&](auto& p) {
        ends(p);
        for (auto& row : p.brake_angle_urad[3]) row[1] -= 1;
      };
      EXPECT_EQ(with(lowered), SK_RULE_STOP_ANGLE);
    }
  // 2 pi and 30 s are more than any stop, and fit
  EXPECT_EQ(with([](auto& p) {
              for (int j = 0; j < SK_JOINTS; ++j) {
                p.acceleration_max_urad_s2[j] = 50'000'000;
                for (auto& row : p.brake_angle_urad[j]) for (int k = 1; k < BERM_BRAKE_SPEEDS; ++k) row[k] = 6'283'186;
                for (auto& row : p.brake_time_us[j]) for (int k = 1; k < BERM_BRAKE_SPEEDS; ++k) row[k] = 30'000'000;
              }
            }),
            SK_RULE_NONE);
}

// verifies: SK-PC-96, SK-PC-97
TEST_F(ParameterPlausible, AMachineThatDoesNotBrakeIsRefused) {
  for (int j = 0; j < SK_JOINTS; ++j)
    for (const std::int32_t all : {0, 1}) {
      const auto angles = [j, all](auto& p) {
        for (auto& row : p.brake_angle_urad[j]) for (std::int32_t& entry : row) entry = all;
      };
      const auto times = [j, all](auto& p) {
        for (auto& row : p.brake_time_us[j]) for (std::int32_t& entry : row) entry = all;
      };
      EXPECT_EQ(with(angles), SK_RULE_STOP_ANGLE);
      EXPECT_EQ(with(times), SK_RULE_STOP_TIME);
    }
  EXPECT_EQ(with([](auto& p) { p.acceleration_max_urad_s2[0] = 1000; }), SK_RULE_STOP_ANGLE) << "what brakes so can be sped up so";
}

}  // namespace
}  // namespace berm::core_test
