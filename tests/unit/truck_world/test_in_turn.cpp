#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "truck_world/in_turn.hpp"

namespace berm::truck_world::testing {
namespace {

TEST(InTurn, HandsResultsOverInTheirOrderHowManyEverWork) {
  for (const int at_a_time : {1, 2, 7, 50}) {
    std::vector<int> got;
    in_turn<int>(
        20, at_a_time,
        [](int k) {
          std::this_thread::sleep_for(std::chrono::microseconds(k % 3 == 0 ? 900 : 10));
          return k * k;
        },
        [&](int k, const int& result) {
          EXPECT_EQ(result, k * k);
          got.push_back(k);
        });
    ASSERT_EQ(got.size(), 20u);
    for (int k = 0; k < 20; ++k) EXPECT_EQ(got[static_cast<std::size_t>(k)], k);
  }
}

TEST(InTurn, WhatWorkThrowsIsThrownAndEndsTheRest) {
  std::atomic<int> begun{0};
  EXPECT_THROW(in_turn<int>(
                   1000, 3,
                   [&](int k) {
                     ++begun;
                     if (k == 5) throw std::runtime_error("a scene that cannot be drawn");
                     return k;
                   },
                   [](int, const int&) {}),
               std::runtime_error);
  EXPECT_LT(begun, 1000);
}

TEST(InTurn, OfNothingThereIsNothing) {
  in_turn<int>(0, 4, [](int) { return 1; }, [](int, const int&) { FAIL(); });
}

}  // namespace
}  // namespace berm::truck_world::testing
