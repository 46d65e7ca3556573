// A whole MCAP file as its records, for tests: found by their lengths alone, whatever the project's reader makes of them.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "journal/bytes.hpp"
#include "journal/mcap_format.hpp"

namespace berm::record {

struct McapRecord {
  std::uint8_t code = 0;
  std::uint64_t at = 0;  // of its code, in the file or in the chunk
  std::string content;
  std::uint64_t length() const { return content.size() + 9; }
  ByteReader fields() const { return {reinterpret_cast<const std::uint8_t*>(content.data()), content.size()}; }
};

inline std::vector<McapRecord> mcap_records(const std::string& bytes, std::uint64_t from, std::uint64_t to) {
  std::vector<McapRecord> records;
  for (std::uint64_t at = from; at < to;) {
    ByteReader head(reinterpret_cast<const std::uint8_t*>(bytes.data()) + at, to - at);
    const std::uint8_t code = head.u8();
    const std::uint64_t size = head.u64();
    if (!head.good() || size > head.left()) throw std::runtime_error("a record reaches beyond its place");
    records.push_back({code, at, bytes.substr(at + 9, size)});
    at += records.back().length();
  }
  return records;
}

struct McapMessage {
  std::uint16_t channel;
  std::uint64_t log_ns, offset;  // in its chunk
};

struct McapChunk {
  McapRecord record;
  std::uint64_t first_ns, last_ns, size, stored_size;
  std::uint32_t crc;
  std::string compression, records;
  std::vector<McapMessage> messages;
};

inline McapChunk mcap_chunk(const McapRecord& record) {
  McapChunk chunk{record, 0, 0, 0, 0, 0, {}, {}, {}};
  ByteReader in = record.fields();
  chunk.first_ns = in.u64();
  chunk.last_ns = in.u64();
  chunk.size = in.u64();
  chunk.crc = in.u32();
  chunk.compression = in.text();
  chunk.stored_size = in.u64();
  chunk.records.assign(reinterpret_cast<const char*>(in.raw(in.left())), record.content.size() - 32 - chunk.compression.size() - 8);
  for (const McapRecord& inner : mcap_records(chunk.records, 0, chunk.records.size())) {
    if (inner.code != op::kMessage) throw std::runtime_error("a chunk with something else than messages");
    ByteReader message = inner.fields();
    const std::uint16_t channel = message.u16();
    message.u32();
    chunk.messages.push_back({channel, message.u64(), inner.at});
  }
  return chunk;
}

}  // namespace berm::record
