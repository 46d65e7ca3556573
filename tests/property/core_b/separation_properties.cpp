// Sectors against the list of all looks, and the separation against every sector by itself. A failure prints its seed (RC_PARAMS="seed=..." repeats
// it).
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/governor.h"
#include "core/separation.h"
#include "draw.hpp"
#include "reach_parameters.hpp"
#include "valid_parameters.hpp"

namespace berm::core_test {
namespace {

// All looks at one sector.
class Looks {
 public:
  void see(std::int64_t now_us) { looks_.push_back(now_us); }
  // For how long somebody may have been there who has not been told of: he came after a look, was seen at the next, and memory_us have not passed
  // since.
  std::int64_t blind(std::int64_t now_us, std::int64_t memory_us) const {
    if (looks_.empty()) return SK_BLIND_MOST_US;
    std::int64_t blind_us = now_us - looks_.back();
    for (std::size_t i = 1; i < looks_.size(); ++i)
      if (now_us <= looks_[i] + memory_us) blind_us = std::max(blind_us, looks_[i] - looks_[i - 1]);
    return std::min<std::int64_t>(blind_us, SK_BLIND_MOST_US);
  }
  // The same, of gaps that ended no earlier than the oldest that may count still: two windows, each the memory and the gap that ended it.
  std::int64_t most(std::int64_t now_us, std::int64_t memory_us) const {
    if (looks_.empty()) return SK_BLIND_MOST_US;
    std::int64_t blind_us = now_us - looks_.back(), widest_us = 0;
    for (std::size_t i = looks_.size(); i-- > 1;) {
      const std::int64_t gap_us = looks_[i] - looks_[i - 1];
      if (looks_.back() - looks_[i] > 2 * (memory_us + widest_us)) break;
      blind_us = std::max(blind_us, gap_us);
      widest_us = std::max(widest_us, gap_us);
    }
    return std::min<std::int64_t>(blind_us, SK_BLIND_MOST_US);
  }

