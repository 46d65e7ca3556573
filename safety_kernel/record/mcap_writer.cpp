#include "record/mcap_writer.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "scan/scan_packet.h"

namespace berm::record {

namespace {

constexpr std::size_t kMessageHeadBytes = 22;

void put_record(ByteWriter& to, std::uint8_t code, const ByteWriter& content) {
  to.u8(code);
  to.u64(content.size());
  to.raw(content.data(), content.size());
}

void put_map(ByteWriter& to, const TextMap& map) {
  ByteWriter entries;
  for (const auto& [key, value] : map) {
    entries.text(key);
    entries.text(value);
  }
  to.u32(static_cast<std::uint32_t>(entries.size()));
  to.raw(entries.data(), entries.size());
}

}  // namespace

bool McapWriter::write(const ByteWriter& bytes) {
  std::size_t done = 0;
  while (error_.empty() && done < bytes.size()) {
    const ssize_t n = ::write(fd_, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) error_ = n < 0 ? std::strerror(errno) : "nothing more can be written";
    else done += static_cast<std::size_t>(n);
  }
  if (!error_.empty()) return false;
  crc_ = berm_crc32_continue(crc_, bytes.data(), bytes.size());
  position_ += bytes.size();
  return true;
}

bool McapWriter::record(std::uint8_t code, const ByteWriter& content) {
  ByteWriter bytes;
  put_record(bytes, code, content);
  return write(bytes);
}

bool McapWriter::begin(const std::string& library) {
  ByteWriter bytes, header;
  bytes.raw(kMcapMagic, sizeof kMcapMagic);
  header.text("");
  header.text(library);
  put_record(bytes, op::kHeader, header);
  return write(bytes);
}

std::uint16_t McapWriter::schema(const std::string& name, const std::string& encoding, const std::string& data) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  ByteWriter content;
  content.u16(id);
  content.text(name);
  content.text(encoding);
  content.text(data);
  record(op::kSchema, content);
  schemas_.push_back(std::move(content));
  return id;
}

std::uint16_t McapWriter::channel(std::uint16_t schema, const std::string& topic, const std::string& encoding) {
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  ByteWriter content;
  content.u16(id);
  content.u16(schema);
  content.text(topic);
  content.text(encoding);
  put_map(content, {});
  record(op::kChannel, content);
  channels_.push_back(std::move(content));
  return id;
}

bool McapWriter::attachment(const std::string& name, const std::string& media_type, std::uint64_t log_ns, const void* bytes, std::size_t size) {
  if (!close_chunk()) return false;
  ByteWriter content;
  content.u64(log_ns);
  content.u64(0);
  content.text(name);
  content.text(media_type);
  content.u64(size);
  content.raw(bytes, size);
  content.u32(berm_crc32(content.data(), content.size()));
  ByteWriter index;
  index.u64(position_);
  index.u64(content.size() + 9);
  index.u64(log_ns);
  index.u64(0);
  index.u64(size);
  index.text(name);
  index.text(media_type);
  attachments_.push_back(std::move(index));
  return record(op::kAttachment, content);
}

bool McapWriter::metadata(const std::string& name, const TextMap& map) {
  if (!close_chunk()) return false;
  ByteWriter content;
  content.text(name);
  put_map(content, map);
  ByteWriter index;
  index.u64(position_);
  index.u64(content.size() + 9);
  index.text(name);
  metadata_.push_back(std::move(index));
  return record(op::kMetadata, content);
}

void McapWriter::count(std::uint16_t channel, std::uint64_t log_ns) {
  first_ns_ = messages_ == 0 ? log_ns : std::min(first_ns_, log_ns);
  last_ns_ = std::max(last_ns_, log_ns);
  ++messages_;
  ++channel_messages_[channel];
}

bool McapWriter::message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_ns, const void* bytes, std::size_t size) {
  const std::size_t length = kMessageHeadBytes + size;
  const bool late = chunk_.size() > 0 && log_ns > chunk_first_ns_ + kChunkNs;
  if ((late || chunk_.size() + 9 + length > kChunkBytes) && !close_chunk()) return false;
  chunk_first_ns_ = chunk_.size() == 0 ? log_ns : std::min(chunk_first_ns_, log_ns);
  chunk_last_ns_ = chunk_.size() == 0 ? log_ns : std::max(chunk_last_ns_, log_ns);
  chunk_index_[channel].emplace_back(log_ns, chunk_.size());
  chunk_.u8(op::kMessage);
  chunk_.u64(length);
  chunk_.u16(channel);
  chunk_.u32(sequence);
  chunk_.u64(log_ns);
  chunk_.u64(log_ns);
  chunk_.raw(bytes, size);
  count(channel, log_ns);
  return error_.empty();
}

