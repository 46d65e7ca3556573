// The app's link to the kernel, between any two of its instructions: a request is never seen half written under an even guard, and a state that the
// kernel writes meanwhile is never taken half.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <thread>

#include "app/kernel_link.hpp"
#include "scratch.hpp"
#include "send_descriptors.hpp"
#include "single_stepped.hpp"

namespace berm::app {
namespace {

template <class T>
T filled(int byte) {
  T object;
  std::memset(static_cast<void*>(&object), byte, sizeof object);
  return object;
}

template <class T>
bool same(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// Both segments, and the greeting that gives them away.
class Kernel {
 public:
  Kernel() : listener_(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, path().c_str());
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
    state = mapped<berm_state_segment>(fd_[0]);
    request = mapped<berm_request_segment>(fd_[1]);
    state->magic = BERM_CONTRACT_MAGIC;
    state->version = BERM_CONTRACT_VERSION;
    state->size = sizeof *state;
    greeter_ = std::thread([this] { greet(); });
  }
  ~Kernel() {
    greeter_.join();
    munmap(state, sizeof *state);
    munmap(request, sizeof *request);
    for (const int fd : {listener_, peer_, fd_[0], fd_[1]}) close(fd);
  }
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;
  std::string path() const { return scratch_.path("socket"); }

  // IF-CT-14 in two parts; whole, the second at once.
  void begin_state(const berm_state& next) const {
    __atomic_add_fetch(&state->state_guard, 1U, __ATOMIC_SEQ_CST);
    std::memcpy(&state->state, &next, sizeof next / 2);
  }
  void end_state(const berm_state& next) const {
    std::memcpy(&state->state, &next, sizeof next);
    __atomic_add_fetch(&state->state_guard, 1U, __ATOMIC_SEQ_CST);
  }

  berm_state_segment* state = nullptr;
  berm_request_segment* request = nullptr;

 private:
  template <class T>
  static T* mapped(int& fd) {
    fd = static_cast<int>(syscall(SYS_memfd_create, "segment", MFD_ALLOW_SEALING | MFD_CLOEXEC));
    EXPECT_EQ(ftruncate(fd, sizeof(T)), 0);
    EXPECT_EQ(fcntl(fd, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW), 0);
    return static_cast<T*>(mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0));
  }
  void greet() {
    peer_ = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    char role = 0;
    EXPECT_EQ(recv(peer_, &role, 1, 0), 1);
    berm_welcome welcome{BERM_CONTRACT_MAGIC, BERM_CONTRACT_VERSION, 1, sizeof(berm_state_segment), sizeof(berm_request_segment), ""};
    EXPECT_TRUE(test::send_descriptors(peer_, &welcome, sizeof welcome, fd_));
  }

  const test::Scratch scratch_;
  int listener_ = -1, peer_ = -1, fd_[2] = {-1, -1};
  std::thread greeter_;
};

class KernelLinkTest : public ::testing::Test {
 protected:
  Kernel kernel;
  KernelLink link{kernel.path()};
};

// verifies: IF-CT-8 (the app's order)
TEST_F(KernelLinkTest, ARequestChangesUnderAnOddGuardOnly) {
  const auto former = filled<berm_request>(0x11), next = filled<berm_request>(0xEE);
  link.write(former);
  const std::uint32_t before = kernel.request->guard;
  ASSERT_EQ(before % 2, 0U);
  long half = 0;
  test::single_stepped([&] { link.write(next); },
                       [&](long step) {
                         const std::uint32_t guard = __atomic_load_n(&kernel.request->guard, __ATOMIC_ACQUIRE);
                         const bool is_former = same(kernel.request->request, former), is_next = same(kernel.request->request, next);
                         if (guard == before) ASSERT_TRUE(is_former) << "the bytes changed under an even guard, step " << step;
                         else if (guard == before + 2) ASSERT_TRUE(is_next) << "the guard is even before the bytes are whole, step " << step;
                         else ASSERT_EQ(guard, before + 1) << "step " << step;
                         half += !is_former && !is_next;
                       });
  EXPECT_EQ(kernel.request->guard, before + 2);
  EXPECT_GT(half, 0) << "the write was never seen half done: nothing was tested";
}

// The kernel writes a state at each instruction of the reader, at once and with some instructions between its begin and its end.
// verifies: IF-CT-14 (a reader)
TEST_F(KernelLinkTest, AStateThatIsWrittenMeanwhileIsNeverTakenHalf) {
  struct Read {
    bool good;
    berm_state state;
  };
  const auto read = test::shared<Read>();
  const auto former = filled<berm_state>(0x11), next = filled<berm_state>(0xEE);
  const auto work = [&] { read->good = link.read(read->state); };
  work();  // what the first call of a library's function looks up is looked up
  const long undisturbed = test::single_stepped(work, [](long) {});
  int formers = 0, nexts = 0;
  std::printf("%ld instructions\n", undisturbed);
  for (const long lasts : {0L, 3L, 20L}) {
    for (long at = 0; at < undisturbed; ++at) {
      kernel.begin_state(former);
      kernel.end_state(former);
      read->good = false;
      test::single_stepped(work, [&](long step) {
        if (step == at) kernel.begin_state(next);
        if (step == at + lasts) kernel.end_state(next);
      }, at + lasts);
      if (kernel.state->state_guard % 2 != 0) kernel.end_state(next);  // the reader was done before
      ASSERT_TRUE(read->good) << "written at " << at;
      const bool is_former = same(read->state, former), is_next = same(read->state, next);
      ASSERT_TRUE(is_former || is_next) << "half of each: written at instruction " << at << ", for " << lasts;
      formers += is_former;
      nexts += is_next;
    }
  }
  EXPECT_GT(formers, 0);
  EXPECT_GT(nexts, 0);
}

// verifies: IF-CT-14 (a reader bounds its attempts)
TEST_F(KernelLinkTest, AKernelThatDiedInAWriteIsNotWaitedForWithoutEnd) {
  const auto state = filled<berm_state>(0x11);
  berm_state out{};
  kernel.begin_state(state);
  EXPECT_FALSE(link.read(out));
  kernel.end_state(state);
  EXPECT_TRUE(link.read(out));
  EXPECT_TRUE(same(out, state));
}

}  // namespace
}  // namespace berm::app
