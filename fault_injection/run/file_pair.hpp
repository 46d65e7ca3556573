// Two connected descriptors, closed with the object: what the processes of a run tell one another through.
#pragma once

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace berm::run {

class FilePair {
 public:
  static FilePair pipe() {
    FilePair p;
    if (pipe2(p.fd_, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    return p;
  }
  static FilePair packets() {
    FilePair p;
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, p.fd_) != 0) throw std::system_error(errno, std::generic_category(), "socketpair");
    return p;
  }
  FilePair(FilePair&& other) noexcept {
    std::swap(fd_[0], other.fd_[0]);
    std::swap(fd_[1], other.fd_[1]);
  }
  FilePair(const FilePair&) = delete;
  FilePair& operator=(const FilePair&) = delete;
  ~FilePair() { drop(); }
  int first() const { return fd_[0]; }
  int second() const { return fd_[1]; }
  void drop() {  // the children keep theirs: only so can the end of one be seen by another
    for (int& fd : fd_) {
      if (fd >= 0) close(fd);
      fd = -1;
    }
  }

 private:
  FilePair() = default;
  int fd_[2] = {-1, -1};
};

}  // namespace berm::run
