// Copies of a machine file and a scenario in which the workspace is watched: what the launcher is given, so that kernel, app and plant run as ever.
#pragma once

#include <optional>
#include <string>

namespace berm::watch {

struct WatchedFiles {
  std::string scenario, machine, site;  // paths; the first two are the copies, in the folder
};

// The text of a TOML file with the value of a key replaced, nothing else; table "" is the top. Throws std::runtime_error naming both when the key is
// not there.
std::string with_value(const std::string& text, const std::string& table, const std::string& key, const std::string& value);

// scenario, machine: name or file. machine empty: the scenario's; else the scenario gets it, and the plant's profile that goes with it.
// histogram: the kernel compares with histograms, whatever the machine says. max_time_s: the run ends then at the latest, instead of when the scenario says. Throws with one line naming the file and what is wrong in it.
WatchedFiles write_watched(const std::string& scenario, const std::string& machine, bool histogram, std::optional<double> max_time_s,
                           const std::string& folder);

}  // namespace berm::watch
