// What `berm watch` was asked to do.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace berm::watch {

// What trials and quiet hours are of when no machine is named: the one whose file says that its workspace is watched.
inline constexpr const char* drawn_machine = "zx200_ring";

struct Options {
  std::string scenario;            // one of these three
  int intrusions = 0;
  double quiet_hours = 0.0;
  std::uint64_t seed = 1;
  int only = -1;                   // of the intrusions
  bool while_learning = false;     // they begin while the kernel still learns the ground's heights
  int jobs = 0;
  int trucks = 1;                  // of the scenario
  std::optional<double> max_time_s;
  std::string machine;             // empty: the scenario's, or `drawn_machine`
  bool histogram = false;          // whatever the machine says
  std::string json, picture, out, trace;
};

// Reads the command line; the exit status when the program should end now.
std::optional<int> read_options(int argc, char** argv, Options& options);

}  // namespace berm::watch
