// What a peer can and cannot do with the segments it is given.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "contract/berm_contract.h"
#include "io/shared_memory.hpp"

namespace berm::kernel {
namespace {

class Segments : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string error;
    ASSERT_TRUE(state.create("state", sizeof(berm_state_segment), SegmentAccess::kKernelWrites, error)) << error;
    ASSERT_TRUE(request.create("request", sizeof(berm_request_segment), SegmentAccess::kPeerWrites, error)) << error;
  }
  // Also by the way of /proc, which gives a descriptor of one's own.
  static int reopened(const SharedSegment& segment, int flags) {
    const std::string path = "/proc/self/fd/" + std::to_string(segment.fd());
    return open(path.c_str(), flags | O_CLOEXEC);
  }
  SharedSegment state, request;
};

// verifies: SK-CY-70, IF-CT-6, IF-CT-19 (that no reader can write there)
TEST_F(Segments, NobodyElseCanWriteTheStateSegment) {
  const int again = reopened(state, O_RDWR);
  for (const int fd : {state.fd(), again}) {
    if (fd < 0) continue;
    EXPECT_EQ(mmap(nullptr, state.size(), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0), MAP_FAILED);
    EXPECT_EQ(errno, EPERM);
    EXPECT_EQ(pwrite(fd, "x", 1, 0), -1);
    EXPECT_EQ(errno, EPERM);
    EXPECT_NE(fallocate(fd, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0, 4096), 0);
  }
  if (again >= 0) close(again);
}

// verifies: SK-CY-70, IF-CT-6
TEST_F(Segments, AReaderSeesWhatTheKernelWritesAndCannotMakeItWritable) {
  void* view = mmap(nullptr, state.size(), PROT_READ, MAP_SHARED, state.fd(), 0);
  ASSERT_NE(view, MAP_FAILED);
  static_cast<berm_state_segment*>(state.memory())->wake = 77;
  EXPECT_EQ(static_cast<const berm_state_segment*>(view)->wake, 77U);
  EXPECT_NE(mprotect(view, state.size(), PROT_READ | PROT_WRITE), 0);
  munmap(view, state.size());
}

// verifies: SK-CY-70, IF-CT-5 (the seals)
TEST_F(Segments, NobodyCanResizeEitherSegment) {
  for (const SharedSegment* segment : {&state, &request}) {
    EXPECT_EQ(ftruncate(segment->fd(), 0), -1);
    EXPECT_EQ(errno, EPERM);
    EXPECT_EQ(ftruncate(segment->fd(), static_cast<off_t>(segment->size() + 4096)), -1);
    EXPECT_EQ(errno, EPERM);
    EXPECT_NE(fcntl(segment->fd(), F_ADD_SEALS, F_SEAL_WRITE), 0) << "nor change the seals";
  }
}

// verifies: SK-CY-70, IF-CT-7
TEST_F(Segments, ThePeerWritesTheRequestSegmentAndTheKernelOnlyReads) {
  void* view = mmap(nullptr, request.size(), PROT_READ | PROT_WRITE, MAP_SHARED, request.fd(), 0);
  ASSERT_NE(view, MAP_FAILED);
  static_cast<berm_request_segment*>(view)->request.sequence = 5;
  EXPECT_EQ(static_cast<const berm_request_segment*>(request.view())->request.sequence, 5U);
  EXPECT_EQ(request.memory(), nullptr);
  munmap(view, request.size());
}

}  // namespace
}  // namespace berm::kernel
