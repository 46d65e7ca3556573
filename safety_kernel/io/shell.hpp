// The imperative shell around Cycle: opens everything, feeds each cycle, sends and publishes what comes out.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "io/clock.hpp"
#include "io/cpu_histogram.hpp"
#include "io/cycle.hpp"
#include "io/journal.hpp"
#include "io/options.hpp"
#include "io/peers.hpp"
#include "io/publisher.hpp"
#include "io/receiver.hpp"
#include "io/shared_memory.hpp"

namespace berm::kernel {

class Shell {
 public:
  Shell(const Options& options, const berm_parameters& parameters);

  // Sockets and shared memory; then says ready. False with one line in error.
  bool open(std::string& error);
  // Cycles until stop becomes non-zero.
  void run(const volatile int& stop);
  // One line of JSON.
  std::string report() const;

 private:
  bool next_cycle(CycleTimer& timer, const volatile int& stop);
  void take_request();
  void one_cycle();
  void say_ready() const;

  const Options& options_;
  const berm_parameters& parameters_;
  SharedSegment state_;
  SharedSegment request_;
  Journal journal_;
  PeerServer peers_;
  Receiver receiver_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<Cycle> cycle_;
  std::unique_ptr<CycleInputs> in_;
  std::unique_ptr<CycleOutputs> out_;
  std::unique_ptr<CpuHistogram> cpu_;
  CycleWatch watch_;
  std::uint64_t cycles_ = 0;
  std::int64_t cpu_mark_us_ = 0;
};

// Asks for memory that is never paged out and a real-time priority; each refusal is one line on stderr, and the kernel goes on.
void ask_for_realtime();

}  // namespace berm::kernel
