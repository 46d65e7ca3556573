// Scalar fields and small arrays: each pushed just beyond each of its limits, and set exactly to it.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/parameter_check.h"
#include "valid_parameters.hpp"

namespace berm::core_test {
namespace {

using Field = std::function<std::int32_t&(berm_parameters&)>;

struct Limit {
  const char* name;
  std::int32_t rule;
  std::int32_t low, high;
  Field field;
};

#define FIELD(f) #f, [](berm_parameters & p) -> std::int32_t& { return p.f; }

Limit limit(std::int32_t rule, std::int32_t low, std::int32_t high, const char* name, Field field) { return {name, rule, low, high, std::move(field)}; }

std::vector<Limit> limits(const berm_parameters& ok) {
  std::vector<Limit> all = {
      limit(SK_RULE_MAGIC, BERM_PARAMETERS_MAGIC, BERM_PARAMETERS_MAGIC, FIELD(magic)),
      limit(SK_RULE_VERSION, BERM_PARAMETERS_VERSION, BERM_PARAMETERS_VERSION, FIELD(version)),
      limit(SK_RULE_SIZE, sizeof(berm_parameters), sizeof(berm_parameters), FIELD(size)),
      limit(SK_RULE_CELL, SK_CELL_MM, SK_CELL_MM, FIELD(cell_mm)),
      limit(SK_RULE_BOOM_PIN_X, -3000, 3000, FIELD(boom_pin_x_mm)),
      limit(SK_RULE_BOOM_PIN_Z, 0, 5000, FIELD(boom_pin_z_mm)),
      limit(SK_RULE_BOOM_LENGTH, 1000, 12000, FIELD(boom_length_mm)),
      limit(SK_RULE_STICK_LENGTH, 500, 8000, FIELD(stick_length_mm)),
      limit(SK_RULE_BUCKET_LENGTH, 300, 4000, FIELD(bucket_length_mm)),
      limit(SK_RULE_OWN_BODY_RADIUS, 500, 6000, FIELD(own_body_radius_mm)),
      limit(SK_RULE_STATE_LATENCY, 1000, 500000, FIELD(state_latency_us)),
      limit(SK_RULE_COMMAND_LATENCY, 1000, 1000000, FIELD(command_latency_us)),
      limit(SK_RULE_PART_COUNT, 1, BERM_PARTS, FIELD(parts)),
      limit(SK_RULE_SCANNER_SILENT, 1000, 5000000, FIELD(scanner_silent_us)),
      limit(SK_RULE_SPURIOUS_RANGE, 1, 100000, FIELD(spurious_range_mm)),
      limit(SK_RULE_RANGE_LIMITS, 0, ok.range_max_mm - 1, FIELD(range_min_mm)),
      limit(SK_RULE_RANGE_LIMITS, ok.range_min_mm + 1, 262140, FIELD(range_max_mm)),
      limit(SK_RULE_SELF_MARGIN, 0, 2000, FIELD(self_margin_mm)),
      limit(SK_RULE_MARGIN, 100, 3000, FIELD(margin_mm)),
      limit(SK_RULE_FRESH, 1, 600000000, FIELD(fresh_us)),
      limit(SK_RULE_GENERATION, 1, ok.fresh_us, FIELD(generation_us)),
      limit(SK_RULE_DIG_SWING_LIMIT, 0, 261799, FIELD(dig_swing_limit_urad_s)),
      limit(SK_RULE_DIG_ZONE_COUNT, 0, BERM_DIG_ZONES, FIELD(dig_zones)),
      limit(SK_RULE_REQUEST_AGE, 1, 500000, FIELD(request_age_us)),
      limit(SK_RULE_REQUEST_HOLD, 1, 50000, FIELD(request_hold_us)),
      limit(SK_RULE_REQUEST_SILENT, ok.request_hold_us, 500000, FIELD(request_silent_us)),
      limit(SK_RULE_STATE_FRAME_AGE, 1, 500000, FIELD(state_frame_age_us)),
      limit(SK_RULE_MACHINE_STATE_AGE, 1, 1000000, FIELD(machine_state_age_us)),
      limit(SK_RULE_OPERATOR_AGE, 1, 1000000, FIELD(operator_age_us)),
      limit(SK_RULE_CYCLE, 1000, 20000, FIELD(cycle_us)),
      limit(SK_RULE_STANDSTILL_SPEED, 1, 100000, FIELD(standstill_urad_s)),
      limit(SK_RULE_STANDSTILL_TIME, 1, 2000000, FIELD(standstill_us)),
      limit(SK_RULE_BASE_TILT, 1000, 35000, FIELD(base_tilt_urad)),
      limit(SK_RULE_BASE_TILT_HARD, ok.base_tilt_urad, 90000, FIELD(base_tilt_hard_urad)),
      limit(SK_RULE_BASE_AZIMUTH, 1000, 35000, FIELD(base_azimuth_urad)),
      limit(SK_RULE_BASE_FRAME_AGE, 1, 1000000, FIELD(base_frame_age_us)),
      limit(SK_RULE_PASS_OVER, -20000, 20000, FIELD(pass_over_mm)),
      limit(SK_RULE_GROUND_ZONE_COUNT, 0, BERM_GROUND_ZONES, FIELD(ground_zones)),
      limit(SK_RULE_TRUCK_ZONE_COUNT, 0, BERM_TRUCK_ZONES, FIELD(truck_zones)),
      limit(SK_RULE_TAIL_WATCHED, 0, 1, FIELD(tail_watched)),
      limit(SK_RULE_TAIL_RADIUS, 500, ok.own_body_radius_mm, FIELD(tail_radius_mm)),
      limit(SK_RULE_TAIL_WIDTH, 100, ok.tail_radius_mm, FIELD(tail_half_width_mm)),
      limit(SK_RULE_TAIL_HEIGHTS, 0, ok.tail_high_mm - 1, FIELD(tail_low_mm)),
      limit(SK_RULE_TAIL_HEIGHTS, ok.tail_low_mm + 1, 10000, FIELD(tail_high_mm)),
      limit(SK_RULE_TAIL_CLEARANCE, 500, 3000, FIELD(tail_clearance_mm)),
      limit(SK_RULE_TAIL_FRESH, 1, ok.fresh_us, FIELD(tail_fresh_us)),
      limit(SK_RULE_LIDAR_COUNT, 0, BERM_LIDARS, FIELD(lidars)),
      limit(SK_RULE_WORKSPACE_WATCHED, 0, 1, FIELD(workspace_watched)),
      limit(SK_RULE_WORKSPACE_RADIUS, ok.own_body_radius_mm, 15000, FIELD(workspace_radius_mm)),
      limit(SK_RULE_WORKSPACE_HEIGHTS, 100, 2000, FIELD(workspace_rise_mm)),
      limit(SK_RULE_WORKSPACE_HEIGHTS, 100, 2000, FIELD(workspace_neighbour_mm)),
      limit(SK_RULE_WORKSPACE_HEIGHTS, 100, 5000, FIELD(workspace_slope_mm)),
      limit(SK_RULE_WORKSPACE_TIMES, 0, 10000000, FIELD(workspace_wait_us)),
      limit(SK_RULE_WORKSPACE_TIMES, 1, 1000000, FIELD(workspace_period_us)),
      limit(SK_RULE_WORKSPACE_TIMES, 0, 60000000, FIELD(workspace_dwell_us)),
      limit(SK_RULE_WORKSPACE_TIMES, 0, 120000000, FIELD(workspace_learn_us)),
      limit(SK_RULE_WORKSPACE_FOREIGN, 0, 100, FIELD(workspace_foreign)),
      limit(SK_RULE_WORKSPACE_LIDAR_TIMES, 0, 10000000, FIELD(workspace_lidar_wait_us)),
      limit(SK_RULE_WORKSPACE_LIDAR_TIMES, 1, 1000000, FIELD(workspace_lidar_period_us)),
      limit(SK_RULE_WORKSPACE_FOLLOWS, 0, 1, FIELD(workspace_follows)),
      limit(SK_RULE_WORKSPACE_HISTOGRAM, 0, 1, FIELD(workspace_histogram)),
      limit(SK_RULE_LEARN_SPEED, 50, 1000, FIELD(workspace_learn_speed_permille)),
      limit(SK_RULE_SEPARATION_MODE, 0, 2, FIELD(workspace_separation)),
      limit(SK_RULE_SEPARATION_APPROACH, 500, 5000, FIELD(workspace_approach_mm_s)),
      limit(SK_RULE_SEPARATION_INTRUSION, 0, 3000, FIELD(workspace_intrusion_mm)),
      limit(SK_RULE_LANE_COUNT, 0, BERM_LANES, FIELD(lanes)),
      limit(SK_RULE_SIGHT_BLIND, 50, 1000, FIELD(sight_blind_permille)),
      limit(SK_RULE_DUST_SLOW, 1, ok.dust_stop_permille, FIELD(dust_slow_permille)),
      limit(SK_RULE_DUST_STOP, ok.dust_slow_permille, 1000, FIELD(dust_stop_permille)),
      limit(SK_RULE_DUST_SPEED, 50, 1000, FIELD(dust_speed_permille)),
      limit(SK_RULE_DUST_DWELL, 0, 60000000, FIELD(dust_dwell_us)),
  };
  for (int j = 0; j < 4; ++j) {
    const std::int32_t bound = j == 0 ? 6283186 : 3141593;
    const auto add = [&](std::int32_t rule, std::int32_t low, std::int32_t high, const char* name, std::int32_t (berm_parameters::*array)[4]) {
      all.push_back(limit(rule, low, high, name, [array, j](berm_parameters& p) -> std::int32_t& { return (p.*array)[j]; }));
    };
    add(SK_RULE_JOINT_RANGE, -bound, ok.joint_high_urad[j] - 1, "joint_low_urad", &berm_parameters::joint_low_urad);
    add(SK_RULE_JOINT_RANGE, ok.joint_low_urad[j] + 1, bound, "joint_high_urad", &berm_parameters::joint_high_urad);
    add(SK_RULE_VELOCITY_MAX, 1000, 4000000, "velocity_max_urad_s", &berm_parameters::velocity_max_urad_s);
    add(SK_RULE_ACCELERATION_MAX, 1000, 50000000, "acceleration_max_urad_s2", &berm_parameters::acceleration_max_urad_s2);
    add(SK_RULE_CREEP_VELOCITY, 0, 261799, "creep_velocity_urad_s", &berm_parameters::creep_velocity_urad_s);
    add(SK_RULE_ANGLE_ERROR, 200, 100000, "angle_error_urad", &berm_parameters::angle_error_urad);
    add(SK_RULE_VELOCITY_ERROR, 100, 200000, "velocity_error_urad_s", &berm_parameters::velocity_error_urad_s);
  }
  for (int i = 0; i < BERM_SCANNER_MOUNTS; ++i) {
    const auto add = [&](std::int32_t rule, std::int32_t low, std::int32_t high, const char* name, std::int32_t berm_scanner_mount::*member) {
      all.push_back(limit(rule, low, high, name, [member, i](berm_parameters& p) -> std::int32_t& { return p.scanner[i].*member; }));
    };
    add(SK_RULE_SCANNER_POSITION, -5000, 5000, "scanner x_mm", &berm_scanner_mount::x_mm);
    add(SK_RULE_SCANNER_POSITION, -5000, 5000, "scanner y_mm", &berm_scanner_mount::y_mm);
    add(SK_RULE_SCANNER_POSITION, 0, 8000, "scanner z_mm", &berm_scanner_mount::z_mm);
    add(SK_RULE_SCANNER_PAN, -3141593, ok.scanner[i].pan_high_urad - 1, "scanner pan_low_urad", &berm_scanner_mount::pan_low_urad);
    add(SK_RULE_SCANNER_PAN, ok.scanner[i].pan_low_urad + 1, 3141593, "scanner pan_high_urad", &berm_scanner_mount::pan_high_urad);
    add(SK_RULE_SCANNER_PAN_RATE, 1, 10000000, "scanner pan_rate_max_urad_s", &berm_scanner_mount::pan_rate_max_urad_s);
  }
  return all;
}

#undef FIELD

// verifies: SK-PC-100
TEST(ParameterCheck, AcceptsTheDemonstrationMachine) {
  const berm_parameters p = valid_parameters();
  EXPECT_EQ(sk_parameters_check(&p), SK_RULE_NONE);
}

// verifies: SK-PC-1, SK-PC-2, SK-PC-3, SK-PC-4, SK-PC-5, SK-PC-6, SK-PC-7, SK-PC-8, SK-PC-9, SK-PC-11, SK-PC-12, SK-PC-13, SK-PC-14, SK-PC-15
// verifies: SK-PC-16, SK-PC-17, SK-PC-18, SK-PC-19, SK-PC-28, SK-PC-35, SK-PC-36, SK-PC-37, SK-PC-38, SK-PC-39, SK-PC-40, SK-PC-41, SK-PC-42
// verifies: SK-PC-43, SK-PC-44, SK-PC-45, SK-PC-46, SK-PC-49, SK-PC-50, SK-PC-51, SK-PC-52, SK-PC-53, SK-PC-54, SK-PC-55, SK-PC-56, SK-PC-57
// verifies: SK-PC-58, SK-PC-59, SK-PC-60, SK-PC-61, SK-PC-62, SK-PC-63, SK-PC-66
// verifies: SK-PC-69, SK-PC-70, SK-PC-71, SK-PC-72, SK-PC-73, SK-PC-74, SK-PC-75
// verifies: SK-PC-78, SK-PC-79, SK-PC-80, SK-PC-81, SK-PC-82, SK-PC-83, SK-PC-84, SK-PC-86, SK-PC-87, SK-PC-88, SK-PC-89
// verifies: SK-PC-90, SK-PC-91, SK-PC-92, SK-PC-93, SK-PC-94, SK-PC-95, SK-PC-98, SK-PC-101
TEST(ParameterCheck, EachFieldBeyondEachLimit) {
  berm_parameters ok = valid_parameters();
  ok.dust_stop_permille = 1000;  // so that what is above it is above the other's limit too
  for (const Limit& l : limits(ok)) {
    const std::int64_t beyond[] = {std::int64_t{l.low} - 1, std::int64_t{l.high} + 1, std::numeric_limits<std::int32_t>::min(),
                                   std::numeric_limits<std::int32_t>::max()};
    for (const std::int64_t v : beyond) {
      berm_parameters p = ok;
      l.field(p) = static_cast<std::int32_t>(v);
      const berm_parameters was = p;
      EXPECT_EQ(sk_parameters_check(&p), l.rule) << l.name << " = " << v;
      EXPECT_EQ(std::memcmp(&p, &was, sizeof p), 0);
    }
    for (const std::int32_t v : {l.low, l.high}) {
      berm_parameters p = ok;
      l.field(p) = v;
      EXPECT_NE(sk_parameters_check(&p), l.rule) << l.name << " = " << v << " is still allowed";
    }
  }
}

// verifies: SK-PC-10
TEST(ParameterCheck, TotalReach) {
  berm_parameters p = valid_parameters();
  p.brake_reach_mm[BERM_BRAKE_REACHES - 1] = SK_COORD_MAX_MM;
  const std::int32_t others = p.boom_pin_x_mm + p.stick_length_mm + p.bucket_length_mm;
  p.boom_length_mm = 15000 - others;
  EXPECT_EQ(sk_parameters_check(&p), SK_RULE_NONE);
  p.boom_length_mm += 1;
  EXPECT_EQ(sk_parameters_check(&p), SK_RULE_TOTAL_REACH);
}

// verifies: SK-PC-76, SK-PC-77
TEST(ParameterCheck, EachLidarBeyondEachLimit) {
  const berm_parameters ok = valid_parameters();
  const struct {
    std::int32_t berm_lidar_mount::*member;
    std::int32_t low, high, rule;
  } fields[] = {{&berm_lidar_mount::x_mm, -5000, 5000, SK_RULE_LIDAR_POSITION},           {&berm_lidar_mount::y_mm, -5000, 5000, SK_RULE_LIDAR_POSITION},
                {&berm_lidar_mount::z_mm, 0, 8000, SK_RULE_LIDAR_POSITION},               {&berm_lidar_mount::roll_urad, -3141593, 3141593, SK_RULE_LIDAR_ANGLES},
                {&berm_lidar_mount::pitch_urad, -3141593, 3141593, SK_RULE_LIDAR_ANGLES}, {&berm_lidar_mount::yaw_urad, -3141593, 3141593, SK_RULE_LIDAR_ANGLES}};
  for (int i = 0; i < BERM_LIDARS; ++i)
    for (const auto& f : fields) {
      const auto with = [&](std::int32_t v, std::int32_t lidars) {
        berm_parameters p = ok;
        p.lidars = lidars;
        p.lidar[i].*f.member = v;
        return sk_parameters_check(&p);
      };
      for (const std::int32_t v : {f.low - 1, f.high + 1, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()}) {
        EXPECT_EQ(with(v, BERM_LIDARS), f.rule) << "lidar " << i << ": " << v;
        EXPECT_EQ(with(v, i), SK_RULE_NONE) << "one that is not counted is not looked at";
      }
      for (const std::int32_t v : {f.low, f.high}) EXPECT_EQ(with(v, BERM_LIDARS), SK_RULE_NONE) << "lidar " << i << ": " << v;
    }
}

// verifies: SK-PC-85
TEST(ParameterCheck, EachLaneBeyondEachLimit) {
  const berm_parameters ok = valid_parameters();
  for (int i = 0; i < BERM_LANES; ++i) {
    const auto with = [&](berm_lane lane, std::int32_t lanes) {
      berm_parameters p = ok;
      p.lanes = lanes;
      for (berm_lane& l : p.lane) l = {-15000, -15000, 15000, 15000};
      p.lane[i] = lane;
      return sk_parameters_check(&p);
    };
    EXPECT_EQ(with({-15000, -15000, 15000, 15000}, BERM_LANES), SK_RULE_NONE);
    EXPECT_EQ(with({0, 0, 1, 1}, BERM_LANES), SK_RULE_NONE);
    constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min(), kHigh = std::numeric_limits<std::int32_t>::max();
    for (const berm_lane bad : {berm_lane{0, 0, 0, 1}, berm_lane{0, 0, 1, 0}, berm_lane{1, 0, 0, 1}, berm_lane{-15001, 0, 1, 1}, berm_lane{0, -15001, 1, 1},
                                berm_lane{0, 0, 15001, 1}, berm_lane{0, 0, 1, 15001}, berm_lane{kLow, kLow, kHigh, kHigh}}) {
      EXPECT_EQ(with(bad, BERM_LANES), SK_RULE_LANE_BOUNDS) << "lane " << i;
      EXPECT_EQ(with(bad, i), SK_RULE_NONE) << "one that is not counted is not looked at";
    }
  }
}

// Two rules broken in different places: the one that stands first is returned.
// verifies: SK-PC-100
TEST(ParameterCheck, TheFirstRuleBrokenIsReturned) {
  const berm_parameters ok = valid_parameters();
  const std::vector<Limit> all = limits(ok);
  for (const Limit& a : all) {
    for (const Limit& b : all) {
      if (a.rule >= b.rule) continue;
      berm_parameters p = ok;
      b.field(p) = std::numeric_limits<std::int32_t>::min();
      a.field(p) = std::numeric_limits<std::int32_t>::min();
      ASSERT_EQ(sk_parameters_check(&p), a.rule) << a.name << " and " << b.name;
    }
  }
}

}  // namespace
}  // namespace berm::core_test
