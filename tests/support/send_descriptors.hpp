// A message on a Unix socket with file descriptors, as the kernel's greeting has it.
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstring>

namespace berm::test {

// False, with errno, when it was not sent whole.
template <std::size_t Count>
bool send_descriptors(int socket, const void* bytes, std::size_t size, const int (&fds)[Count]) {
  iovec part{const_cast<void*>(bytes), size};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof fds)] = {};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  cmsghdr* header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof fds);
  std::memcpy(CMSG_DATA(header), fds, sizeof fds);
  return sendmsg(socket, &message, MSG_NOSIGNAL) == static_cast<ssize_t>(size);
}

}  // namespace berm::test
