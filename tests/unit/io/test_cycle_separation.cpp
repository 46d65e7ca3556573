// ISO 13855's distance in the kernel's cycle: a direction that is not seen slows the machine and then denies motion; what is only reported changes
// nothing; and no command goes out from which the machine would stand too late.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "cycle_rig.hpp"
#include "geometry/reach.hpp"

namespace berm::kernel::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A region, a speed of approach and a monitor with which panning scanners that look all round hold the distance.
berm_parameters watched(std::int32_t mode) {
  berm_parameters p = berm::test::demo_parameters();
  p.workspace_watched = 1;
  p.truck_zones = p.lanes = 0;
  p.workspace_radius_mm = 15'000;
  p.workspace_wait_us = 200'000;
  p.workspace_period_us = 100'000;
  p.workspace_separation = mode;
  p.workspace_approach_mm_s = 500;
  p.workspace_intrusion_mm = 200;
  return p;
}

// The scanners' lines go round the front and the back.
void look_all_round(CycleRig& rig) {
  rig.machine.pan_low_rad = -1.6;
  rig.machine.pan_high_rad = 1.6;
}

void look_ahead_only(CycleRig& rig) {
  rig.machine.pan_low_rad = -0.25;
  rig.machine.pan_high_rad = 0.25;
}

std::string why(const CycleRig& rig) {
  return "reason " + std::to_string(rig.state().stop_reason) + ", left " + std::to_string(rig.state().separation_stop_ms) + " ms at " +
         std::to_string(rig.state().separation_bearing_deg) + " deg";
}

std::int32_t largest(const std::int32_t (&v)[4]) {
  std::int32_t most = 0;
  for (const std::int32_t one : v) most = std::max(most, std::abs(one));
  return most;
}

bool run(CycleRig& rig) {
  look_all_round(rig);
  if (!rig.reach_state(BERM_STATE_RUN, 4000)) return false;
  rig.steps(2000);
  return rig.state().kernel_state == BERM_STATE_RUN;
}

// To and fro.
void swing(CycleRig& rig, int n) { rig.wanted_urad_s[0] = n / 150 % 2 == 0 ? 400'000 : -400'000; }

// verifies: SK-SD-13, SK-SD-14, SK-SD-15, SK-SD-16, IF-CF-19 (enforced, a machine that does not see all round stands)
TEST(CycleSeparation, WhatIsNotSeenSlowsTheMachineThenDeniesMotionUntilItIsSeen) {
  CycleRig rig(watched(BERM_SEPARATION_ENFORCED));
  ASSERT_TRUE(run(rig)) << why(rig);
  ASSERT_GE(rig.state().separation_bearing_deg, 0);
  ASSERT_GT(rig.state().separation_stop_ms, 5000) << why(rig);
  std::int32_t free_urad_s = 0, slowed_urad_s = 1'000'000;
  for (int n = 0; n < 600; ++n) {
    swing(rig, n);
    rig.step();
    ASSERT_EQ(rig.state().kernel_state, BERM_STATE_RUN) << why(rig);
    free_urad_s = std::max(free_urad_s, std::abs(rig.state().commanded_urad_s[0]));
  }
  EXPECT_EQ(free_urad_s, 400'000);
  look_ahead_only(rig);
  int denied = 0;
  bool slowed = false;
  for (int n = 0; n < 3000 && denied == 0; ++n) {
    swing(rig, n);
    rig.step();
    const std::int32_t sent = std::abs(rig.state().commanded_urad_s[0]);
    if (rig.state().kernel_state == BERM_STATE_RUN && sent > 0) {
      slowed = slowed || sent < 200'000;
      slowed_urad_s = std::min(slowed_urad_s, sent);
    }
    if (rig.state().kernel_state != BERM_STATE_RUN) denied = n;
  }
  std::printf("from 400 mrad/s down to %d mrad/s before motion is denied after %d cycles\n", slowed_urad_s / 1000, denied);
  EXPECT_TRUE(slowed) << "it was stopped from full speed";
  ASSERT_GT(denied, 0);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_SEPARATION) << why(rig);
  EXPECT_EQ(rig.state().stop_category, 2);
  rig.wanted_urad_s[0] = 0;
  rig.steps(1500);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_SEPARATION) << "standing, it says why it stands";
  EXPECT_EQ(rig.state().separation_stop_ms, -1);
  for (std::int32_t& wanted : rig.wanted_urad_s) wanted = 20'000;  // not even creeping
  for (int n = 0; n < 300; ++n) {
    rig.step();
    ASSERT_EQ(largest(rig.state().commanded_urad_s), 0) << why(rig);
  }
  std::fill(rig.wanted_urad_s, rig.wanted_urad_s + 4, 0);
  look_all_round(rig);
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, 3000)) << "by itself: " << why(rig);
  for (int n = 0; n < 300; ++n) {
    swing(rig, n);
    rig.step();
  }
  EXPECT_GT(std::abs(rig.machine.velocity_rad_s[0]), 0.05) << why(rig);
}