bool McapWriter::close_chunk() {
  if (chunk_.size() == 0) return error_.empty();
  ByteWriter content;
  content.u64(chunk_first_ns_);
  content.u64(chunk_last_ns_);
  content.u64(chunk_.size());
  content.u32(berm_crc32(chunk_.data(), chunk_.size()));
  content.text("");
  content.u64(chunk_.size());
  content.raw(chunk_.data(), chunk_.size());
  ChunkIndex index{chunk_first_ns_, chunk_last_ns_, position_, content.size() + 9, 0, chunk_.size(), {}};
  ByteWriter bytes;
  put_record(bytes, op::kChunk, content);
  for (const auto& [channel, entries] : chunk_index_) {
    ByteWriter list;
    list.u16(channel);
    list.u32(static_cast<std::uint32_t>(entries.size() * 16));
    for (const auto& [log_ns, offset] : entries) {
      list.u64(log_ns);
      list.u64(offset);
    }
    index.index_offset[channel] = position_ + bytes.size();
    put_record(bytes, op::kMessageIndex, list);
  }
  index.index_length = bytes.size() - index.length;
  chunks_.push_back(std::move(index));
  chunk_.clear();
  chunk_index_.clear();
  return write(bytes);
}

bool McapWriter::end() {
  if (!close_chunk()) return false;
  ByteWriter data_end;
  data_end.u32(crc_);
  if (!record(op::kDataEnd, data_end)) return false;
  return summary();
}

bool McapWriter::summary() {
  const std::uint64_t begin = position_;
  crc_ = 0;
  ByteWriter offsets;
  const auto group = [&](std::uint8_t code, const std::vector<ByteWriter>& contents) {
    const std::uint64_t from = position_;
    for (const auto& content : contents) record(code, content);
    if (contents.empty()) return;
    ByteWriter offset;
    offset.u8(code);
    offset.u64(from);
    offset.u64(position_ - from);
    put_record(offsets, op::kSummaryOffset, offset);
  };
  ByteWriter statistics;
  statistics.u64(messages_);
  statistics.u16(static_cast<std::uint16_t>(schemas_.size()));
  for (const std::size_t n : {channels_.size(), attachments_.size(), metadata_.size(), chunks_.size()}) statistics.u32(static_cast<std::uint32_t>(n));
  statistics.u64(first_ns_);
  statistics.u64(last_ns_);
  statistics.u32(static_cast<std::uint32_t>(channel_messages_.size() * 10));
  for (const auto& [channel, n] : channel_messages_) {
    statistics.u16(channel);
    statistics.u64(n);
  }
  std::vector<ByteWriter> chunk_contents;
  for (const auto& chunk : chunks_) {
    ByteWriter content;
    for (const std::uint64_t v : {chunk.first_ns, chunk.last_ns, chunk.offset, chunk.length}) content.u64(v);
    content.u32(static_cast<std::uint32_t>(chunk.index_offset.size() * 10));
    for (const auto& [channel, offset] : chunk.index_offset) {
      content.u16(channel);
      content.u64(offset);
    }
    content.u64(chunk.index_length);
    content.text("");
    content.u64(chunk.size);
    content.u64(chunk.size);
    chunk_contents.push_back(std::move(content));
  }
  group(op::kSchema, schemas_);
  group(op::kChannel, channels_);
  group(op::kStatistics, {statistics});
  group(op::kMetadataIndex, metadata_);
  group(op::kAttachmentIndex, attachments_);
  group(op::kChunkIndex, chunk_contents);
  const std::uint64_t offsets_begin = position_;
  ByteWriter tail = offsets;
  tail.u8(op::kFooter);
  tail.u64(kFooterBytes);
  tail.u64(begin);
  tail.u64(offsets_begin);
  tail.u32(berm_crc32_continue(crc_, tail.data(), tail.size()));
  tail.raw(kMcapMagic, sizeof kMcapMagic);
  return write(tail);
}

}  // namespace berm::record
