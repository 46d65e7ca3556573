#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <chrono>
#include <set>
#include <stdexcept>
#include <vector>

#include "in_process/workers.hpp"

namespace {

using berm::in_process::run_trials;

TEST(Workers, DoEveryTrialOnceAndTellOfOneAtATime) {
  for (const int jobs : {0, 1, 2, 7, 50}) {
    std::vector<std::atomic<int>> done(40);
    std::set<int> told;
    int last = 0;
    std::atomic<bool> telling{false};
    run_trials(
        40, jobs, [&](int i) { ++done[static_cast<std::size_t>(i)]; },
        [&](int finished, int i) {
          EXPECT_FALSE(telling.exchange(true));
          EXPECT_EQ(finished, ++last);
          EXPECT_TRUE(told.insert(i).second);
          telling = false;
        });
    EXPECT_EQ(told.size(), 40u);
    EXPECT_TRUE(std::all_of(done.begin(), done.end(), [](const std::atomic<int>& n) { return n == 1; }));
  }
}

TEST(Workers, WhatATrialThrowsIsThrownAndEndsTheRest) {
  std::atomic<int> begun{0};
  const auto one_fails = [&] {
    run_trials(
        1000, 3,
        [&](int i) {
          ++begun;
          if (i == 5) throw std::runtime_error("a scene that cannot be drawn");
          std::this_thread::sleep_for(std::chrono::microseconds(100));  // else all may be done before the one is heard of
        },
        [](int, int) {});
  };
  EXPECT_THROW(one_fails(), std::runtime_error);
  EXPECT_LT(begun, 1000);
}

TEST(Workers, ThatAreToldToStopHaveDoneTheFirst) {
  for (const int jobs : {1, 3}) {
    std::vector<std::atomic<int>> begun(1000);
    std::atomic<bool> stop{false};
    int told = 0;
    const int done = run_trials(
        1000, jobs, [&](int i) { ++begun[static_cast<std::size_t>(i)]; },
        [&](int finished, int) {
          told = finished;
          if (finished == 10) stop = true;
        },
        [&] { return stop.load(); });
    EXPECT_EQ(done, told);
    EXPECT_GE(done, 10);
    EXPECT_LE(done, 10 + 2 * jobs);
    for (int i = 0; i < 1000; ++i) EXPECT_EQ(begun[static_cast<std::size_t>(i)], i < done ? 1 : 0) << i;
  }
}

TEST(Workers, OfNothingThereIsNothing) {
  run_trials(0, 4, [](int) { FAIL(); }, [](int, int) { FAIL(); });
}

}  // namespace
