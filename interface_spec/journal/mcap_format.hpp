// What writer and reader share of the MCAP format (version 0, https://mcap.dev/spec).
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace berm::record {

constexpr std::uint8_t kMcapMagic[8] = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

namespace op {
enum : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F
};
}

constexpr std::uint64_t kFooterBytes = 20, kDataEndBytes = 4;
constexpr std::uint64_t kRecordMaxBytes = 64U << 20;  // of one record: what is longer is damaged

using TextMap = std::map<std::string, std::string>;

}  // namespace berm::record
