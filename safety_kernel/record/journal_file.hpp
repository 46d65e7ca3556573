// The journal as an MCAP file: what goes into which channel, and what a reader of it looks for. JOURNAL.md is the normative text.
#pragma once

#include <cstdint>
#include <string>

#include "io/vlp16.hpp"
#include "journal/journal_names.hpp"
#include "journal/journal_record.h"
#include "journal/mcap_reader.hpp"
#include "record/mcap_writer.hpp"

namespace berm::record {

class JournalFile {
 public:
  explicit JournalFile(int fd) : mcap_(fd) {}
  // All return false when the file cannot be written; error() says why.
  bool begin(const berm_journal_start& start);
  // One record of the ring. A gap in the sequence is written down as lost.
  bool cycle(const std::uint8_t* record, std::size_t size);
  // offered: all records of the kernel; those never seen are lost.
  bool end(std::uint64_t offered);

  std::uint64_t cycles() const { return cycles_; }
  std::uint64_t lost() const { return lost_; }
  std::uint64_t bytes() const { return mcap_.position(); }
  const std::string& error() const { return mcap_.error(); }

 private:
  bool note_lost(std::uint64_t sequence, std::uint64_t before_cycle);

  McapWriter mcap_;
  std::uint16_t cycle_channel_ = 0, decision_channel_ = 0, lost_channel_ = 0;
  std::uint64_t next_sequence_ = 0;
  std::uint64_t cycles_ = 0, lost_ = 0, last_cycle_ = 0, log_ns_ = 0;
};

// Start conditions out of a file's metadata; false with what is missing or wrong in error.
struct StartConditions {
  bool map_only = false;
  kernel::Vlp16Mount mount;
};
bool read_start(const TextMap& map, StartConditions& start, std::string& error);
// A decimal number without sign, whole; false otherwise.
bool read_number(const TextMap& map, const std::string& key, std::uint64_t& value);

}  // namespace berm::record
