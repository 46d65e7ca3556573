// Jobs as processes: every line arrives, and what goes wrong in one is not taken for a result.
#include "in_process/forked_jobs.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <map>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

namespace berm::in_process {
namespace {

TEST(ForkedJobs, EveryLineOfEveryJobArrivesInItsOrder) {
  for (const int at_a_time : {0, 1, 3, 20}) {
    std::map<int, std::vector<std::string>> told;
    const std::string here = std::to_string(getpid());
    run_in_processes(
        9, at_a_time,
        [](int job, const Say& say) {
          for (int i = 0; i < job; ++i) say(std::to_string(job) + "." + std::to_string(i));
          say(std::to_string(getpid()));
        },
        [&told](int job, const std::string& line) { told[job].push_back(line); });
    ASSERT_EQ(told.size(), 9U);
    for (const auto& [job, lines] : told) {
      ASSERT_EQ(lines.size(), static_cast<std::size_t>(job) + 1);
      for (int i = 0; i < job; ++i) EXPECT_EQ(lines[static_cast<std::size_t>(i)], std::to_string(job) + "." + std::to_string(i));
      EXPECT_NE(lines.back(), here) << "a process of its own";
    }
  }
}

TEST(ForkedJobs, ALineLongerThanAPipeIsOneLine) {
  std::string long_line(3'000'000, 'x'), came;
  run_in_processes(1, 1, [&](int, const Say& say) { say(long_line); }, [&came](int, const std::string& line) { came = line; });
  EXPECT_EQ(came, long_line);
}

TEST(ForkedJobs, ThatAreToldToStopAreEnded) {
  int told = 0;
  const auto begin = std::chrono::steady_clock::now();
  run_in_processes(
      20, 2,
      [](int job, const Say& say) {
        say(std::to_string(getpid()));
        if (job > 0) std::this_thread::sleep_for(std::chrono::seconds(60));
      },
      [&told](int, const std::string&) { ++told; }, [&told] { return told >= 2; });
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  EXPECT_LE(told, 3);
}

TEST(ForkedJobs, NoJobsAreDone) { run_in_processes(0, 2, [](int, const Say&) {}, [](int, const std::string&) { FAIL(); }); }

// Each of three waits until all three are there; a fourth and a fifth come when one has ended.
TEST(ForkedJobs, SoManyAtATimeAndNoMore) {
  struct Shared { std::atomic<int> here{0}, most{0}, begun{0}; };
  auto* const memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  Shared& shared = *new (memory) Shared;
  const auto work = [&shared](int, const Say& say) {
    const int here = ++shared.here;
    for (int most = shared.most; here > most && !shared.most.compare_exchange_weak(most, here);) {}
    ++shared.begun;
    for (int i = 0; i < 3000 && shared.begun < 3; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    say(shared.begun >= 3 ? "together" : "alone");
    --shared.here;
  };
  run_in_processes(5, 3, work, [](int, const std::string& line) { EXPECT_EQ(line, "together"); });
  EXPECT_EQ(shared.begun, 5);
  EXPECT_EQ(shared.most, 3);
  munmap(memory, sizeof(Shared));
}

// The others are ended: they would go on for a minute.
TEST(ForkedJobs, AJobThatThrowsOrDiesEndsTheRest) {
  for (const bool dies : {false, true}) {
    const auto begin = std::chrono::steady_clock::now();
    const auto work = [dies](int job, const Say& say) {
      if (job != 1) std::this_thread::sleep_for(std::chrono::minutes(1));
      say("before");
      if (dies) raise(SIGKILL);
      throw std::runtime_error("no such place");
    };
    std::vector<std::string> told;
    EXPECT_THROW(run_in_processes(3, 3, work, [&told](int, const std::string& line) { told.push_back(line); }), std::runtime_error);
    EXPECT_EQ(told, std::vector<std::string>{"before"});
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  }
}

TEST(ForkedJobs, WhatIsToldMayThrow) {
  EXPECT_THROW(run_in_processes(2, 2, [](int, const Say& say) { say("x"); }, [](int, const std::string&) { throw std::invalid_argument("x"); }),
               std::invalid_argument);
}

TEST(ForkedJobs, ACopyChangesNothingHere) {
  int value = 1;
  in_a_copy([&value] { value = 2; });
  EXPECT_EQ(value, 1);
  EXPECT_THROW(in_a_copy([] { throw std::runtime_error("wrong"); }), std::runtime_error);
  EXPECT_THROW(in_a_copy([] { raise(SIGKILL); }), std::runtime_error);
}

TEST(ForkedJobs, AJobGoesOnInCopiesOfWhatItPrepared) {
  std::vector<std::string> told;
  run_in_processes(
      1, 1,
      [](int, const Say& say) {
        int prepared = 40;
        for (int i = 1; i <= 3; ++i) in_a_copy([&] { say(std::to_string(prepared += i)); });
      },
      [&told](int, const std::string& line) { told.push_back(line); });
  EXPECT_EQ(told, (std::vector<std::string>{"41", "42", "43"}));
}

}  // namespace
}  // namespace berm::in_process
