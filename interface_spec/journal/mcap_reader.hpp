// Reads an MCAP file from its begin to its end: attachments, metadata, messages. A decoder: any bytes may come. Everything is checked before
// it is used (lengths, CRCs of chunks, attachments, data section and summary, the counts of the summary). Chunks must be uncompressed.
#pragma once

#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "journal/bytes.hpp"
#include "journal/mcap_format.hpp"

namespace berm::record {

struct McapItem {
  enum class Kind { kMessage, kAttachment, kMetadata };
  Kind kind = Kind::kMessage;
  std::string name;                     // topic, or name of the attachment or metadata
  std::string encoding;                 // of the message, or media type
  std::uint32_t sequence = 0;
  std::uint64_t log_ns = 0;
  const std::uint8_t* bytes = nullptr;  // until the next call of next()
  std::size_t size = 0;
  TextMap map;
};

class McapReader {
 public:
  enum class Result {
    kItem,
    kEnd,  // the whole file was read and is sound
    kCut,  // the file ends before its end; what came before is sound
    kBad   // damaged; error() says where and how
  };
  // False with one line in error().
  bool open(const std::string& path);
  Result next(McapItem& item);
  const std::string& error() const { return error_; }

 private:
  struct Channel {
    std::string topic, encoding;
  };
  enum class Step { kItem, kNothing, kEnd, kBad };
  Result stop(Result result, const std::string& what);
  bool read(void* to, std::size_t size);
  Result next_record(std::uint8_t& code);
  Step take(std::uint8_t code, ByteReader in, McapItem& item);
  Step take_message(ByteReader in, McapItem& item);
  Step take_channel(ByteReader in);
  Step take_chunk(ByteReader in);
  Step take_attachment(ByteReader in, McapItem& item);
  Step take_metadata(ByteReader in, McapItem& item);
  Step take_data_end(ByteReader in, std::uint32_t crc_before);
  Step take_statistics(ByteReader in);
  Step take_footer(ByteReader in, std::uint32_t crc_before);
  Step bad(const std::string& what);

  std::string path_, error_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, std::fclose};
  std::uint64_t size_ = 0, position_ = 0, record_at_ = 0;
  std::uint32_t crc_ = 0, crc_before_ = 0;  // of the section, and of it before the newest record
  bool in_summary_ = false, ended_ = false;
  std::uint64_t summary_at_ = 0;
  Result final_ = Result::kEnd;
  std::vector<std::uint8_t> content_;
  ByteReader chunk_{nullptr, 0};
  std::map<std::uint16_t, Channel> channels_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::uint64_t messages_ = 0;
  bool counts_checked_ = false;
};

}  // namespace berm::record
