#include "journal/mcap_reader.hpp"

#include <cerrno>
#include <cstring>

#include "scan/scan_packet.h"

namespace berm::record {

namespace {

bool read_map(ByteReader& in, TextMap& map) {
  const std::uint32_t bytes = in.u32();
  const std::uint8_t* from = in.raw(bytes);
  if (from == nullptr) return false;
  ByteReader entries(from, bytes);
  while (entries.good() && entries.left() > 0) {
    const std::string key = entries.text();
    map[key] = entries.text();
  }
  return entries.good();
}

}  // namespace

McapReader::Result McapReader::stop(Result result, const std::string& what) {
  ended_ = true;
  final_ = result;
  if (!what.empty()) error_ = path_ + ": byte " + std::to_string(record_at_) + ": " + what;
  return result;
}

McapReader::Step McapReader::bad(const std::string& what) {
  stop(Result::kBad, what);
  return Step::kBad;
}

bool McapReader::read(void* to, std::size_t size) {
  if (std::fread(to, 1, size, file_.get()) != size) return false;
  crc_ = berm_crc32_continue(crc_, static_cast<const std::uint8_t*>(to), size);
  position_ += size;
  return true;
}

bool McapReader::open(const std::string& path) {
  path_ = path;
  file_.reset(std::fopen(path.c_str(), "rbe"));
  if (file_ == nullptr || std::fseek(file_.get(), 0, SEEK_END) != 0) {
    error_ = path + ": " + std::strerror(errno);
    return false;
  }
  const long size = std::ftell(file_.get());
  size_ = size < 0 ? 0 : static_cast<std::uint64_t>(size);
  std::rewind(file_.get());
  std::uint8_t magic[sizeof kMcapMagic];
  if (read(magic, sizeof magic) && std::memcmp(magic, kMcapMagic, sizeof magic) == 0) return true;
  error_ = path + ": not an MCAP file (its first eight bytes are not the magic)";
  return false;
}

McapReader::Result McapReader::next(McapItem& item) {
  while (!ended_) {
    Step step = Step::kNothing;
    if (chunk_.left() > 0) {
      const std::uint8_t code = chunk_.u8();
      const std::uint64_t bytes = chunk_.u64();
      const std::uint8_t* from = chunk_.raw(bytes);
      if (from == nullptr) return stop(Result::kBad, "a record in a chunk is longer than the chunk");
      const bool fits = code == op::kMessage || code == op::kSchema || code == op::kChannel;
      step = fits ? take(code, ByteReader(from, static_cast<std::size_t>(bytes)), item) : bad("a record of type " + std::to_string(code) + " in a chunk");
    } else {
      std::uint8_t code = 0;
      const Result found = next_record(code);
      if (found != Result::kItem) return found;
      step = take(code, ByteReader(content_.data(), content_.size()), item);
    }
    if (step == Step::kItem) return Result::kItem;
    if (step == Step::kEnd) return stop(Result::kEnd, "");
    if (step == Step::kBad) return final_;
  }
  return final_;
}

McapReader::Result McapReader::next_record(std::uint8_t& code) {
  record_at_ = position_;
  crc_before_ = crc_;
  std::uint8_t head[9];
  if (size_ - position_ < sizeof head || !read(head, sizeof head)) return stop(Result::kCut, "the file is cut off here");
  code = head[0];
  const std::uint64_t bytes = ByteReader(head + 1, 8).u64();
  if (bytes > kRecordMaxBytes) return stop(Result::kBad, "a record of " + std::to_string(bytes) + " bytes; at most " + std::to_string(kRecordMaxBytes) + " are taken");
  if (bytes > size_ - position_) return stop(Result::kCut, "the file is cut off within this record");
  content_.resize(static_cast<std::size_t>(bytes));
  if (bytes > 0 && !read(content_.data(), content_.size())) return stop(Result::kCut, "the file cannot be read further");
  return Result::kItem;
}

McapReader::Step McapReader::take(std::uint8_t code, ByteReader in, McapItem& item) {
  switch (code) {
    case op::kMessage: return in_summary_ ? bad("a message behind the end of the data") : take_message(in, item);
    case op::kChannel: return take_channel(in);
    case op::kChunk: return in_summary_ ? bad("a chunk behind the end of the data") : take_chunk(in);
    case op::kAttachment: return take_attachment(in, item);
    case op::kMetadata: return take_metadata(in, item);
    case op::kDataEnd: return take_data_end(in, crc_before_);
    case op::kStatistics: return take_statistics(in);
    case op::kFooter: return take_footer(in, crc_before_);
    default: return Step::kNothing;  // the format says that unknown records are passed over
  }
}

McapReader::Step McapReader::take_channel(ByteReader in) {
  const std::uint16_t id = in.u16();
  in.u16();
  const std::string topic = in.text(), encoding = in.text();
  if (!in.good()) return bad("a channel is shorter than its fields");
  channels_[id] = {topic, encoding};
  return Step::kNothing;
}

McapReader::Step McapReader::take_message(ByteReader in, McapItem& item) {
  const std::uint16_t channel = in.u16();
  item = McapItem{};
  item.sequence = in.u32();
  item.log_ns = in.u64();
  in.u64();
  if (!in.good()) return bad("a message is shorter than its fields");
  const auto known = channels_.find(channel);
  if (known == channels_.end()) return bad("a message of channel " + std::to_string(channel) + ", which was not declared");
  item.name = known->second.topic;
  item.encoding = known->second.encoding;
  item.size = in.left();
  item.bytes = in.raw(item.size);
  ++counts_[channel];
  ++messages_;
  return Step::kItem;
}

McapReader::Step McapReader::take_chunk(ByteReader in) {
  in.u64();
  in.u64();
  const std::uint64_t size = in.u64();
  const std::uint32_t crc = in.u32();
  const std::string compression = in.text();
  const std::uint64_t stored = in.u64();
  if (!in.good() || stored != in.left()) return bad("a chunk's length does not fit its fields");
  if (!compression.empty()) return bad("a chunk compressed with \"" + compression.substr(0, 16) + "\"; only uncompressed ones are read");
  if (size != stored) return bad("an uncompressed chunk with two sizes");
  const std::uint8_t* from = in.raw(stored);
  if (crc != 0 && berm_crc32(from, static_cast<std::size_t>(stored)) != crc) return bad("the CRC of a chunk does not match");
  chunk_ = ByteReader(from, static_cast<std::size_t>(stored));
  return Step::kNothing;
}

McapReader::Step McapReader::take_attachment(ByteReader in, McapItem& item) {
  const ByteReader whole = in;
  item = McapItem{};
  item.kind = McapItem::Kind::kAttachment;
  item.log_ns = in.u64();
  in.u64();
  item.name = in.text();
  item.encoding = in.text();
  const std::uint64_t size = in.u64();
  item.bytes = in.raw(size);
  item.size = static_cast<std::size_t>(size);
  const std::size_t covered = whole.left() - in.left();
  const std::uint32_t crc = in.u32();
  if (!in.good()) return bad("an attachment is shorter than its fields");
  if (crc != 0 && berm_crc32(ByteReader(whole).raw(covered), covered) != crc) return bad("the CRC of attachment " + item.name.substr(0, 40) + " does not match");
  return Step::kItem;
}

McapReader::Step McapReader::take_metadata(ByteReader in, McapItem& item) {
  item = McapItem{};
  item.kind = McapItem::Kind::kMetadata;
  item.name = in.text();
  if (!read_map(in, item.map)) return bad("metadata shorter than its fields");
  return Step::kItem;
}

McapReader::Step McapReader::take_data_end(ByteReader in, std::uint32_t crc_before) {
  const std::uint32_t crc = in.u32();
  if (!in.good() || in_summary_) return bad("a misplaced end of the data");
  if (crc != 0 && crc != crc_before) return bad("the CRC of the data section does not match");
  in_summary_ = true;
  summary_at_ = position_;
  crc_ = 0;
  return Step::kNothing;
}

McapReader::Step McapReader::take_statistics(ByteReader in) {
  const std::uint64_t messages = in.u64();
  if (!in.good()) return bad("statistics shorter than their fields");
  if (messages != messages_) return bad("the summary counts " + std::to_string(messages) + " messages, the file has " + std::to_string(messages_));
  counts_checked_ = true;
  return Step::kNothing;
}

McapReader::Step McapReader::take_footer(ByteReader in, std::uint32_t crc_before) {
  const std::uint64_t summary_at = in.u64(), offsets_at = in.u64();
  const std::uint32_t crc = in.u32();
  if (!in.good() || !in_summary_) return bad("a misplaced footer");
  if (summary_at != 0 && summary_at != summary_at_) return bad("the footer names another begin of the summary");
  if (offsets_at > record_at_) return bad("the footer names another begin of the offsets");
  ByteWriter head;
  head.u8(op::kFooter);
  head.u64(kFooterBytes);
  head.u64(summary_at);
  head.u64(offsets_at);
  if (crc != 0 && crc != berm_crc32_continue(crc_before, head.data(), head.size())) return bad("the CRC of the summary does not match");
  if (!counts_checked_) return bad("a summary without statistics");
  std::uint8_t magic[sizeof kMcapMagic];
  if (size_ - position_ < sizeof magic || !read(magic, sizeof magic)) {
    stop(Result::kCut, "the file is cut off before its last eight bytes");
    return Step::kBad;
  }
  if (std::memcmp(magic, kMcapMagic, sizeof magic) != 0) return bad("the last eight bytes are not the magic");
  if (position_ != size_) return bad("bytes behind the end");
  return Step::kEnd;
}

}  // namespace berm::record
