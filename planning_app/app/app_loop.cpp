#include "app/app_loop.hpp"

#include <sys/socket.h>

#include <cerrno>

namespace berm::app {

namespace {

constexpr int wait_ms = 100;
constexpr std::uint64_t map_every = 25;  // cycles; the kernel needs about as many to publish its whole map

bool send_tick(int fd, const Tick& tick) {
  if (fd < 0) return true;
  for (;;) {
    if (::send(fd, &tick, sizeof tick, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof tick)) return true;
    if (errno != EINTR) return false;
  }
}

void tell(const ProjectionCheck::Disagreement& d, const ProgressLog& log) {
  log.event("projection_disagrees", {{"time_s", d.time_s}, {"scanner", d.scanner == 0 ? "left" : "right"}, {"distance_m", d.distance()},
                                     {"x_m", d.here[0]}, {"y_m", d.here[1]}, {"z_m", d.here[2]},
                                     {"kernel_x_m", d.kernel[0]}, {"kernel_y_m", d.kernel[1]}, {"kernel_z_m", d.kernel[2]}});
}

}  // namespace

LoopEnd run_loop(const MachineModel& machine, KernelLink& link, ScanIntake& intake, Sequencer& sequencer, const ProgressLog& log, int tick_fd,
                 const volatile std::sig_atomic_t& stop) {
  bool told = false;
  std::uint64_t handled = 0;
  bool any = false;
  std::uint32_t sequence = 0;
  berm_state state;
  while (!stop) {
    const std::uint32_t seen = link.wake();
    if (!link.read(state) || seen == 0 || (any && state.cycle == handled)) {
      link.wait(seen, wait_ms);
      if (link.wake() == seen && link.kernel_gone()) return LoopEnd::kernel_gone;
      continue;
    }
    handled = state.cycle;
    any = true;
    intake.take(link.segment(), sequencer.terrain(), sequencer.bed(), sequencer.sweep());
    if (!told && intake.check().first()) {
      tell(*intake.check().first(), log);
      told = true;
    }
    if (state.cycle % map_every == 0) sequencer.kernel_map().take(link.segment());
    const Answer answer = sequencer.step(observe(state));
    link.write(make_request(machine, answer, ++sequence, state.time_us));
    if (!send_tick(tick_fd, {state.cycle, sequencer.finished() ? tick_finished : 0u, 0u})) return LoopEnd::tick_peer_gone;
  }
  return LoopEnd::stopped;
}

}  // namespace berm::app
