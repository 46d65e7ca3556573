// Joints that brake by the table, and a fifth worse, against the supervision. A failure prints its seed (RC_PARAMS="seed=..." repeats it).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "contract/berm_contract.h"
#include "core/motion_supervision.h"
#include "draw.hpp"
#include "reach_parameters.hpp"
#include "supervised_machine.hpp"

namespace berm::core_test {
namespace {

constexpr int kJoint = 1, kRow = 2;

// One joint whose table is that of a constant deceleration.
struct Trial {
  berm_parameters p = reach_parameters();
  SupervisedMachine::Make make{};
  std::int64_t frame_gap_us = 10'000;

  double column_speed(int column) const { return std::floor(p.velocity_max_urad_s[kJoint] * column / 7.0); }
};

Trial random_trial() {
  Trial t;
  berm_parameters& p = t.p;
  p.cycle_us = 10'000;
  p.state_latency_us = 1'000 * draw(0, 40);
  p.command_latency_us = 1'000 * draw(10, 150);
  p.velocity_max_urad_s[kJoint] = draw(100'000, 1'500'000);
  p.velocity_error_urad_s[kJoint] = draw(0, 8'000);
  p.angle_error_urad[kJoint] = draw(0, 4'000);
  p.acceleration_max_urad_s2[kJoint] = draw(200'000, 5'000'000);
  p.standstill_urad_s = draw(1, 20'000);
  t.frame_gap_us = chance(50) ? 10'000 : 20'000;
  t.make.deceleration = draw(200'000, 5'000'000);
  t.make.acceleration = p.acceleration_max_urad_s2[kJoint] * draw(20, 100) / 100.0;
  t.make.angle_error = p.angle_error_urad[kJoint];
  t.make.velocity_error = p.velocity_error_urad_s[kJoint];
  t.make.dead_time_us = 1'000 * draw(0, p.command_latency_us / 1'000);
  for (int column = 0; column < BERM_BRAKE_SPEEDS; ++column) {
    const double v = t.column_speed(column);
    p.brake_angle_urad[kJoint][kRow][column] = static_cast<std::int32_t>(std::ceil(v * v / (2.0 * t.make.deceleration)));
    p.brake_time_us[kJoint][kRow][column] = static_cast<std::int32_t>(std::ceil(v / t.make.deceleration * 1e6));
  }
  return t;
}

// The kernel's side: commands sent, those under way, and the supervision of each reading.
class Watch {
 public:
  explicit Watch(const Trial& trial, bool oldest = false) : trial_(trial), oldest_(oldest) { sk_motion_begin(&state_); }

  void send(std::int64_t now_us, std::int32_t velocity) { sent_.push_back({now_us, velocity}); }
  // All sent within the window and the one in force when it began.
  void under_way(std::int64_t now_us, std::int32_t& low, std::int32_t& high) const {
    const std::int64_t window_us = std::int64_t{trial_.p.command_latency_us} + trial_.p.state_latency_us + trial_.p.cycle_us;
    low = high = sent_.empty() ? 0 : sent_.back().velocity;
    for (std::size_t k = sent_.size(); k-- > 0;) {
      low = std::min(low, sent_[k].velocity);
      high = std::max(high, sent_[k].velocity);
      if (sent_[k].us + window_us <= now_us) break;
    }
  }
  struct Reading { std::int32_t angle, velocity; };
  Reading read(const SupervisedMachine& machine) {
    age_us_ = oldest_ ? trial_.p.state_latency_us : 1'000 * draw<std::int64_t>(0, std::min(age_us_ + trial_.frame_gap_us, std::int64_t{trial_.p.state_latency_us}) / 1'000);  // in order
    const auto state = machine.before(age_us_);
    const auto error = [](double most) { return chance(20) ? (chance(50) ? most : -most) : most * draw(-1'000, 1'000) / 1'000.0; };
    const double limit = trial_.p.velocity_max_urad_s[kJoint] + trial_.make.velocity_error;
    return {static_cast<std::int32_t>(state.angle + error(trial_.make.angle_error)),
            static_cast<std::int32_t>(std::clamp(state.speed + error(trial_.make.velocity_error), -limit, limit))};
  }
  std::int32_t judge(std::int64_t now_us, const Reading& r) {
    std::int32_t low, high;
    under_way(now_us, low, high);
    const sk_motion_reading reading = {now_us, kJoint, kRow, r.angle, r.velocity, high};
    return sk_motion_step(&state_, &trial_.p, reading, low);
  }

 private:
  struct Sent { std::int64_t us; std::int32_t velocity; };
  const Trial& trial_;
  const bool oldest_;  // every reading as old as it may be
  sk_motion_joint state_{};
  std::vector<Sent> sent_;
  std::int64_t age_us_ = 0;
};

// verifies: SK-MS-10
TEST(MotionSupervisionProperty, AJointThatBrakesByTheTableNeverAlarms) {
  int readings = 0, stops = 0;
  const bool passed = rc::check([&] {
    const Trial t = random_trial();
    SupervisedMachine machine(t.make, draw(-2'000'000, 2'000'000), 0.0);
    Watch watch(t);
    const std::int32_t most = t.p.velocity_max_urad_s[kJoint] - t.p.velocity_error_urad_s[kJoint];
    std::int32_t command = 0;
    std::int64_t change_us = 300'000;
    double follow_error = 0.0;
    for (std::int64_t now = 10'000; now < 6'000'000; now += 10'000) {
      machine.run_to(now, follow_error);
      if (now % t.frame_gap_us == 0) {
        const auto reading = watch.read(machine);
        if (std::abs(reading.angle) > SK_REACH_ANGLE_MAX_URAD - 100'000) break;
        const std::int32_t result = watch.judge(now, reading);
        ++readings;
        if (result != BERM_STOP_NONE) RC_LOG() << "at " << now << " us: " << result << ", true speed " << machine.speed();
        RC_ASSERT(result == BERM_STOP_NONE);
      }
      if (now >= change_us) {
        if (command != 0 && chance(60)) {
          command = 0;
          ++stops;
        } else {
          command = draw(-most, most);
        }
        follow_error = draw(-100, 100) / 100.0;
        change_us = now + 10'000 * draw(1, 150);
      }
      watch.send(now, command);
      machine.command(command);
    }
  });
  EXPECT_TRUE(passed);
  std::cout << readings << " readings, " << stops << " commands to stop, no alarm\n";
  EXPECT_GT(readings, 10'000);
}

// A joint at a column's speed that needs a fifth more than the table's angle to stop. With every latency at its bound it must alarm; with shorter
// ones it has begun to brake before the table's angle is counted, and either alarms or stops near the box.
// verifies: SK-MS-11
TEST(MotionSupervisionProperty, AFifthWorseAlarmsBeforeItIsFarOutOfTheCertifiedBox) {
  double farthest = -1e9, farthest_share = -1e9;
  int at_bounds = 0, trials = 0, alarms = 0;
  const bool passed = rc::check([&] {
    Trial t = random_trial();
    const bool bounds = chance(50);
    const int column = draw(1, 7);
    const std::int32_t table = t.p.brake_angle_urad[kJoint][kRow][column];
    const double error = t.make.velocity_error, speed = t.column_speed(column) - 2.0 * error - 1.0;  // a reading and its error stay in the column
    const double gap_way = speed * static_cast<double>(t.frame_gap_us + t.p.cycle_us) * 1e-6;          // braked before the first reading that counts
    // A fifth that is less than what errors and readings hide cannot be seen.
    RC_PRE(speed - gap_way > t.column_speed(column - 1) && 0.2 * table > 4.0 * t.make.angle_error + gap_way + 1'000.0);
    RC_PRE(speed * 2.0 + 2.0 * table < 9'000'000.0);
    t.make.deceleration = speed * speed / (2.0 * 1.2 * table);
    if (bounds) t.make.dead_time_us = t.p.command_latency_us;
    SupervisedMachine machine(t.make, 0.0, speed);
    Watch watch(t, bounds);
    const auto command = static_cast<std::int32_t>(speed);
    watch.send(0, command);
    sk_reach_box box{};
    const std::int64_t stop_us = 1'000'000;
    std::int64_t rest_us = 0;
    std::int32_t result = BERM_STOP_NONE;
    for (std::int64_t now = 10'000; result == BERM_STOP_NONE && rest_us < 1'000'000; now += 10'000) {
      machine.run_to(now, 0.0);
      if (machine.speed() == 0.0) rest_us += 10'000;
      if (now % t.frame_gap_us == 0) {
        const auto reading = watch.read(machine);
        result = watch.judge(now, reading);
        if (now < stop_us) {  // certified with this command; after the last of these the stop is sent
          std::int32_t low = 0, high = 0;
          watch.under_way(now, low, high);
          RC_ASSERT(sk_reach_joint(&t.p, kJoint, kRow, reading.angle, reading.velocity, SK_REACH_COMMANDED, std::min(low, 0), std::max(high, command), &box));
          RC_ASSERT(result == BERM_STOP_NONE);
        }
      }
      const std::int32_t next = now < stop_us ? command : 0;
      watch.send(now, next);
      machine.command(next);
    }
    ++trials;
    if (bounds) {
      ++at_bounds;
      RC_ASSERT(result == BERM_STOP_BRAKING);
    }
    RC_ASSERT(result == BERM_STOP_BRAKING || result == BERM_STOP_NONE);
    alarms += result == BERM_STOP_BRAKING ? 1 : 0;
    // Stated: four angle errors, and the way of three gaps between readings and of a reading's age, at the alarm; without one, when it stands.
    // (The certified box and the first reading that counts are a gap early and late each, the reading that shows it another.)
    const double out = machine.angle() - box.high_urad[kJoint];
    const double stated = 4.0 * t.make.angle_error + speed * static_cast<double>(3 * t.frame_gap_us + t.p.state_latency_us) * 1e-6 + 2.0;
    farthest = std::max(farthest, out);
    farthest_share = std::max(farthest_share, out / stated);
    RC_ASSERT(out <= stated);
  });
  EXPECT_TRUE(passed);
  std::cout << trials << " stops a fifth too long, " << at_bounds << " with every latency at its bound; " << alarms << " alarms; at most "
            << farthest * 1e-6 * 180.0 / 3.14159265358979 << " deg out of the certified box, " << farthest_share * 100.0 << " % of what is stated\n";
  EXPECT_GE(at_bounds, 20);
}

}  // namespace
}  // namespace berm::core_test
