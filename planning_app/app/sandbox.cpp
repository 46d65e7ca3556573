#include "app/sandbox.hpp"

#include <fcntl.h>
#include <linux/futex.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <memory>
#include <string>

namespace berm::app {

namespace {

class Filter {
public:
  Filter() : context_(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release) {
    if (!context_) throw SandboxError("seccomp: cannot create a filter");
  }
  void allow(int call) { check(seccomp_rule_add_array(context_.get(), SCMP_ACT_ALLOW, call, 0, nullptr)); }
  void allow(int call, const scmp_arg_cmp& condition) { check(seccomp_rule_add_array(context_.get(), SCMP_ACT_ALLOW, call, 1, &condition)); }
  void kill(int call) { check(seccomp_rule_add_array(context_.get(), SCMP_ACT_KILL_PROCESS, call, 0, nullptr)); }
  // Of every thread, those that run already as well.
  void load() {
    check(seccomp_attr_set(context_.get(), SCMP_FLTATR_CTL_TSYNC, 1));
    check(seccomp_load(context_.get()));
  }

private:
  static void check(int result) {
    if (result < 0) throw SandboxError(std::string("seccomp: ") + std::strerror(-result));
  }
  std::unique_ptr<void, decltype(&seccomp_release)> context_;
};

scmp_arg_cmp equals(unsigned argument, std::uint64_t value) { return {argument, SCMP_CMP_MASKED_EQ, 0xFFFFFFFFu, value}; }
scmp_arg_cmp lacks(unsigned argument, std::uint64_t bit) { return {argument, SCMP_CMP_MASKED_EQ, bit, 0}; }

}  // namespace

void close_all_but(std::vector<int> keep) {
  std::sort(keep.begin(), keep.end());
  unsigned from = 3;
  for (const int fd : keep) {
    if (fd < static_cast<int>(from)) continue;
    const unsigned kept = static_cast<unsigned>(fd);
    if (kept > from) ::syscall(SYS_close_range, from, kept - 1, 0);
    from = kept + 1;
  }
  ::syscall(SYS_close_range, from, UINT_MAX, 0);
}

void enter_sandbox(int kernel_fd, int tick_fd) {
  if (::prctl(PR_SET_DUMPABLE, 0) != 0) throw SandboxError(std::string("prctl: ") + std::strerror(errno));
  Filter filter;
  for (const int call : {SCMP_SYS(futex), SCMP_SYS(munmap), SCMP_SYS(brk), SCMP_SYS(madvise), SCMP_SYS(mremap), SCMP_SYS(clock_gettime), SCMP_SYS(clock_getres),
                         SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep), SCMP_SYS(restart_syscall), SCMP_SYS(rt_sigreturn), SCMP_SYS(rt_sigprocmask),
                         SCMP_SYS(exit), SCMP_SYS(exit_group), SCMP_SYS(close), SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(sched_yield)})
    filter.allow(call);
  filter.allow(SCMP_SYS(mmap), lacks(2, PROT_EXEC));
  filter.allow(SCMP_SYS(mprotect), lacks(2, PROT_EXEC));
  for (const int fd : {1, 2}) filter.allow(SCMP_SYS(write), equals(0, static_cast<std::uint64_t>(fd)));
  filter.allow(SCMP_SYS(recvfrom), equals(0, static_cast<std::uint64_t>(kernel_fd)));
  if (tick_fd >= 0)
    for (const int call : {SCMP_SYS(sendto), SCMP_SYS(sendmsg)}) filter.allow(call, equals(0, static_cast<std::uint64_t>(tick_fd)));
  filter.kill(SCMP_SYS(execve));
  filter.kill(SCMP_SYS(execveat));
  filter.load();
}

}  // namespace berm::app
