// What the kernel's whole cycle does not do, how much work it does at most, and how long that takes: under full load, publishing and journal included.
#include <gtest/gtest.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <vector>

#include "forbidden_calls.hpp"
#include "instruction_counter.hpp"
#include "loaded_kernel.hpp"

namespace berm::kernel::test {
namespace {

constexpr int kWarmUpCycles = 300;  // until RUN

long cycle_count(long otherwise) {
  const char* text = std::getenv("BERM_CYCLES");
  const long count = text != nullptr ? std::atol(text) : 0;
  return count > 0 ? count : otherwise;
}

double cpu_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

template <class Number>
Number quantile(std::vector<Number>& values, double share) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// At most: the request, two slower ones, and either a standstill or creeping; or the request and the room ahead.
std::uint32_t most_slices(const berm_parameters& parameters) { return 4U * static_cast<std::uint32_t>(parameters.parts) * swing_sub_intervals; }

void warm_up(LoadedKernel& kernel) {
  std::string error;
  ASSERT_TRUE(kernel.open(error)) << error;
  for (int i = 0; i < kWarmUpCycles; ++i) {
    kernel.gather();
    kernel.kernel_cycle();
    kernel.obey();
  }
}

// What the sandboxed child found; shared with the parent.
struct SystemCalls {
  volatile int in_cycles, others, last_other, finished, offered;
};
SystemCalls* found = nullptr;  // a signal handler has no other way

void on_system_call(int, siginfo_t* info, void*) {
  found->others = found->others + 1;
  found->last_other = info->si_syscall;
}

// From here on a system call that is not in the list does not happen, and is counted instead.
bool trap_system_calls() {
  struct sigaction action {};
  action.sa_sigaction = on_system_call;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_futex, 3, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_rt_sigreturn, 2, 0),  // of the counting itself
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 1, 0),    // of the child's end
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  sock_fprog program{static_cast<unsigned short>(sizeof filter / sizeof filter[0]), filter};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace

// The counters themselves: or the next test would say nothing.
TEST(CycleEvidence, TheCountersCount) {
  if (!forbidden_calls_count()) GTEST_SKIP() << "SKIPPED: malloc is the sanitizer's";
  ForbiddenCalls before = forbidden_calls();
  delete new std::vector<int>(100);
  EXPECT_GE(forbidden_calls().since(before).allocations, 2);
  before = forbidden_calls();
  try {
    throw 1;
  } catch (int) {
  }
  EXPECT_EQ(forbidden_calls().since(before).throws, 1);
  before = forbidden_calls();
  std::mutex mutex;
  mutex.lock();
  mutex.unlock();
  EXPECT_EQ(forbidden_calls().since(before).locks, 1);
}

// A million cycles: BERM_CYCLES=1000000 ./berm test -R CycleEvidence
// verifies: SK-CY-42
// verifies: SK-CY-43
// verifies: SK-CY-45
// verifies: SK-CY-46
TEST(CycleEvidence, NoAllocationThrowOrLockAndBoundedWork) {
  const long cycles = cycle_count(8000);
  LoadedKernel kernel;
  warm_up(kernel);
  std::vector<float> cpu(static_cast<std::size_t>(cycles));
  std::vector<std::uint64_t> instructions;
  instructions.reserve(static_cast<std::size_t>(cycles));
  const InstructionCounter counter;
  ForbiddenCalls forbidden;
  std::uint32_t slices = 0, cells = 0, points = 0;
  long running = 0, moving = 0, blocked = 0, too_many_cells = 0;
  for (long i = 0; i < cycles; ++i) {
    kernel.gather();
    const ForbiddenCalls before = forbidden_calls();
    const std::uint64_t instructions_before = counter.read();
    const double begin = cpu_us();
    kernel.kernel_cycle();
    cpu[static_cast<std::size_t>(i)] = static_cast<float>(cpu_us() - begin);
    if (counter.counts()) instructions.push_back(counter.read() - instructions_before);
    const ForbiddenCalls now = forbidden_calls().since(before);
    forbidden.allocations += now.allocations;
    forbidden.throws += now.throws;
    forbidden.locks += now.locks;
    const berm_decision& d = kernel.decision();
    slices = std::max<std::uint32_t>(slices, d.slices);
    cells = std::max(cells, d.cells);
    points = std::max(points, d.scan_points);
    too_many_cells += d.cells > d.slices * 1U * SK_MAP_CELLS * SK_MAP_CELLS ? 1 : 0;
    running += d.kernel_state == BERM_STATE_RUN ? 1 : 0;
    moving += d.commanded_urad_s[0] != 0 ? 1 : 0;
    blocked += d.blocked_height_mm != 0 ? 1 : 0;
    kernel.obey();
  }
  std::cout << cycles << " cycles of " << SK_MAP_CELLS << " x " << SK_MAP_CELLS << " cells of " << SK_CELL_MM << " mm: " << running << " in RUN, " << moving << " with a swing command, " << blocked
            << " with a blocking cell; " << forbidden.allocations << " allocations, " << forbidden.throws << " throws, " << forbidden.locks << " locks\n"
            << "CPU time of a cycle, us: median " << quantile(cpu, 0.5) << ", 99 % " << quantile(cpu, 0.99) << ", worst " << *std::max_element(cpu.begin(), cpu.end())
            << " (target: median 300)\n"
            << "most in a cycle: " << slices << " slices, " << cells << " cells, " << points << " points\n";
  if (counter.counts()) {
    std::cout << "instructions of a cycle: median " << quantile(instructions, 0.5) << ", most " << *std::max_element(instructions.begin(), instructions.end()) << "\n";
  } else {
    std::cout << "instructions: not counted here (no hardware counter)\n";
  }
  EXPECT_TRUE(!forbidden_calls_count() || forbidden.all() == 0);
  EXPECT_GT(running, cycles / 4);
  EXPECT_GT(moving, cycles / 10);
  EXPECT_GT(blocked, 0);
  EXPECT_GT(points, 1000U);
  EXPECT_LE(slices, most_slices(kernel.parameters()));
  EXPECT_EQ(too_many_cells, 0);
  EXPECT_LE(points, static_cast<std::uint32_t>(CycleInputs::kFootprints + CycleInputs::kPackets * BERM_SCAN_PACKET_SAMPLES));
  EXPECT_EQ(kernel.rejected(), 0U);
  EXPECT_EQ(kernel.journal_offered(), static_cast<std::uint64_t>(cycles + kWarmUpCycles));
}

// The child may do nothing but wake who waits for the published state.
// verifies: SK-CY-44
TEST(CycleEvidence, NoSystemCallButTheWake) {
  void* shared = mmap(nullptr, sizeof(SystemCalls), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  found = static_cast<SystemCalls*>(shared);
  constexpr int kCycles = 1200;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    LoadedKernel kernel;
    warm_up(kernel);
    for (int i = 0; i < 100; ++i) {  // what the world's part allocates is allocated by now
      kernel.gather();
      kernel.kernel_cycle();
      kernel.obey();
    }
    if (!trap_system_calls()) _exit(3);
    for (int i = 0; i < kCycles; ++i) {
      kernel.gather();
      const int before = found->others;
      kernel.kernel_cycle();
      found->in_cycles = found->in_cycles + (found->others - before);
      kernel.obey();
    }
    found->offered = static_cast<int>(kernel.journal_offered());
    found->others = 0;  // what the world's part asked for does not count; what follows must
    syscall(SYS_getpid);
    found->finished = 1;
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  ASSERT_EQ(WEXITSTATUS(status), 0) << "the filter was refused";
  EXPECT_EQ(found->finished, 1);
  EXPECT_EQ(found->others, 1) << "the trap does not count";
  EXPECT_EQ(found->last_other, SYS_getpid);
  EXPECT_EQ(found->in_cycles, 0) << "system calls of the cycle other than futex";
  EXPECT_EQ(found->offered, kCycles + kWarmUpCycles + 100);
  munmap(shared, sizeof(SystemCalls));
}

}  // namespace berm::kernel::test
