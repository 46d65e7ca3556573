// A frame that cannot be sent ends its cycle's sending. A program of its own: it replaces the system's sending.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <vector>

#include "can/can_transport.hpp"

namespace {
int sends_left = -1;  // calls of sendto until one fails; below 0: none does
}

// The system that cuts no message into datagrams: frames go one by one.
extern "C" ssize_t sendmsg(int, const msghdr*, int) {
  errno = EOPNOTSUPP;
  return -1;
}

extern "C" ssize_t sendto(int fd, const void* bytes, size_t size, int flags, const sockaddr* to, socklen_t length) {
  if (sends_left == 0) {
    errno = ENOBUFS;
    return -1;
  }
  if (sends_left > 0) --sends_left;
  return syscall(SYS_sendto, fd, bytes, size, flags, to, length);
}

namespace {

using berm::can::Transport;

// A heartbeat that came through alone would have the machine go on with the command before.
// verifies: IF-CAN-15
TEST(SendFailure, NothingGoesOutAfterAFrameThatDoesNot) {
  const std::string address = "udp:239.255.66.77:" + std::to_string(20000 + getpid() % 20000);
  const std::vector<berm_can_frame> cycle = {{BERM_CAN_GUARD_KERNEL, 8, {1}}, {BERM_CAN_VELOCITY_CMD_1, 8, {2}}, {BERM_CAN_GUARD_KERNEL, 8, {3}}, {BERM_CAN_HEARTBEAT, 8, {4}}};
  for (std::size_t good = 0; good <= cycle.size(); ++good) {
    Transport a, b;
    ASSERT_EQ(a.open(address), "");
    ASSERT_EQ(b.open(address), "");
    sends_left = static_cast<int>(good);
    EXPECT_EQ(a.send(cycle.data(), static_cast<int>(cycle.size())), good == cycle.size());
    sends_left = -1;
    EXPECT_EQ(a.counters().sent, good);
    EXPECT_EQ(a.counters().send_failed, cycle.size() - good);
    const berm_can_frame last{BERM_CAN_OPERATOR, 8, {9}};
    ASSERT_TRUE(a.send(last));
    berm_can_frame got{};
    for (std::size_t i = 0; i < good; ++i) {
      ASSERT_TRUE(b.receive(got, 1000));
      EXPECT_EQ(got.id, cycle[i].id);
    }
    ASSERT_TRUE(b.receive(got, 1000));
    EXPECT_EQ(got.id, last.id) << good << ": nothing between";
  }
}

}  // namespace
