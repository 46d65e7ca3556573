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

// Datagrams taken from a socket and not asked for yet: kBatch by one call, of each at most kRoom bytes.
template <int kBatch, std::size_t kRoom>
class Waiting {
 public:
  struct One {
    const unsigned char* bytes = nullptr;
    std::size_t length = 0;  // as it was sent: of one that is longer than kRoom only so many bytes are there
  };

  // The next one; it stays as it is until the call after. False when there is none at the socket either. Never waits.
  bool next(int fd, One& out) {
    if (next_ == taken_ && !refill(fd)) return false;
    out = {bytes_[next_], length_[next_]};
    ++next_;
    return true;
  }

 private:
  bool refill(int fd) {
    iovec part[kBatch];
    mmsghdr message[kBatch] = {};
    for (int i = 0; i < kBatch; ++i) {
      part[i] = {bytes_[i], kRoom};
      message[i].msg_hdr.msg_iov = &part[i];
      message[i].msg_hdr.msg_iovlen = 1;
    }
    int n = 0;
    do {
      n = recvmmsg(fd, message, kBatch, MSG_DONTWAIT | MSG_TRUNC, nullptr);
    } while (n < 0 && errno == EINTR);
    next_ = 0;
    taken_ = std::max(n, 0);
    for (int i = 0; i < taken_; ++i) length_[i] = message[i].msg_len;
    return taken_ > 0;
  }

  unsigned char bytes_[kBatch][kRoom];
  std::size_t length_[kBatch];
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
