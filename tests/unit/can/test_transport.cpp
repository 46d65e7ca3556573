// Frames over multicast on loopback.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <string>
#include <vector>

#include "can/can_transport.hpp"

namespace {

using berm::can::Transport;

// A port of this process, so that tests that run at once do not hear each other.
std::string address() { return "udp:239.255.66.77:" + std::to_string(20000 + getpid() % 20000); }

class Loopback : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(a.open(address()), "");
    ASSERT_EQ(b.open(address()), "");
  }
  void send_bytes(const std::vector<unsigned char>& bytes) {
    const std::string text = address();
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(text.substr(text.rfind(':') + 1))));
    inet_pton(AF_INET, "239.255.66.77", &to.sin_addr);
    const int fd = socket(AF_INET, SOCK_DGRAM, 0);
    const in_addr loopback{htonl(INADDR_LOOPBACK)};
    ASSERT_EQ(setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback), 0);
    ASSERT_EQ(sendto(fd, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to), static_cast<ssize_t>(bytes.size()));
    close(fd);
  }
  Transport a, b;
};

// verifies: IF-CAN-16
TEST_F(Loopback, EveryOpenTransportHearsEveryFrame) {
  const berm_can_frame sent{BERM_CAN_HEARTBEAT, 8, {1, 2, 3, 4, 5, 6, 7, 8}};
  ASSERT_TRUE(a.send(sent));
  for (Transport* one : {&a, &b}) {
    berm_can_frame got{};
    ASSERT_TRUE(one->receive(got, 1000));
    EXPECT_EQ(got.id, sent.id);
    EXPECT_EQ(got.length, sent.length);
    EXPECT_EQ(std::memcmp(got.data, sent.data, 8), 0);
    EXPECT_EQ(one->counters().received, 1u);
    EXPECT_FALSE(one->receive(got)) << "nothing more";
  }
  EXPECT_EQ(a.counters().sent, 1u);
}

// verifies: IF-CAN-16
TEST_F(Loopback, ManyFramesAtOnceComeOneByOneInTheirOrder) {
  std::vector<berm_can_frame> sent;
  for (unsigned char i = 0; i < 75; ++i) sent.push_back({BERM_CAN_HEARTBEAT, static_cast<unsigned char>(i % 9), {i, 2, 3, 4, 5, 6, 7, 8}});
  ASSERT_TRUE(a.send(sent.data(), static_cast<int>(sent.size())));
  EXPECT_EQ(a.counters().sent, sent.size());
  for (Transport* one : {&a, &b}) {
    for (const berm_can_frame& frame : sent) {
      berm_can_frame got{};
      ASSERT_TRUE(one->receive(got, 1000));
      EXPECT_EQ(got.id, frame.id);
      EXPECT_EQ(got.length, frame.length);
      EXPECT_EQ(std::memcmp(got.data, frame.data, frame.length), 0);
    }
    berm_can_frame got{};
    EXPECT_FALSE(one->receive(got)) << "nothing more";
    EXPECT_EQ(one->counters().wrong_length, 0u);
  }
}

// verifies: IF-CAN-17
TEST_F(Loopback, DatagramsThatAreNoFrameAreCountedAndSkipped) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, sizeof(can_frame), sizeof(canfd_frame) - 1, sizeof(canfd_frame) + 1, std::size_t{1000}})
    send_bytes(std::vector<unsigned char>(size, 0xFF));
  canfd_frame f{};
  f.can_id = BERM_CAN_HEARTBEAT;  // a standard id
  f.len = 8;
  std::vector<unsigned char> bytes(sizeof f);
  std::memcpy(bytes.data(), &f, sizeof f);
  send_bytes(bytes);
  f.can_id |= CAN_EFF_FLAG;
  f.len = 9;
  std::memcpy(bytes.data(), &f, sizeof f);
  send_bytes(bytes);
  berm_can_frame got{7, 7, {7}};
  EXPECT_FALSE(b.receive(got, 50));
  EXPECT_EQ(got.id, 7u) << "nothing was written";
  EXPECT_EQ(b.counters().wrong_length, 8u);
  EXPECT_EQ(b.counters().received, 0u);
  ASSERT_TRUE(a.send({BERM_CAN_HEARTBEAT, 8, {}}));
  EXPECT_TRUE(b.receive(got, 1000)) << "good frames go on";
}

// verifies: IF-CAN-17
TEST_F(Loopback, AShortFrameIsPassedOnWithItsLength) {
  ASSERT_TRUE(a.send({BERM_CAN_HEARTBEAT, 3, {1, 2, 3}}));
  berm_can_frame got{};
  ASSERT_TRUE(b.receive(got, 1000));
  EXPECT_EQ(got.length, 3);
}

// verifies: IF-CAN-18
TEST(TransportAddress, ABadOneGivesOneLineThatNamesIt) {
  for (const char* bad : {"", "udp:", "udp:239.255.66.1", "udp:239.255.66.1:", "udp:239.255.66.1:0", "udp:239.255.66.1:65536", "udp:239.255.66.1:12x",
                          "udp:127.0.0.1:5000", "udp:nonsense:5000", "can:", "can:an_interface_with_a_long_name", "can:no_such_if", "vcan0"}) {
    Transport t;
    const std::string error = t.open(bad);
    EXPECT_NE(error, "") << bad;
    EXPECT_EQ(error.find(bad), 0u) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

}  // namespace