 private:
  std::vector<std::int64_t> looks_;
};

std::int64_t pause_us() {
  switch (draw(0, 3)) {
    case 0: return draw(0, 20'000);
    case 1: return draw(0, 400'000);
    case 2: return draw(0, 12'000'000);
    default: return 10'000;
  }
}

void looks_at_any_times() {
  const std::int32_t memory_us = draw(0, 4'000'000);
  sk_sectors sectors;
  sk_sectors_begin(&sectors);
  sk_sector& s = sectors.sector[draw(0, SK_SECTORS - 1)];
  Looks looks;
  std::int64_t now_us = draw(0, 1'000'000'000);
  const int steps = draw(1, 400);
  for (int k = 0; k < steps; ++k) {
    now_us += pause_us();
    if (chance(80)) {
      sk_sector_see(&s, now_us, memory_us);
      looks.see(now_us);
    }
    const std::int64_t blind_us = sk_sector_blind(&s, now_us);
    RC_ASSERT(blind_us >= looks.blind(now_us, memory_us));
    RC_ASSERT(blind_us <= looks.most(now_us, memory_us));
  }
}

// verifies: SK-SD-2, SK-SD-3
TEST(SeparationProperties, WhatASectorRemembersIsWhatTheLooksSay) { EXPECT_TRUE(rc::check(looks_at_any_times)); }

// S <= distance, by itself.
bool keeps(const sk_separation_rules& r, std::int64_t time_us, std::int64_t distance_mm) {
  const auto walked = static_cast<long double>(r.approach_mm_s) * static_cast<long double>(time_us);
  return walked <= static_cast<long double>(distance_mm - r.intrusion_mm) * 1e6L;
}

void separation_of_any_ages() {
  const sk_separation_rules rules = {draw(SK_APPROACH_LEAST_MM_S, 6000), draw(0, 3000), draw(0, 5'000'000)};
  const std::int32_t distance_mm = draw(-2000, 15'000);
  auto sectors = std::make_unique<sk_sectors>();
  sk_sectors_begin(sectors.get());
  const std::int64_t now_us = 2'000'000'000;
  const std::int32_t oldest_us = draw(1, 20'000'000);
  std::vector<std::int64_t> blind_us(SK_SECTORS);
  for (int k = 0; k < SK_SECTORS; ++k) {
    const std::int64_t seen_us = now_us - draw(0, oldest_us), before_us = seen_us - draw(0, oldest_us);
    sk_sector_see(&sectors->sector[k], before_us, 3'000'000);
    sk_sector_see(&sectors->sector[k], seen_us, 3'000'000);
    blind_us[static_cast<std::size_t>(k)] = std::max(now_us - seen_us, seen_us - before_us);
  }
  const sk_separation left = sk_separate(sectors.get(), now_us, rules, distance_mm);
  const std::int64_t worst_us = *std::max_element(blind_us.begin(), blind_us.end());
  RC_ASSERT(left.sector >= 0 && left.sector < SK_SECTORS);
  RC_ASSERT(blind_us[static_cast<std::size_t>(left.sector)] == worst_us);
  if (left.stop_us >= 0)
    for (const std::int64_t blind : blind_us) {
      const std::int64_t time_us = blind + rules.detect_us + left.stop_us;
      RC_ASSERT(keeps(rules, time_us, distance_mm));
      RC_ASSERT(sk_separation_distance(rules.approach_mm_s, time_us, rules.intrusion_mm) <= distance_mm);
    }
  RC_ASSERT(!keeps(rules, worst_us + rules.detect_us + left.stop_us + 1, distance_mm));
}

// verifies: SK-SD-1, SK-SD-5, SK-SD-6
TEST(SeparationProperties, TheTimeLeftIsTheMostThatKeepsTheDistanceEverywhere) { EXPECT_TRUE(rc::check(separation_of_any_ages)); }

// The table's time for a speed, read by itself.
std::int64_t stop_time(const berm_parameters& p, int joint, int row, std::int64_t speed_urad_s) {
  int column = 0;
  while (std::int64_t{p.velocity_max_urad_s[joint]} * column / 7 < speed_urad_s) ++column;
  return std::int64_t{p.brake_time_us[joint][row][column]} + p.cycle_us + p.command_latency_us;
}

void levels_in_time() {
  berm_parameters p = chance(50) ? valid_parameters() : reach_parameters();
  const int joint = draw(0, 3), row = draw(0, 3);
  if (p.brake_time_us[joint][row][7] == 0) {
    p.velocity_max_urad_s[joint] = draw(1, 4'000'000);
    auto& time_us = p.brake_time_us[joint][row];
    for (int column = 1; column < BERM_BRAKE_SPEEDS; ++column) time_us[column] = time_us[column - 1] + draw(0, 900'000);
  }
  const std::int64_t stop_us = draw(-1, 8'000'000);
  const std::int32_t level = sk_governor_timed_level(&p, joint, row, stop_us), speed = sk_governor_timed_speed(&p, joint, level);
  if (level > 0)
    for (int k = 0; k < 50; ++k) RC_ASSERT(stop_time(p, joint, row, draw(0, speed)) <= stop_us);
  else
    RC_ASSERT(speed == 0);
  if (level < SK_GOVERNOR_LEVELS - 1) {
    const int next = std::min(level + 2, SK_GOVERNOR_LEVELS - 1);
    const auto speed_of = [&](int l) { return std::int64_t{p.velocity_max_urad_s[joint]} * l / (SK_GOVERNOR_LEVELS - 1); };
    const std::int64_t slowing_us = next > SK_GOVERNOR_COLUMN ? stop_time(p, joint, row, speed_of(SK_GOVERNOR_COLUMN)) : 0;
    RC_ASSERT(stop_time(p, joint, row, speed_of(next)) + slowing_us > stop_us);
  }
}

// verifies: SK-SD-10, SK-SD-11, SK-SD-12
TEST(SeparationProperties, FromALevelTheJointStandsInTime) { EXPECT_TRUE(rc::check(levels_in_time)); }

}  // namespace
}  // namespace berm::core_test
