// A kernel that is held up in the middle of a cycle, by a peer that hands over an open file whose closing waits: what that cycle decided is not sent.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "kernel_process.hpp"

namespace berm::test {
namespace {

// A connection with bytes that nobody takes: who closes it last waits, for up to a second, or until the other end resets it.
class SlowToClose {
 public:
  SlowToClose() {
    const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    const int small = 2048;
    bind(listener, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
    setsockopt(listener, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
    listen(listener, 1);
    near_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    connect(near_, reinterpret_cast<sockaddr*>(&address), size);
    far_ = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
    close(listener);
    const char bytes[4096] = {};
    fcntl(near_, F_SETFL, O_NONBLOCK);
    while (write(near_, bytes, sizeof bytes) > 0) continue;
    fcntl(near_, F_SETFL, 0);
    const linger waits{1, 1};
    setsockopt(near_, SOL_SOCKET, SO_LINGER, &waits, sizeof waits);
  }
  ~SlowToClose() { reset(); }
  SlowToClose(const SlowToClose&) = delete;
  SlowToClose& operator=(const SlowToClose&) = delete;

  bool hand_over(Peer& peer) {
    const bool sent = peer.hand_over(near_);
    close(near_);  // not the last: the message has it
    return sent;
  }
  void reset() {
    const linger at_once{1, 0};
    if (far_ < 0) return;
    setsockopt(far_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    close(far_);
    far_ = -1;
  }

 private:
  int near_ = -1, far_ = -1;
};

// verifies: SK-CY-28, IF-CAN-22
TEST(LateSending, WhatACycleDecidedThatWasHeldUpIsNotSent) {
  KernelProcess kernel({"--realtime"});
  ASSERT_TRUE(kernel.started());
  Peer peer(kernel.socket_path(), BERM_ROLE_APP);
  ASSERT_TRUE(peer.receive_welcome());
  auto heard = kernel.hear(200);
  ASSERT_FALSE(heard.empty());
  SlowToClose file;
  ASSERT_TRUE(file.hand_over(peer));
  std::this_thread::sleep_for(std::chrono::milliseconds(40));
  file.reset();
  const auto after = kernel.hear(300);
  ASSERT_FALSE(after.empty()) << "it goes on";
  heard.insert(heard.end(), after.begin(), after.end());
  int missing = 0;
  for (std::size_t i = 1; i < heard.size(); ++i) missing += static_cast<std::uint16_t>(heard[i] - heard[i - 1] - 1);
  const std::string report = kernel.end();
  EXPECT_GE(missing, 1) << report;
  EXPECT_GE(json_number(report, "unsent_cycles"), missing) << report;
}

}  // namespace
}  // namespace berm::test
