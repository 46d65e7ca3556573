// The page of transitions is what the code does, and what the code does is what the requirements say: every flag, every class of height difference.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "monitor_scene.hpp"
#include "transition_table.hpp"

namespace berm::core_test {
namespace {

constexpr int kFlags[] = {SK_FLAG_EMPTY, SK_FLAG_SET, SK_FLAG_INTERPOLATED, SK_FLAG_NOT_VISITED, SK_FLAG_INTERPOLATED_NOT_VISITED, SK_FLAG_CHANGED, SK_FLAG_OBSTACLE};

// verifies: SK-WM-1
TEST(TransitionTable, ThePageIsWhatTheCodeDoes) {
  std::ifstream page(BERM_SOURCE_DIR "/docs/monitor_transitions.md");
  ASSERT_TRUE(page) << "docs/monitor_transitions.md";
  std::stringstream text;
  text << page.rdbuf();
  EXPECT_TRUE(text.str() == transition_page()) << "write it anew: build/bin/monitor_transitions > docs/monitor_transitions.md";
}

bool holds_obstacle(int flag) { return flag != SK_FLAG_EMPTY && flag != SK_FLAG_SET && flag != SK_FLAG_INTERPOLATED && flag != SK_FLAG_CHANGED; }

// Every value of both flags, heights about every threshold: no obstacle goes but by the height condition, and none is made of nothing.
// verifies: SK-WM-1, SK-WM-20, SK-WM-28, SK-WM-29, SK-WM-30
TEST(TransitionTable, OnlyItsHeightClearsAnObstacle) {
  const std::int32_t heights[] = {-20000, -501, -500, -499, -1, 0, 1, 249, 250, 251, 499, 500, 501, 1199, 1200, 1201, 20000};
  for (const bool continuous : {true, false}) {
    MonitorScene scene(continuous);
    for (int temporary = 0; temporary < 256; ++temporary)
      for (int accumulated = 0; accumulated < 256; ++accumulated)
        for (const std::int32_t z : heights) {
          scene.accumulated(50, 50, {accumulated, 0, 1700});
          scene.temporary(50, 50, temporary, z);
          sk_merge_cell(scene.monitor.get(), scene.rules.get(), 50, 50);
          const bool quiet = temporary == SK_FLAG_NOT_VISITED || temporary == SK_FLAG_INTERPOLATED_NOT_VISITED;
          const bool left = continuous ? z < 1200 && z <= 500 : 2 * z < 500;
          const bool put_off = temporary == SK_FLAG_EMPTY || temporary == SK_FLAG_SET || temporary == SK_FLAG_INTERPOLATED;
          const bool reports = !quiet && !put_off && temporary != SK_FLAG_CHANGED;
          const bool expected = (holds_obstacle(accumulated) && !(quiet && left)) || reports;
          ASSERT_EQ(holds_obstacle(scene.accumulated(50, 50).flag), expected) << flag_name(temporary) << " " << flag_name(accumulated) << " " << z;
          const int expected_temporary = temporary == SK_FLAG_SET            ? SK_FLAG_NOT_VISITED
                                         : temporary == SK_FLAG_INTERPOLATED ? SK_FLAG_INTERPOLATED_NOT_VISITED
                                                                             : SK_FLAG_EMPTY;
          ASSERT_EQ(scene.temporary_flag(50, 50), expected_temporary);
        }
  }
}

// verifies: SK-WM-1
TEST(TransitionTable, AFlagWithUpToThreeBitsFlippedIsAnotherFlagNowhere) {
  for (const int a : kFlags)
    for (const int b : kFlags) {
      if (a == b) continue;
      EXPECT_GE(__builtin_popcount(static_cast<unsigned>(a ^ b)), 4) << flag_name(a) << " " << flag_name(b);
    }
}

}  // namespace
}  // namespace berm::core_test
