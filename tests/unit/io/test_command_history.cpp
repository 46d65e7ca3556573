// Which commands may still be under way.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "io/command_history.hpp"

namespace berm::kernel {
namespace {

// verifies: SK-CY-21
TEST(CommandHistory, HoldsTheWindowAndTheCommandInForceWhenItBegan) {
  CommandHistory history(30000);
  std::int32_t low[4], high[4];
  history.range(0, low, high);
  EXPECT_EQ(low[0], 0);
  EXPECT_EQ(high[0], 0);
  for (int k = 0; k < 10; ++k) history.push(k * 10000, {k * 100, -k * 100, 0, 7});
  history.range(100000, low, high);  // sent at 70, 80, 90 ms; that of 70 ms is the one in force when the window began
  EXPECT_EQ(low[0], 700);
  EXPECT_EQ(high[0], 900);
  EXPECT_EQ(low[1], -900);
  EXPECT_EQ(high[1], -700);
  EXPECT_EQ(low[3], 7);
}

// verifies: SK-CY-21
TEST(CommandHistory, NeverForgetsACommandThatAJointMayStillObey) {
  constexpr std::int32_t kWindow = 130000;
  std::mt19937_64 random(20240501);
  CommandHistory history(kWindow);
  std::vector<std::pair<std::int64_t, std::int32_t>> sent;
  std::int64_t now = 0;
  for (int i = 0; i < 2000; ++i) {
    now += 10000 + static_cast<std::int64_t>(random() % 5) * 1000;
    const auto v = static_cast<std::int32_t>(random() % 2001) - 1000;
    history.push(now, {v, v, v, v});
    sent.emplace_back(now, v);
    const std::int64_t at = now + static_cast<std::int64_t>(random() % 10000);
    std::int32_t low[4], high[4];
    history.range(at, low, high);
    // Independent statement: obeyed anywhere in the window are all commands sent in it, and the last one sent before it.
    std::int32_t least = sent.back().second, most = least;
    for (std::size_t k = sent.size(); k-- > 0;) {
      least = std::min(least, sent[k].second);
      most = std::max(most, sent[k].second);
      if (sent[k].first <= at - kWindow) break;
    }
    ASSERT_EQ(low[2], least);
    ASSERT_EQ(high[2], most);
  }
}

}  // namespace
}  // namespace berm::kernel
