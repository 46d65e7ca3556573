// Writes an MCAP file with chunks, their CRCs and a full summary. Uncompressed. Each chunk reaches the file when it is full, so that a file
// whose writer was killed is readable up to there. The bytes are a function of what was written, not of when.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "journal/bytes.hpp"
#include "journal/mcap_format.hpp"

namespace berm::record {

class McapWriter {
 public:
  static constexpr std::size_t kChunkBytes = 1U << 20;
  static constexpr std::uint64_t kChunkNs = 1000000000;  // of log time: what a killed writer can lose

  // fd: open for writing, at its begin; stays the caller's.
  explicit McapWriter(int fd) : fd_(fd) {}

  // All of these return false when the file cannot be written; error() then says why, and nothing more is written.
  bool begin(const std::string& library);
  bool attachment(const std::string& name, const std::string& media_type, std::uint64_t log_ns, const void* bytes, std::size_t size);
  bool metadata(const std::string& name, const TextMap& map);
  bool message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_ns, const void* bytes, std::size_t size);
  bool end();

  // Before the first message; ids count from 1.
  std::uint16_t schema(const std::string& name, const std::string& encoding, const std::string& data);
  std::uint16_t channel(std::uint16_t schema, const std::string& topic, const std::string& encoding);

  const std::string& error() const { return error_; }
  std::uint64_t position() const { return position_; }

 private:
  struct ChunkIndex {
    std::uint64_t first_ns, last_ns, offset, length, index_length, size;
    std::map<std::uint16_t, std::uint64_t> index_offset;
  };
  bool write(const ByteWriter& bytes);
  bool record(std::uint8_t code, const ByteWriter& content);
  bool close_chunk();
  bool summary();
  void count(std::uint16_t channel, std::uint64_t log_ns);

  int fd_;
  std::string error_;
  std::uint64_t position_ = 0;
  std::uint32_t crc_ = 0;  // of the data section, then of the summary
  std::vector<ByteWriter> schemas_, channels_, attachments_, metadata_;  // contents; the last two as index records
  ByteWriter chunk_;
  std::uint64_t chunk_first_ns_ = 0, chunk_last_ns_ = 0;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_index_;
  std::vector<ChunkIndex> chunks_;
  std::uint64_t messages_ = 0, first_ns_ = 0, last_ns_ = 0;
  std::map<std::uint16_t, std::uint64_t> channel_messages_;
};

}  // namespace berm::record
