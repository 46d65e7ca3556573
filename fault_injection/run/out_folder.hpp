// The folder that a run writes to, for it alone: two runs in one would mix their files.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/output_file.hpp"

namespace berm::run {

// Makes the folder where there is none, and holds a lock on it, of which a killed run leaves nothing.
class OutFolder {
 public:
  explicit OutFolder(const std::string& path);  // throws std::runtime_error naming it: it cannot be made or written, or another run is at work in it
  ~OutFolder();
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

 private:
  int fd_ = -1;
};

// What a run leaves there when it is done.
inline constexpr std::array kRunFiles{"trace.csv", "truth.json", "terrain_start.csv", "terrain_end.csv", "terrain_start.csv.truck", "terrain_end.csv.truck",
                                      "journal.mcap", "app.jsonl", "site.svg", "result.json"};
// Those, for a look at what else is written there.
std::vector<config::NamedFile> run_files(const std::string& out);

// Removes what a former run left there, whole or begun, so that no folder mixes two runs: the names; empty for none.
std::string remove_former_run(const std::string& out);

}  // namespace berm::run
