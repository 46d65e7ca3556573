// Signals as something to ask for: they wait, are taken once each, leave the program as it was, and what was ignored stays ignored.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

#include "run/interruption.hpp"

namespace {

using berm::run::Interruption;

bool blocked(int number) {
  sigset_t now;
  pthread_sigmask(SIG_BLOCK, nullptr, &now);
  return sigismember(&now, number) == 1;
}

TEST(Interruption, IsTakenOnceEach) {
  const Interruption interruption;
  EXPECT_FALSE(interruption.asked());
  EXPECT_EQ(interruption.take(), 0);
  EXPECT_NO_THROW(interruption.check());
  raise(SIGTERM);
  EXPECT_TRUE(interruption.asked());
  EXPECT_THROW(interruption.check(), std::runtime_error);
  EXPECT_EQ(interruption.take(), SIGTERM);
  EXPECT_EQ(interruption.take(), 0);
  EXPECT_NO_THROW(interruption.check());
  raise(SIGINT);
  EXPECT_EQ(interruption.take(), SIGINT);
}

TEST(Interruption, LeavesTheProgramAsItWas) {
  ASSERT_FALSE(blocked(SIGTERM));
  {
    const Interruption interruption;
    EXPECT_TRUE(blocked(SIGTERM));
    raise(SIGTERM);  // answered, if not taken: it must not end the program now
  }
  EXPECT_FALSE(blocked(SIGTERM));
  EXPECT_FALSE(blocked(SIGINT));
}

TEST(Interruption, WhatWasIgnoredStaysIgnored) {
  struct sigaction before {};
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGINT, &ignore, &before);
  {
    const Interruption interruption;
    raise(SIGINT);
    EXPECT_EQ(interruption.take(), 0);
    raise(SIGTERM);
    EXPECT_EQ(interruption.take(), SIGTERM);
  }
  sigaction(SIGINT, &before, nullptr);
}

}  // namespace
