// The kernel's cycle, its miniature machine and an app in one process, in virtual time.
#pragma once

#include <memory>

#include "io/cycle.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {

class CycleRig {
 public:
  explicit CycleRig(const berm_parameters& block = berm::test::demo_parameters());

  // App: asks for these velocities each cycle while talking.
  bool app_talks = true;
  std::int32_t wanted_urad_s[4] = {};
  std::vector<berm_can_frame> extra_frames;  // arrive after the machine's, once

  // Swung a little to the left, the scanners ahead of a swing that goes on that way.
  void face_a_swing_to_the_left();
  void step();
  // The same in three: what comes in, the kernel's cycle (cycle->step(*in, *out)), and the machine that obeys.
  void gather();
  void obey();
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  // Steps until the state is reached; false after the limit.
  bool reach_state(int state, int limit_cycles);

  const berm_state& state() const { return out->state; }
  // Newest frame with this id that was sent in this cycle; null when none was.
  const berm_can_frame* sent(std::uint32_t id) const;

  berm_parameters parameters;
  berm::test::MiniMachine machine;
  std::unique_ptr<Cycle> cycle;
  std::unique_ptr<CycleInputs> in;
  std::unique_ptr<CycleOutputs> out;

 private:
  std::uint32_t request_sequence_ = 0;
};

}  // namespace berm::kernel::test
