#include "cycle_rig.hpp"

#include <algorithm>
#include <cstring>

namespace berm::kernel::test {

CycleRig::CycleRig(const berm_parameters& block)
    : parameters(block),
      machine(parameters),
      cycle(std::make_unique<Cycle>(parameters, false)),
      in(std::make_unique<CycleInputs>()),
      out(std::make_unique<CycleOutputs>()) {
  in->app_connected = true;
  in->app_connections = 1;
}

void CycleRig::face_a_swing_to_the_left() {
  machine.angle_rad[0] = 0.4;
  machine.pan_low_rad = -0.3;
  machine.pan_high_rad = 2.2;
}

void CycleRig::step() {
  gather();
  cycle->step(*in, *out);
  obey();
}

void CycleRig::gather() {
  // The app answers the state of the cycle before.
  if (app_talks && machine.cycle() > 0) {
    const berm_request request = berm::test::make_request(++request_sequence_, out->state.time_us, wanted_urad_s);
    std::memcpy(in->request, &request, sizeof request);
  }
  machine.step();
  in->clear();
  in->cycle = machine.cycle();
  in->now_us = machine.time_us();
  for (const auto& frame : machine.frames()) in->frame[in->frame_count++] = frame;
  for (const auto& frame : extra_frames) in->frame[in->frame_count++] = frame;
  extra_frames.clear();
  for (const auto& packet : machine.packets()) in->packet[in->packet_count++] = packet;
}

void CycleRig::obey() {
  machine.obey({out->frames.frame, out->frames.frame + out->frames.count});
}

bool CycleRig::reach_state(int state_wanted, int limit_cycles) {
  for (int i = 0; i < limit_cycles; ++i) {
    step();
    if (state().kernel_state == state_wanted) return true;
  }
  return false;
}

const berm_can_frame* CycleRig::sent(std::uint32_t id) const {
  for (int i = out->frames.count - 1; i >= 0; --i)
    if (out->frames.frame[i].id == id) return &out->frames.frame[i];
  return nullptr;
}

}  // namespace berm::kernel::test
