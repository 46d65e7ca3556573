// Datagrams are the same one by one, whether the system hands them over cut or uncut, and however they were sent.
#include "datagram/datagrams.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <vector>

namespace berm::datagram {
namespace {

using Bytes = std::vector<unsigned char>;

class Socket {
 public:
  explicit Socket(bool uncut) : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    at_.sin_family = AF_INET;
    at_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&at_), sizeof at_), 0);
    socklen_t length = sizeof at_;
    EXPECT_EQ(getsockname(fd_, reinterpret_cast<sockaddr*>(&at_), &length), 0);
    if (uncut) take_uncut(fd_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() { close(fd_); }
  int fd() const { return fd_; }
  sockaddr_in at() const { return at_; }

 private:
  int fd_;
  sockaddr_in at_{};
};

Bytes numbered(std::size_t length, unsigned char first) {
  Bytes b(length);
  for (std::size_t i = 0; i < length; ++i) b[i] = static_cast<unsigned char>(first + 7 * i);
  return b;
}

// One after the other; those of a run of one length, the last of which may be shorter, by one call if the system cuts.
std::vector<Bytes> sent_to(const Socket& to) {
  std::vector<Bytes> all;
  sockaddr_in at = to.at();
  const auto lone = [&](const Bytes& b) {
    EXPECT_EQ(sendto(to.fd(), b.data(), b.size(), 0, reinterpret_cast<const sockaddr*>(&at), sizeof at), static_cast<ssize_t>(b.size()));
    all.push_back(b);
  };
  const auto run = [&](std::size_t count, std::size_t each, std::size_t last) {
    std::vector<Bytes> own;
    for (std::size_t i = 0; i < count; ++i) own.push_back(numbered(i + 1 < count ? each : last, static_cast<unsigned char>(i + each)));
    std::vector<iovec> parts;
    for (Bytes& b : own) parts.push_back({b.data(), b.size()});
    if (send_cut(to.fd(), parts.data(), parts.size(), static_cast<std::uint16_t>(each), &at)) all.insert(all.end(), own.begin(), own.end());
    else for (const Bytes& b : own) lone(b);
  };
  lone(numbered(80, 1));
  run(15, 1206, 1206);
  lone({});
  run(15, 1206, 700);
  run(32, 72, 72);
  lone(numbered(1500, 9));
  lone(numbered(1500, 10));
  return all;
}

std::vector<Bytes> taken_from(const Socket& from) {
  const auto waiting = std::make_unique<Waiting>();
  std::vector<Bytes> all;
  for (Waiting::One one; waiting->next(from.fd(), one);) all.emplace_back(one.bytes, one.bytes + one.length);
  return all;
}

TEST(Datagrams, ComeOneByOneAsTheyWereSent) {
  for (const bool uncut : {false, true}) {
    const Socket socket(uncut);
    const std::vector<Bytes> sent = sent_to(socket), taken = taken_from(socket);
    ASSERT_EQ(taken.size(), sent.size()) << "uncut " << uncut;
    for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_EQ(taken[i], sent[i]) << "uncut " << uncut << ", datagram " << i;
    EXPECT_TRUE(taken_from(socket).empty());
  }
}

}  // namespace
}  // namespace berm::datagram
