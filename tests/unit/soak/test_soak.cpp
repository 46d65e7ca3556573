// What a shift draws, that the plant takes it, and the memory's slope.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "plant/process/scenario.hpp"
#include "run/memory_watch.hpp"
#include "scratch.hpp"
#include "soak/drawn_shift.hpp"

namespace berm::soak {
namespace {

TEST(DrawnShift, IsTheSameForASeedAndAnotherForAnother) {
  EXPECT_EQ(scenario_text(draw_shift(2.0, 5)), scenario_text(draw_shift(2.0, 5)));
  EXPECT_NE(scenario_text(draw_shift(2.0, 5)), scenario_text(draw_shift(2.0, 6)));
}

TEST(DrawnShift, ALongerShiftBeginsAsAShorterOne) {
  const DrawnShift shorter = draw_shift(2.0, 4), longer = draw_shift(8.0, 4);
  ASSERT_LE(shorter.dust.size(), longer.dust.size());
  for (std::size_t i = 0; i < shorter.dust.size(); ++i) EXPECT_EQ(shorter.dust[i].at_s, longer.dust[i].at_s);
  EXPECT_GT(longer.soil.size(), shorter.soil.size());
}

TEST(DrawnShift, ThePlantReadsItWithPeopleDustAndWeather) {
  const test::Scratch folder;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::string file = folder.path("scenario.toml");
    std::ofstream(file) << scenario_text(draw_shift(8.0, seed));
    const plant::Scenario s = plant::load_scenario(file, BERM_PLANT_PROFILES);
    EXPECT_DOUBLE_EQ(s.max_time_s, 8 * 3600.0);
    EXPECT_GE(s.world.soil_changes.size(), 3U);
    EXPECT_GE(s.world.dust.size(), 5U);
    EXPECT_EQ(s.world.movers.size(), 3U);
    EXPECT_TRUE(s.operator_config && s.operator_config->resets_after_s);
    for (const plant::MoverConfig& person : s.world.movers) {
      EXPECT_TRUE(person.beside_machine);
      EXPECT_GE(person.waypoints.size(), 10U);
    }
  }
}

// A machine that goes back 11 m an hour comes to the shift's end before it comes to the bench's, where the ground goes on under the tail.
TEST(DrawnShift, TheBenchLastsAsLongAsTheShift) {
  const test::Scratch folder;
  for (const double hours : {0.5, 8.0, 10.0}) {
    const std::string file = folder.path("scenario.toml");
    std::ofstream(file) << scenario_text(draw_shift(hours, 1));
    const plant::Scenario s = plant::load_scenario(file, BERM_PLANT_PROFILES);
    ASSERT_TRUE(s.operator_config);
    EXPECT_GE(s.operator_config->farthest_back_m, 11.0 * hours);
    EXPECT_LE(s.world.terrain.x_low, -s.operator_config->farthest_back_m - 10.0);
  }
}

TEST(DrawnShift, PeopleEnterAndWalkBy) {
  int enter = 0, pass = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const DrawnPerson& person : draw_shift(8.0, seed).people)
      for (const DrawnVisit& visit : person.visits) (visit.enters ? enter : pass) += 1;
  EXPECT_GT(enter, 20);
  EXPECT_GT(pass, 20);
}

TEST(MemoryGrowth, IsTheSlopeAfterTheFirstMinutes) {
  std::vector<run::MemorySample> samples;
  for (double t = 0; t <= 3600; t += 10) samples.push_back({t, t < 300 ? 1000 + 100 * t : 50000.0, 20000.0 + t / 36});
  const run::MemoryGrowth growth = run::memory_growth(samples);
  ASSERT_TRUE(growth.kib_per_hour);
  EXPECT_NEAR(*growth.kernel_kib_per_hour, 0.0, 1e-6);
  EXPECT_NEAR(*growth.app_kib_per_hour, 100.0, 1e-6);
  EXPECT_NEAR(*growth.kib_per_hour, 100.0, 1e-6);
}

TEST(MemoryGrowth, IsUnknownForAShortRun) {
  EXPECT_FALSE(run::memory_growth({{10, 1, 1}, {320, 1, 1}}).kib_per_hour);
}

}  // namespace
}  // namespace berm::soak