// The joint that stands sooner is permitted where that which takes longer is not.
// verifies: SK-SD-13
TEST(CycleSeparation, EachJointHasItsOwnLevel) {
  CycleRig rig(watched(BERM_SEPARATION_ENFORCED));
  ASSERT_TRUE(run(rig)) << why(rig);
  look_ahead_only(rig);
  int both = 0, bucket_alone = 0, swing_alone = 0;
  for (int n = 0; n < 3000 && (rig.state().separation_stop_ms > 0 || n < 10); ++n) {
    const bool late = rig.state().separation_stop_ms < 1000;  // the swing is asked for anew while there is no time for it any more
    rig.wanted_urad_s[0] = late && rig.state().separation_stop_ms > 400 ? 0 : n / 20 % 2 == 0 ? 50'000 : -50'000;
    rig.wanted_urad_s[3] = n / 20 % 2 == 0 ? 50'000 : -50'000;
    rig.step();
    const bool swings = rig.state().commanded_urad_s[0] != 0, curls = rig.state().commanded_urad_s[3] != 0;
    both += swings && curls;
    bucket_alone += curls && rig.wanted_urad_s[0] != 0 && !swings && rig.state().permitted_high_urad_s[0] == 0;
    swing_alone += swings && !curls;
  }
  EXPECT_GT(both, 100) << why(rig);
  EXPECT_GT(bucket_alone, 10) << why(rig);
  EXPECT_EQ(swing_alone, 0) << why(rig);
}

// verifies: SK-SD-7, SK-SD-17
TEST(CycleSeparation, ReportedItChangesNothingThatGoesOut) {
  CycleRig plain(watched(BERM_SEPARATION_NONE)), reported(watched(BERM_SEPARATION_REPORTED));
  std::mt19937_64 random(3);
  bool would_deny = false, moved = false;
  for (int n = 0; n < 6000; ++n) {
    if (n == 0 || n == 4500) look_all_round(plain), look_all_round(reported);
    if (n == 3000) look_ahead_only(plain), look_ahead_only(reported);
    if (n % 60 == 0 && n > 1500)
      for (int j = 0; j < 4; ++j) plain.wanted_urad_s[j] = reported.wanted_urad_s[j] = static_cast<std::int32_t>(random() % 400'001) - 200'000;
    plain.step();
    reported.step();
    ASSERT_EQ(plain.out->frames.count, reported.out->frames.count);
    const std::size_t bytes = sizeof(berm_can_frame) * static_cast<std::size_t>(plain.out->frames.count);
    ASSERT_EQ(std::memcmp(plain.out->frames.frame, reported.out->frames.frame, bytes), 0) << n;
    ASSERT_EQ(std::memcmp(&plain.out->decision, &reported.out->decision, sizeof(berm_decision)), 0) << n;
    ASSERT_EQ(plain.state().separation_bearing_deg, -1);
    ASSERT_EQ(plain.state().separation_stop_ms, -1);
    ASSERT_GE(reported.state().separation_bearing_deg, n > 10 ? 0 : -1);
    would_deny = would_deny || (n > 3500 && reported.state().separation_stop_ms == -1 && reported.state().kernel_state == BERM_STATE_RUN);
    moved = moved || largest(reported.state().commanded_urad_s) > 0;
  }
  EXPECT_TRUE(moved) << why(reported);
  EXPECT_TRUE(would_deny) << "there must have been something to report: " << why(reported);
}

// verifies: SK-SD-7, IF-CF-19 (it says nothing where nobody watches)
TEST(CycleSeparation, UnwatchedItIsNotEvaluated) {
  berm_parameters p = watched(BERM_SEPARATION_ENFORCED);
  p.workspace_watched = 0;
  CycleRig rig(p);
  look_ahead_only(rig);
  rig.machine.pan_low_rad = -0.75;
  rig.machine.pan_high_rad = 0.75;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, 1500)) << why(rig);
  EXPECT_EQ(rig.state().separation_bearing_deg, -1);
  EXPECT_EQ(rig.state().separation_stop_ms, -1);
}

