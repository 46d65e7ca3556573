// After start the app can neither reach anything nor become anything else.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <functional>
#include <thread>
#include <vector>

#include "app/sandbox.hpp"

namespace {

using namespace berm::app;

// Runs body in a child inside the sandbox; returns the wait status. The body's result is the exit code.
int in_sandbox(const std::function<int(int tick)>& body) {
  int pair[2];
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, pair), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pair[0]);
    enter_sandbox(pair[1], pair[1]);
    ::_exit(body(pair[1]));
  }
  ::close(pair[1]);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  ::close(pair[0]);
  return status;
}

// 0 when the call failed with EPERM.
int refused(long result) { return result == -1 && errno == EPERM ? 0 : 1; }

void expect_refused(const char* what, const std::function<long()>& call) {
  const int status = in_sandbox([&](int) { return refused(call()); });
  ASSERT_TRUE(WIFEXITED(status)) << what << " ended by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0) << what << " was not refused with EPERM";
}

TEST(Sandbox, RefusesEveryWayOut) {
  expect_refused("socket AF_CAN", [] { return static_cast<long>(::socket(AF_CAN, SOCK_RAW, 1)); });
  expect_refused("socket AF_INET", [] { return static_cast<long>(::socket(AF_INET, SOCK_DGRAM, 0)); });
  expect_refused("socket AF_UNIX", [] { return static_cast<long>(::socket(AF_UNIX, SOCK_STREAM, 0)); });
  expect_refused("connect", [] { sockaddr address{}; return static_cast<long>(::connect(1, &address, sizeof address)); });
  expect_refused("open", [] { return static_cast<long>(::open("/dev/null", O_RDONLY)); });
  expect_refused("openat", [] { return ::syscall(SYS_openat, AT_FDCWD, "/proc/self/mem", O_RDWR); });
  expect_refused("memfd_create", [] { return ::syscall(SYS_memfd_create, "x", 0); });
  expect_refused("fork", [] { return ::syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0); });
  expect_refused("ptrace", [] { return ::syscall(SYS_ptrace, 0, 0, 0, 0); });
  expect_refused("kill", [] { return static_cast<long>(::kill(::getppid(), 0)); });
  expect_refused("mmap executable", [] { return reinterpret_cast<long>(::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)); });
  expect_refused("sendto elsewhere", [] { return static_cast<long>(::sendto(1, "x", 1, 0, nullptr, 0)); });
  expect_refused("write elsewhere", [] { return static_cast<long>(::write(0, "x", 1)); });
}

// A thread that ran before, as the recogniser's does.
TEST(Sandbox, HoldsThreadsThatRunAlready) {
  int pair[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, pair), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    std::atomic<int> stage{0};
    std::thread thread([&] {
      stage = 1;
      while (stage == 1) ::sched_yield();
      std::vector<double> memory(4'000'000, 1.0);
      stage = ::open("/dev/null", O_RDONLY) == -1 && errno == EPERM && memory.back() == 1.0 ? 3 : 4;
    });
    while (stage == 0) ::sched_yield();
    enter_sandbox(pair[1], pair[1]);
    stage = 2;
    while (stage == 2) ::sched_yield();
    ::_exit(stage == 3 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  ::close(pair[0]);
  ::close(pair[1]);
}

TEST(Sandbox, KillsAProcessThatWouldBecomeAnother) {
  const int status = in_sandbox([](int) {
    char* const arguments[] = {const_cast<char*>("/bin/true"), nullptr};
    ::execve("/bin/true", arguments, nullptr);
    return 0;
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGSYS);
}

TEST(Sandbox, AllowsWhatTheLoopNeeds) {
  const int status = in_sandbox([](int tick) {
    std::vector<double> memory(4'000'000, 1.0);  // malloc by mmap
    memory.resize(8'000'000);
    timespec now{}, pause{0, 1000};
    if (::clock_gettime(CLOCK_MONOTONIC, &now) != 0) return 2;
    if (::nanosleep(&pause, nullptr) != 0) return 3;
    if (::send(tick, memory.data(), 16, MSG_NOSIGNAL) != 16) return 4;
    char byte = 0;
    if (::recv(tick, &byte, 1, MSG_DONTWAIT) != -1 || errno != EAGAIN) return 5;
    if (::write(2, "", 0) != 0) return 6;
    return memory.back() == 0.0 ? 0 : 7;
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(CloseAllBut, KeepsOnlyWhatIsNamed) {
  const pid_t child = ::fork();
  if (child == 0) {
    const int a = ::dup(1), b = ::dup(1), c = ::dup(1);
    close_all_but({b});
    const bool right = ::fcntl(a, F_GETFD) == -1 && ::fcntl(b, F_GETFD) != -1 && ::fcntl(c, F_GETFD) == -1 && ::fcntl(2, F_GETFD) != -1;
    ::_exit(right ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

}  // namespace
