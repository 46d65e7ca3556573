#include <gtest/gtest.h>

#include <fcntl.h>

#include <thread>

#include "fake_peers.hpp"
#include "plant/process/peers.hpp"

namespace berm::plant::testing {
namespace {

struct Tick { std::uint64_t cycle; std::uint32_t flags, zero; };

class PeersTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(bus_.open(test_can_address()), "");
    ASSERT_EQ(other_.open(test_can_address()), "");
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, tick_), 0);
    ASSERT_EQ(pipe(life_), 0);
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, pace_), 0);
    peers_ = std::make_unique<Peers>(bus_, Peers::Descriptors{life_[0], tick_[1], pace_[1]}, [this](const berm_can_frame& f) { frames_.push_back(f); });
  }
  void TearDown() override {
    for (const int fd : {tick_[0], tick_[1], life_[0], life_[1], pace_[0], pace_[1]}) {
      if (fd >= 0) close(fd);
    }
  }
  void tick(std::uint64_t cycle, std::uint32_t flags = 0) {
    const Tick t{cycle, flags, 0};
    ASSERT_EQ(::send(tick_[0], &t, sizeof t, 0), static_cast<ssize_t>(sizeof t));
  }
  void heartbeat(std::uint16_t cycle) {
    const berm_heartbeat m{true, 255, 2, 0, cycle, 0};
    ASSERT_TRUE(other_.send(berm_encode_heartbeat(&m)));
  }
  can::Transport bus_, other_;
  void pace(std::uint64_t cycle) { ASSERT_EQ(::send(pace_[0], &cycle, sizeof cycle, 0), static_cast<ssize_t>(sizeof cycle)); }
  int tick_[2] = {-1, -1}, life_[2] = {-1, -1}, pace_[2] = {-1, -1};
  std::vector<berm_can_frame> frames_;
  std::unique_ptr<Peers> peers_;
};

TEST_F(PeersTest, WaitReturnsWhenBothHaveAnswered) {
  heartbeat(41);
  heartbeat(42);
  tick(41);
  tick(42);
  peers_->wait_for(42, -1);
  EXPECT_EQ(peers_->kernel(), PeerState::present);
  EXPECT_EQ(peers_->app(), PeerState::present);
  EXPECT_EQ(frames_.size(), 2u);
  EXPECT_FALSE(peers_->app_finished());
}

TEST_F(PeersTest, CycleOfTheHeartbeatWraps) {
  heartbeat(3);
  tick(65539);
  pace(65500);
  peers_->wait_for(65539, -1);
  EXPECT_EQ(peers_->kernel(), PeerState::present);
}

// verifies: IF-CT-26 (flag bit 0)
TEST_F(PeersTest, FinishedFlagIsKept) {
  tick(1, 1);
  tick(2, 0);
  peers_->drain();
  EXPECT_TRUE(peers_->app_finished());
}

TEST_F(PeersTest, ClosedDescriptorsAreNoticedAtOnce) {
  close(tick_[0]);
  tick_[0] = -1;
  heartbeat(1);
  peers_->wait_for(1, -1);
  EXPECT_EQ(peers_->app(), PeerState::gone);
  close(life_[1]);
  life_[1] = -1;
  peers_->wait_for(2, -1);
  EXPECT_EQ(peers_->kernel(), PeerState::gone);
}

TEST_F(PeersTest, OwnFramesAreNotTheKernels) {
  const berm_can_frame mine{BERM_CAN_FRONT_ANGLE, 8, {}};
  ASSERT_TRUE(bus_.send(mine));
  peers_->drain();
  EXPECT_TRUE(frames_.empty());
}

TEST_F(PeersTest, SilentKernelIsAbsentAfterFiveSecondsAndBackWhenHeard) {
  heartbeat(1);
  tick(1);
  peers_->wait_for(1, -1);
  const auto begin = std::chrono::steady_clock::now();
  peers_->wait_for(2, -1);
  const double waited = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_NEAR(waited, 5.0, 1.0);
  EXPECT_EQ(peers_->kernel(), PeerState::absent);
  EXPECT_EQ(peers_->app(), PeerState::present) << "it could not tick";
  peers_->wait_for(3, -1);  // does not wait again
  heartbeat(4);
  tick(4);
  peers_->wait_for(4, -1);
  EXPECT_EQ(peers_->kernel(), PeerState::present);
}

// A run that goes on without it would look like one in which the kernel found nothing to say.
TEST_F(PeersTest, AKernelThatNeverAnswersIsNoRun) {
  Peers impatient(bus_, {life_[0], tick_[1], pace_[1], 5, 1}, [](const berm_can_frame&) {});
  const auto begin = std::chrono::steady_clock::now();
  try {
    impatient.wait_for_kernel(1, -1);
    FAIL() << "it goes on alone";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).rfind("the kernel never answered", 0), 0U) << error.what();
  }
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

TEST_F(PeersTest, TheJournalsWriterIsWaitedForWhenTheRingCouldOverflow) {
  const std::uint16_t cycle = Peers::kUnreadMost + 11;
  heartbeat(cycle);
  tick(cycle);
  pace(11);
  auto begin = std::chrono::steady_clock::now();
  const auto waited = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  peers_->wait_for(cycle, -1);
  EXPECT_LT(waited(), 1.0) << "it is behind by as much as it may be";
  heartbeat(cycle + 1);
  tick(cycle + 1);
  begin = std::chrono::steady_clock::now();
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    pace(12);
  });
  peers_->wait_for(cycle + 1, -1);
  writer.join();
  EXPECT_GE(waited(), 0.3);
  EXPECT_EQ(peers_->journal(), PeerState::present);
  heartbeat(cycle + 2);
  tick(cycle + 2);
  begin = std::chrono::steady_clock::now();
  peers_->wait_for(cycle + 2, -1);
  EXPECT_NEAR(waited(), 5.0, 1.0);
  EXPECT_EQ(peers_->journal(), PeerState::absent);
  close(pace_[0]);
  pace_[0] = -1;
  peers_->drain();
  EXPECT_EQ(peers_->journal(), PeerState::gone);
}

TEST_F(PeersTest, StopDescriptorEndsTheWait) {
  int stop[2];
  ASSERT_EQ(pipe(stop), 0);
  ASSERT_EQ(write(stop[1], "x", 1), 1);
  peers_->wait_for(1, stop[0]);
  EXPECT_EQ(peers_->kernel(), PeerState::present);
  close(stop[0]);
  close(stop[1]);
}

}  // namespace
}  // namespace berm::plant::testing