// Its own list of all looks, and S of every degree, from what is published alone.
class Onlooker {
 public:
  explicit Onlooker(const berm_parameters& p) : p_(p), looks_(360) {}
  void look(const ScanBlocks& blocks, std::int64_t now_us) {
    for (int b = 0; b < blocks.count; ++b)
      for (int i = 0; i < blocks.block[b].count; ++i) {
        if (blocks.block[b].used[i] == 0) continue;
        const double x = blocks.block[b].point_mm[i][0], y = blocks.block[b].point_mm[i][1], far = std::hypot(x, y);
        if (far < p_.workspace_radius_mm / 2.0 || far > p_.workspace_radius_mm * 1.25) continue;
        const double bearing = std::atan2(y, x) * 180 / kPi;
        // What lies on a border is left to either.
        for (const double edge : {-1e-3, 1e-3}) {
          auto& looks = looks_[static_cast<std::size_t>(std::fmod(bearing + edge + 720.0, 360.0))];
          if (looks.empty() || looks.back() != now_us) looks.push_back(now_us);
        }
      }
  }
  // T up to the order to stop, of the worst degree; beyond all bounds where one was never seen.
  double detected_s(std::int64_t now_us) const {
    const double told_s = (p_.workspace_wait_us + p_.workspace_period_us + 2 * p_.cycle_us) * 1e-6 + 0.14;
    double worst_s = 0.0;
    for (const auto& looks : looks_) {
      if (looks.empty()) return 1e9;
      double blind_s = static_cast<double>(now_us - looks.back()) * 1e-6;
      for (std::size_t i = looks.size(); i-- > 1 && static_cast<double>(now_us - looks[i]) * 1e-6 <= told_s;)
        blind_s = std::max(blind_s, static_cast<double>(looks[i] - looks[i - 1]) * 1e-6);
      worst_s = std::max(worst_s, blind_s);
    }
    return worst_s + told_s;
  }
  // From the order to standstill, of what is sent and measured; rows for the reach.
  double stands_s(const berm_state& s, double reach_mm) const {
    int row = 0;
    while (p_.brake_reach_mm[row] < reach_mm) ++row;
    double longest_s = 0.0;
    for (int j = 0; j < 4; ++j) {
      if (s.commanded_urad_s[j] == 0 && std::abs(s.joint_velocity_urad_s[j]) <= p_.standstill_urad_s) continue;
      const double speed = std::max(std::abs(s.commanded_urad_s[j]), std::abs(s.joint_velocity_urad_s[j]));
      int column = 0;
      while (column < 7 && p_.velocity_max_urad_s[j] * column / 7.0 < speed) ++column;
      longest_s = std::max(longest_s, (p_.cycle_us + p_.command_latency_us + p_.brake_time_us[j][row][column]) * 1e-6);
    }
    return longest_s;
  }

 private:
  const berm_parameters& p_;
  std::vector<std::vector<std::int64_t>> looks_;
};

double reach_of(const berm_parameters& p, const berm_state& s) {
  sk_reach_box box{};
  for (int j = 0; j < 4; ++j) {
    box.low_urad[j] = s.reach_low_urad[j];
    box.high_urad[j] = s.reach_high_urad[j];
  }
  return max_reach_mm(p, box);
}

// Any requests, any looking about, any distances: whenever a command goes out, S of what is sent and measured is not more than is there.
// verifies: SK-SD-14
TEST(CycleSeparation, NoCommandGoesOutFromWhichTheMachineStandsTooLate) {
  int sent = 0, denied = 0, cut = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    std::mt19937_64 random(seed);
    const auto any = [&random](int low, int high) { return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1)); };
    berm_parameters p = watched(BERM_SEPARATION_ENFORCED);
    p.workspace_radius_mm = any(14'000, 15'000);
    p.workspace_approach_mm_s = any(500, 650);
    p.workspace_intrusion_mm = any(0, 500);
    p.workspace_wait_us = 10'000 * any(0, 50);
    CycleRig rig(p);
    Onlooker onlooker(p);
    look_all_round(rig);
    for (int n = 0; n < 6000; ++n) {
      if (n > 1500 && n % 50 == 0)
        for (int j = 0; j < 4; ++j) rig.wanted_urad_s[j] = any(0, 3) == 0 ? 0 : any(-p.velocity_max_urad_s[j], p.velocity_max_urad_s[j]) / any(1, 4);
      if (n > 1500 && n % 400 == 0) {
        if (any(0, 3) != 0) look_all_round(rig);
        else look_ahead_only(rig);
      }
      rig.step();
      onlooker.look(rig.out->blocks, rig.in->now_us);
      denied += rig.state().stop_reason == BERM_STOP_SEPARATION;
      if (largest(rig.state().commanded_urad_s) == 0) continue;
      ++sent;
      cut += rig.state().permitted_high_urad_s[0] < p.velocity_max_urad_s[0];
      const double reach_mm = reach_of(p, rig.state());
      const double time_s = onlooker.detected_s(rig.in->now_us) + onlooker.stands_s(rig.state(), reach_mm);
      ASSERT_LE(p.workspace_approach_mm_s * time_s + p.workspace_intrusion_mm, p.workspace_radius_mm - reach_mm + 1.0)
          << "seed " << seed << " cycle " << n << ": " << time_s << " s, reach " << reach_mm << " mm; " << why(rig);
    }
  }
  std::printf("%d cycles with commands, %d of them cut, %d denied\n", sent, cut, denied);
  EXPECT_GT(sent, 5000);
  EXPECT_GT(cut, 500);
  EXPECT_GT(denied, 2000);
}

}  // namespace
}  // namespace berm::kernel::test
