// What stands between a commander and the machine in a trial in one process: the kernel's cycle, or nothing (for the nominal motion).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "can/berm_can.h"
#include "config/parameter_block.h"
#include "contract/berm_contract.h"
#include "plant/world/spinning_lidar.hpp"
#include "scan/scan_packet.h"

namespace berm::kernel {
class Cycle;
}

namespace berm::in_process {

// What arrived in a cycle, as it stands on the bus and in the datagrams.
struct Arrived {
  std::vector<berm_can_frame> frames;
  std::vector<berm_scan_packet> scans;
  std::vector<plant::LidarPacket> lidars;
};

class Supervisor {
 public:
  Supervisor() = default;
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;
  virtual ~Supervisor() = default;

  // One cycle of 10 ms: from what arrived to the frames for the machine.
  virtual const std::vector<berm_can_frame>& step(std::uint64_t cycle, const Arrived& arrived, const berm_request* request) = 0;
  virtual const berm_state& state() const = 0;
  virtual bool needs_scans() const = 0;
  // The kernel's own state, to look at; null where there is no kernel.
  virtual const kernel::Cycle* cycle() const { return nullptr; }
};

// The kernel as it ships: the very same cycle, fed in virtual time. It sees frames, packets and requests, and nothing else.
std::unique_ptr<Supervisor> make_kernel(const berm_parameters& parameters);
// Obeys: every request goes out. Its state is what the machine's frames say.
std::unique_ptr<Supervisor> make_obedient();

}  // namespace berm::in_process
