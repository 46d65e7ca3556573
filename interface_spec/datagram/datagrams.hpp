// Many datagrams by one call of the system, for what crosses a boundary as datagrams on loopback: frames, scan packets.
#pragma once

#include <netinet/in.h>
#include <netinet/udp.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace berm::datagram {

// Asks the system to hand over uncut what was sent as one message to be cut (send_cut), and datagrams of one sender and size together: Waiting cuts them.
// A system that cannot hands over one by one.
inline void take_uncut(int fd) {
  const int yes = 1;
  setsockopt(fd, SOL_UDP, UDP_GRO, &yes, sizeof yes);
}

// Datagrams taken from a socket and not asked for yet: up to kMessages of the system's messages by one call, each of one datagram or of many.
class Waiting {
 public:
  struct One {
    const unsigned char* bytes = nullptr;
    std::size_t length = 0;  // as it was sent
  };

  // The next one; it stays as it is until the call after. False when there is none at the socket either. Never waits.
  bool next(int fd, One& out) {
    if (next_ == taken_ && !refill(fd)) return false;
    const Message& here = message_[next_];
    out = {bytes_[next_] + begin_, std::min(here.each, here.length - begin_)};
    begin_ += out.length;
    if (begin_ >= here.length) {
      ++next_;
      begin_ = 0;
    }
    return true;
  }

 private:
  static constexpr int kMessages = 2;
  static constexpr std::size_t kRoom = 1 << 16;  // more than any message is long
  struct Message { std::size_t length = 0, each = 0; };  // each: of the datagrams in it but the last, which may be shorter

  bool refill(int fd) {
    iovec part[kMessages];
    mmsghdr header[kMessages] = {};
    alignas(cmsghdr) char control[kMessages][CMSG_SPACE(sizeof(int))];
    for (int i = 0; i < kMessages; ++i) {
      part[i] = {bytes_[i], kRoom};
      msghdr& h = header[i].msg_hdr;
      h.msg_iov = &part[i];
      h.msg_iovlen = 1;
      h.msg_control = control[i];
      h.msg_controllen = sizeof control[i];
    }
    int n = 0;
    do {
      n = recvmmsg(fd, header, kMessages, MSG_DONTWAIT, nullptr);
    } while (n < 0 && errno == EINTR);
    next_ = 0;
    begin_ = 0;
    taken_ = std::max(n, 0);
    for (int i = 0; i < taken_; ++i) message_[i] = {header[i].msg_len, each_of(header[i])};
    return taken_ > 0;
  }

  static std::size_t each_of(mmsghdr& header) {
    int each = 0;
    for (cmsghdr* c = CMSG_FIRSTHDR(&header.msg_hdr); c != nullptr; c = CMSG_NXTHDR(&header.msg_hdr, c))
      if (c->cmsg_level == SOL_UDP && c->cmsg_type == UDP_GRO) std::memcpy(&each, CMSG_DATA(c), sizeof each);
    return each > 0 ? static_cast<std::size_t>(each) : header.msg_len;
  }

  unsigned char bytes_[kMessages][kRoom];
  Message message_[kMessages];
  std::size_t begin_ = 0;  // of the next datagram in its message
  int next_ = 0, taken_ = 0;
};

// Sends the parts as one message that the system cuts into datagrams of `each` bytes, to where the socket is connected or to `to`. False with errno when
// nothing went.
inline bool send_cut(int fd, iovec* parts, std::size_t count, std::uint16_t each, sockaddr_in* to = nullptr) {
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof each)] = {};
  msghdr message{};
  message.msg_name = to;
  message.msg_namelen = to != nullptr ? sizeof *to : 0;
  message.msg_iov = parts;
  message.msg_iovlen = count;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  cmsghdr* header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_UDP;
  header->cmsg_type = UDP_SEGMENT;
  header->cmsg_len = CMSG_LEN(sizeof each);
  std::memcpy(CMSG_DATA(header), &each, sizeof each);
  return sendmsg(fd, &message, MSG_NOSIGNAL) >= 0;
}

// Whether errno says that the system, or this socket, cuts no messages: not worth another try.
inline bool cuts_none(int error) { return error == EINVAL || error == EIO || error == ENOPROTOOPT || error == EOPNOTSUPP; }

}  // namespace berm::datagram
