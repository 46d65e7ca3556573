// What `berm load` was asked to do.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "run/out_folder.hpp"

namespace berm::run {

enum class FaultKind { kill_app, stop_app, pause_app, kill_kernel, pause_kernel, kill_journal };

// A fault of a process at a virtual time, for demonstrations and tests: "kill-app@12.5", "pause-app@12.5+4", "pause-kernel@12.5+0.1".
struct ProcessFault {
  FaultKind kind;
  double at_s;
  double for_s = 0.0;  // of a pause: after this it goes on
};

struct RunOptions {
  std::string scenario = "bench";
  std::string scripts;  // a folder; empty: the app's own
  std::string soil;  // a name or a TOML file; empty: the scenario's own
  int trucks = 1;
  std::uint64_t seed = 1;
  bool realtime = false;
  std::string json;
  std::string out;  // empty: a temporary folder, removed afterwards
  std::shared_ptr<const OutFolder> out_held;  // out, of a caller that has taken it before the run; else the run takes it. Held as long as a copy of these is
  std::optional<ProcessFault> fault;
  bool quiet = false;
  bool picture = true;       // site.svg
  bool journal = true;       // else no journal is written: it grows by gigabytes an hour
  int silence_s = 5;         // of wall clock, after which the plant goes on without kernel or app
  int trace_every = 1;       // cycles from one row of the trace to the next
  bool report_when_interrupted = false;  // SIGINT or SIGTERM ends the run, and its result is of what ran; else that is an error
  double progress_every_s = 0.0;  // simulated; a line instead of one for each pass; 0: none
};

// Reads the command line; the exit status when the program should end now.
std::optional<int> read_options(int argc, char** argv, RunOptions& options);

}  // namespace berm::run
