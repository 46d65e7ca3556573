// The two shared segments: anonymous files (memfd), mapped, then sealed for good so that no peer can resize them, and so that no peer
// can ever write the one the kernel writes. A segment that cannot shrink cannot kill its reader with SIGBUS.
#pragma once

#include <cstddef>
#include <string>

namespace berm::kernel {

enum class SegmentAccess {
  kKernelWrites,  // mapped writable here, F_SEAL_FUTURE_WRITE for everyone after
  kPeerWrites     // mapped read-only here
};

class SharedSegment {
 public:
  SharedSegment() = default;
  ~SharedSegment();
  SharedSegment(const SharedSegment&) = delete;
  SharedSegment& operator=(const SharedSegment&) = delete;

  // Creates, fills with zeros, maps and seals; checks that all seals hold. On failure returns false with one line in error.
  bool create(const char* name, std::size_t size, SegmentAccess access, std::string& error);

  int fd() const { return fd_; }
  std::size_t size() const { return size_; }
  void* memory() const { return memory_; }  // null unless kKernelWrites
  const void* view() const { return memory_view_; }

 private:
  int fd_ = -1;
  std::size_t size_ = 0;
  void* memory_ = nullptr;
  const void* memory_view_ = nullptr;
};

}  // namespace berm::kernel
