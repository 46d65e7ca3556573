// The app's loop: each of the kernel's cycles once, in; one request, and one tick, out.
#pragma once

#include <csignal>

#include "app/kernel_link.hpp"
#include "app/sequencer.hpp"
#include "perception/scan_intake.hpp"

namespace berm::app {

// The simulation-only message after each cycle.
struct Tick {
  std::uint64_t cycle;
  std::uint32_t flags;  // bit 0: finished
  std::uint32_t zero;
};
static_assert(sizeof(Tick) == 16);
inline constexpr std::uint32_t tick_finished = 1u;

enum class LoopEnd { stopped, kernel_gone, tick_peer_gone };

// Runs until stop is set, or the kernel or the tick's reader is gone. tick_fd -1: no tick. Where the app's points and the kernel's disagree it is
// told once.
LoopEnd run_loop(const MachineModel& machine, KernelLink& link, ScanIntake& intake, Sequencer& sequencer, const ProgressLog& log, int tick_fd,
                 const volatile std::sig_atomic_t& stop);

}  // namespace berm::app
