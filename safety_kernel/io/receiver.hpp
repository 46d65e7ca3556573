// Gathers what arrived since the cycle before: frames, scan packets, lidar packets. Bounded work each cycle, whatever the senders do.
#pragma once

#include <cstdint>
#include <string>

#include "can/can_transport.hpp"
#include "io/cycle.hpp"
#include "io/options.hpp"
#include "io/peers.hpp"
#include "io/udp_receiver.hpp"

namespace berm::kernel {

struct ReceiverCounters {
  std::uint64_t frames_overrun = 0;   // more frames in one cycle than it takes
  std::uint64_t scan_packets = 0;     // decoded
  std::uint64_t scan_rejected = 0;    // not decodable, or too many in one cycle
  std::uint64_t scan_missing = 0;     // announced by the clock frame and never here (lockstep)
  std::uint64_t vlp16_packets = 0;
  std::uint64_t vlp16_rejected = 0;
  std::uint64_t vlp16_points = 0;
  std::uint64_t lidar_packets = 0;    // of the lidars on the upper body
  std::uint64_t lidar_rejected = 0;   // of another size, or too many in one cycle
};

class Receiver {
 public:
  explicit Receiver(const Options& options) : options_(options) {}

  bool open(std::string& error);
  // Realtime: takes what is here, without waiting.
  void gather(CycleInputs& in);
  // Lockstep: frames up to the next clock frame, then the scan packets it announces. False when stop was set before it came.
  bool gather_lockstep(CycleInputs& in, const volatile int& stop, PeerServer& peers);

  can::Transport& can() { return can_; }
  const can::Transport& can() const { return can_; }
  const ReceiverCounters& counters() const { return counters_; }
  std::uint64_t frames_rejected() const { return counters_.frames_overrun + can_.counters().wrong_length; }

 private:
  static constexpr int kDatagramsPerCycle = 256;  // of the scanners, good or bad
  static constexpr int kWaitMs = 10;              // then newcomers are greeted and the stop flag is looked at
  static constexpr int kScanWaitMs = 200;         // for announced packets

  void add_frame(const berm_can_frame& frame, CycleInputs& in);
  bool take_scan(CycleInputs& in);
  bool take_vlp16(CycleInputs& in);
  bool take_lidar(CycleInputs& in);
  void await_scans(std::uint32_t announced, CycleInputs& in);

  const Options& options_;
  can::Transport can_;
  UdpReceiver scan_;
  UdpReceiver vlp16_;
  UdpReceiver lidar_[BERM_LIDARS];
  Vlp16Packet vlp16_packet_{};
  ReceiverCounters counters_;
  std::uint32_t datagrams_ = 0;      // of all scan ports since start, and those given up
  std::int64_t last_clock_ = -1;
};

}  // namespace berm::kernel
