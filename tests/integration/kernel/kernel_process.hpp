// berm_kernel as a process in lockstep, with a miniature machine on its bus and an app or recorder on its socket.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "can/can_transport.hpp"
#include "contract/berm_contract.h"
#include "mini_machine.hpp"
#include "run/reserved_port.hpp"

namespace berm::test {

// An app's or recorder's connection to the kernel. Everything is released at the end.
class Peer {
 public:
  Peer(const std::string& socket_path, char role);
  ~Peer();
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  // After the kernel had a cycle to answer.
  bool receive_welcome();
  const berm_welcome& welcome() const { return welcome_; }
  int state_fd() const { return state_fd_; }
  int request_fd() const { return request_fd_; }
  const berm_state_segment* state() const { return state_; }
  void write_request(const berm_request& request);
  // As one who died while it wrote; the next write goes on from there.
  void leave_guard_odd() { __atomic_fetch_or(&request_->guard, 1U, __ATOMIC_RELEASE); }
  // Sends a byte with an open file, which the kernel does not want.
  bool hand_over(int fd);

 private:
  int socket_ = -1, state_fd_ = -1, request_fd_ = -1;
  berm_welcome welcome_{};
  const berm_state_segment* state_ = nullptr;
  berm_request_segment* request_ = nullptr;
};

class KernelProcess {
 public:
  // Starts it and waits until it is ready; extra options come last. started() tells.
  explicit KernelProcess(const std::vector<std::string>& extra = {"--lockstep"}, bool with_machine = true);
  ~KernelProcess();
  KernelProcess(const KernelProcess&) = delete;
  KernelProcess& operator=(const KernelProcess&) = delete;

  bool started() const { return started_; }
  const std::string& socket_path() const { return socket_path_; }
  std::uint16_t scan_port() const { return scan_port_.number(); }
  std::uint16_t vlp16_port() const { return vlp16_port_.number(); }

  // One cycle of the machine: frames, packets, clock; waits for the heartbeat of that cycle. False when none came in time.
  bool step();
  // The same, with the app answering the state it sees with this velocity.
  bool step_with(Peer& app, const std::int32_t (&velocity_urad_s)[4]);
  // Frames that go out before the clock frame of the next step, once.
  std::vector<berm_can_frame> extra_frames;
  // Sends raw bytes to a UDP port of the kernel; counts them as an announced scan packet when that is the scan port.
  void send_datagram(std::uint16_t port, const std::vector<std::uint8_t>& bytes);

  // Of the heartbeats on the bus in the next so many ms, and of those that waited there: the cycles that they are of.
  std::vector<std::uint16_t> hear(int ms);

  // Ends it with SIGTERM; the line it printed, empty when it did not end well.
  std::string end();

  std::unique_ptr<MiniMachine> machine;

 private:
  void start(const std::vector<std::string>& extra, bool with_machine);

  std::string folder_, socket_path_;
  const run::ReservedPort can_port_, scan_port_, vlp16_port_;
  pid_t pid_ = -1;
  int output_ = -1;
  int udp_ = -1;
  bool started_ = false;
  std::uint32_t packets_sent_ = 0;
  std::uint32_t request_sequence_ = 0;
  berm::can::Transport can_;
};

// The number behind "name": in a line of JSON; -1 when it is not there.
long json_number(const std::string& line, const std::string& name);

}  // namespace berm::test
