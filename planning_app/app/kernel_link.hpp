// The app's side of the contract: greets the kernel, maps both segments, reads the state and writes requests.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "contract/berm_contract.h"

namespace berm::app {

struct LinkError : std::runtime_error { using std::runtime_error::runtime_error; };

class KernelLink {
public:
  // Connects, sends the role, receives the welcome and both segments, maps the state read-only and the request read-write, checks sizes,
  // seals, magic and version. Retries for a few seconds while nobody listens. Throws LinkError with one line.
  explicit KernelLink(const std::string& socket_path);
  ~KernelLink();
  KernelLink(const KernelLink&) = delete;
  KernelLink& operator=(const KernelLink&) = delete;

  const berm_state_segment& segment() const { return *state_; }
  int socket_fd() const { return socket_; }

  // A consistent copy of the newest state. False when the kernel was writing all the time.
  bool read(berm_state& out) const;
  // Waits until the wake word differs from seen, at most timeout_ms.
  void wait(std::uint32_t seen, int timeout_ms) const;
  std::uint32_t wake() const;
  // Guard odd, request, guard even.
  void write(const berm_request& request);
  // The kernel has closed its end.
  bool kernel_gone() const;

private:
  int socket_ = -1;
  const berm_state_segment* state_ = nullptr;
  berm_request_segment* request_ = nullptr;
};

}  // namespace berm::app
