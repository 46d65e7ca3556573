// Ports of runs that start at the same time: none is given twice, whatever the draw says is free.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <vector>

#include "run/reserved_port.hpp"

namespace berm::run {
namespace {

// Draws these in turn, from the begin again behind the last.
class Draw {
 public:
  explicit Draw(std::vector<std::uint16_t> numbers) : numbers_(std::move(numbers)) {}
  std::uint16_t operator()() { return numbers_[next_++ % numbers_.size()]; }

 private:
  std::vector<std::uint16_t> numbers_;
  std::size_t next_ = 0;
};

TEST(ReservedPort, WhatAnotherHasIsDrawnAgain) {
  const std::uint16_t a = free_udp_port();
  const std::uint16_t b = a == 65535 ? 1024 : static_cast<std::uint16_t>(a + 1);
  const ReservedPort first(Draw({a}));
  EXPECT_EQ(first.number(), a);
  {
    const ReservedPort second(Draw({a, a, b}));
    EXPECT_EQ(second.number(), b);
    EXPECT_NE(first.can_address(), second.can_address());
    EXPECT_THROW(ReservedPort third(Draw({a, b})), std::system_error);
  }
  EXPECT_EQ(ReservedPort(Draw({a, b})).number(), b) << "free again";
}

// Four processes at once, each wants ten ports and draws the same few in the same order; there are some more than they want, which runs that happen to
// go on meanwhile may have.
TEST(ReservedPort, LaunchersThatStartAtOnceNeverGetTheSame) {
  constexpr std::size_t kLaunchers = 4, kEach = 10, kPool = kLaunchers * kEach + 10;
  for (int round = 0; round < 20; ++round) {
    std::vector<std::uint16_t> pool;
    const std::uint16_t begin = std::min<std::uint16_t>(free_udp_port(), 65535 - kPool);
    for (std::size_t i = 0; i < kPool; ++i) pool.push_back(static_cast<std::uint16_t>(begin + i));
    int told[2], go[2], end[2];
    ASSERT_EQ(pipe(told) | pipe(go) | pipe(end), 0);
    std::vector<pid_t> children;
    for (std::size_t i = 0; i < kLaunchers; ++i) {
      children.push_back(fork());
      if (children.back() != 0) continue;
      close(go[1]);
      close(end[1]);
      char byte = 0;
      if (read(go[0], &byte, 1) != 0) _exit(1);  // all begin when the parent closes it, and hold what they have until it closes the other
      Draw draw(pool);
      std::vector<ReservedPort> ports;
      for (std::size_t k = 0; k < kEach; ++k) {
        ports.emplace_back(std::ref(draw));
        const std::uint16_t number = ports.back().number();
        if (write(told[1], &number, sizeof number) != sizeof number) _exit(1);
      }
      _exit(read(end[0], &byte, 1) == 0 ? 0 : 1);
    }
    for (const int fd : {told[1], go[0], go[1], end[0]}) close(fd);
    std::vector<std::uint16_t> numbers(kLaunchers * kEach);
    for (std::uint16_t& number : numbers) ASSERT_EQ(read(told[0], &number, sizeof number), static_cast<ssize_t>(sizeof number)) << "a launcher failed";
    close(end[1]);
    close(told[0]);
    for (const pid_t child : children) {
      int status = 0;
      waitpid(child, &status, 0);
      EXPECT_EQ(status, 0);
    }
    ASSERT_EQ(std::set<std::uint16_t>(numbers.begin(), numbers.end()).size(), numbers.size()) << "round " << round;
  }
}

}  // namespace
}  // namespace berm::run
