// Sums over pairs of ends, against each pair by itself.
#include "recognition/pair_sums.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

namespace berm::app {
namespace {

struct Rectangle {
  int rear_from, rear_to, front_from, front_to;
  Ways weights;
};

// Of all pairs a length apart exactly those that come to more than 0 with what their ends add, however few they are.
TEST(PairSums, HandsOnThePairsThatAreWorthSomething) {
  std::mt19937 random(7);
  const auto whole = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const Steps steps{38, 69};
  std::size_t handed_on = 0, left_out = 0;
  for (int round = 0; round < 20; ++round) {
    PairSums sums(steps);
    std::vector<Rectangle> all;
    for (int k = 0; k < 30; ++k) {
      const int rear = whole(0, kEnds), front = whole(0, kEnds);
      all.push_back({rear, rear + whole(0, 40), front, front + whole(0, 40), static_cast<float>(whole(-4, 4)) * (k % 3 == 0 ? kAnyWay : k % 3 == 1 ? kWithRearWall : kOpenFront)});
      sums.add(all.back().rear_from, all.back().rear_to, all.back().front_from, all.back().front_to, all.back().weights);
    }
    std::array<Ways, kEnds> of_rear, of_front;
    for (int k = 0; k < kEnds; ++k) {
      of_rear[static_cast<std::size_t>(k)] = static_cast<float>(whole(-9, 4)) * kAnyWay;
      of_front[static_cast<std::size_t>(k)] = static_cast<float>(whole(-3, 3)) * kAnyWay + Ways{0.0F, 0.0F, 0.0F, -1.0F};
    }
    std::map<std::pair<int, int>, Ways> handed;
    sums.visit(of_rear, of_front, [&](int rear, int front, const Ways& s) { handed[{rear, front}] = s; });
    for (int rear = 0; rear < kEnds; ++rear)
      for (int front = rear + steps.shortest; front <= std::min(rear + steps.longest, kEnds - 1); ++front) {
        Ways sum{};
        for (const Rectangle& r : all)
          if (rear >= r.rear_from && rear < r.rear_to && front >= r.front_from && front < r.front_to) sum += r.weights;
        const bool worth = any_positive(sum + of_rear[static_cast<std::size_t>(rear)] + of_front[static_cast<std::size_t>(front)]);
        const auto found = handed.find({rear, front});
        ASSERT_EQ(found != handed.end(), worth) << rear << ' ' << front;
        for (int way = 0; worth && way < 3; ++way) ASSERT_EQ(found->second[way], sum[way]) << rear << ' ' << front << ' ' << way;
        ++(worth ? handed_on : left_out);
      }
    std::size_t within = 0;
    for (const auto& [ends, sum] : handed) within += ends.second - ends.first >= steps.shortest && ends.second - ends.first <= steps.longest && ends.second < kEnds ? 1 : 0;
    ASSERT_EQ(within, handed.size());
  }
  EXPECT_GT(handed_on, 100u);
  EXPECT_GT(left_out, 100u);
}

}  // namespace
}  // namespace berm::app
