// Runs a piece of work in a process of its own, instruction by instruction, so that a test sees, in memory that both share, the order of its stores and
// loads, and can come between any two of them. Shown is the order in the program; a processor that reorders stores is not.
#pragma once

#include <signal.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

namespace berm::test {

// One zeroed T in memory shared with children.
template <class T>
struct Unmapped {
  void operator()(T* at) const { munmap(static_cast<void*>(at), sizeof(T)); }
};
template <class T>
using Shared = std::unique_ptr<T, Unmapped<T>>;
template <class T>
Shared<T> shared() {
  void* at = mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (at == MAP_FAILED) throw std::bad_alloc();
  return Shared<T>(static_cast<T*>(at));
}

// Calls before_each(n) before instruction n of work, and once when it is done. Returns the number of instructions; behind instruction `most` the work
// goes on unwatched.
template <class Work, class BeforeEach>
long single_stepped(const Work& work, const BeforeEach& before_each, long most = std::numeric_limits<long>::max()) {
  const pid_t child = fork();
  if (child == 0) {
    const pid_t self = getpid();
    kill(self, 0);  // so that the dynamic linker's search for it is not among the instructions
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    kill(self, SIGSTOP);
    work();
    kill(self, SIGSTOP);
    _exit(0);
  }
  int status = 0;
  const auto stopped_by = [&](int signal) { return waitpid(child, &status, 0) == child && WIFSTOPPED(status) && WSTOPSIG(status) == signal; };
  if (child < 0 || !stopped_by(SIGSTOP)) throw std::runtime_error("a child cannot be traced here");
  long steps = 0;
  for (;; ++steps) {
    before_each(steps);
    if (ptrace(steps < most ? PTRACE_SINGLESTEP : PTRACE_CONT, child, nullptr, nullptr) != 0 || waitpid(child, &status, 0) != child || !WIFSTOPPED(status)) break;
    if (WSTOPSIG(status) != SIGTRAP) break;
  }
  const bool done = WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP;
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  if (!done) throw std::runtime_error("the work that was traced did not come to its end");
  return steps;
}

}  // namespace berm::test
