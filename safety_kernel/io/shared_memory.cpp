#include "io/shared_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace berm::kernel {

namespace {

bool fail(const char* name, const char* what, std::string& error) {
  error = std::string("shared memory ") + name + ": " + what + ": " + std::strerror(errno);
  return false;
}

}  // namespace

SharedSegment::~SharedSegment() {
  if (memory_view_ != nullptr) munmap(const_cast<void*>(memory_view_), size_);
  if (fd_ >= 0) close(fd_);
}

bool SharedSegment::create(const char* name, std::size_t size, SegmentAccess access, std::string& error) {
  fd_ = memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (fd_ < 0) return fail(name, "memfd_create", error);
  // posix_fallocate, not ftruncate alone: every page exists before the first cycle.
  const int full = posix_fallocate(fd_, 0, static_cast<off_t>(size));
  if (full != 0) {
    errno = full;
    return fail(name, "allocate", error);
  }
  const bool kernel_writes = access == SegmentAccess::kKernelWrites;
  const int protection = kernel_writes ? PROT_READ | PROT_WRITE : PROT_READ;
  void* mapped = mmap(nullptr, size, protection, MAP_SHARED | MAP_POPULATE, fd_, 0);
  if (mapped == MAP_FAILED) return fail(name, "mmap", error);
  memory_view_ = mapped;
  memory_ = kernel_writes ? mapped : nullptr;
  size_ = size;
  const int seals = F_SEAL_GROW | F_SEAL_SHRINK | F_SEAL_SEAL | (kernel_writes ? F_SEAL_FUTURE_WRITE : 0);
  if (fcntl(fd_, F_ADD_SEALS, seals) != 0) return fail(name, "seal", error);
  if (fcntl(fd_, F_GET_SEALS) != seals) return fail(name, "the seals do not hold", error);
  return true;
}

}  // namespace berm::kernel
