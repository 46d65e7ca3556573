// Feeds a journal's inputs to a fresh cycle of the kernel and compares everything that comes out with what was recorded.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "record/difference.hpp"

namespace berm::record {

struct ReplayResult {
  std::uint64_t cycles = 0;        // in the file
  std::uint64_t decisions = 0;     // replayed and compared
  std::uint64_t mismatches = 0;    // of them with any difference
  std::uint64_t lost = 0;          // records that the journal lost
  std::uint64_t not_replayed = 0;  // cycles behind a gap: the state there is not known
  std::uint64_t frames = 0, scan_packets = 0, lidar_packets = 0;  // the last of all lidars
  std::int64_t first_us = 0, last_us = 0;
  bool complete = false;           // the file has its end
  std::string incomplete_why;
  std::optional<Difference> first;
  std::uint64_t first_cycle = 0;
  std::int64_t first_difference_us = 0;
  bool reproduced() const { return complete && decisions > 0 && decisions == cycles && mismatches == 0 && lost == 0; }
};

// parameters: a block file to use instead of the recorded one; empty for the recorded one. progress is told the cycles so far. False with one
// line in error when the file is damaged or is no journal; a file that is only cut off is replayed as far as it goes.
bool replay(const std::string& path, const std::string& parameters, const std::function<void(std::uint64_t)>& progress, ReplayResult& result, std::string& error);

}  // namespace berm::record
