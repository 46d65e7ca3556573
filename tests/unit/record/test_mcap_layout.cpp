// The file that the MCAP writer makes, record by record: everything that a foreign reader may rely on to find its way without reading it all.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>

#include "mcap_layout.hpp"
#include "record/mcap_writer.hpp"
#include "scan/scan_packet.h"
#include "scratch.hpp"

namespace berm::record {
namespace {

using Numbers = std::vector<std::uint64_t>;

std::uint32_t crc_of(const std::string& bytes) { return berm_crc32(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()); }

struct Message {
  int channel;
  std::uint64_t log_ns;
  std::size_t size;
};

class McapLayout : public ::testing::Test {
 protected:
  void write(const std::vector<Message>& messages) {
    sent = messages;
    const test::Scratch scratch;
    std::FILE* out = std::fopen(scratch.path("file").c_str(), "wb");
    McapWriter writer(fileno(out));
    ASSERT_TRUE(writer.begin("test"));
    const std::uint16_t schema = writer.schema("s", "jsonschema", "{}");
    const std::uint16_t channel[2] = {writer.channel(schema, "/a", "json"), writer.channel(0, "/b", "raw")};
    ASSERT_TRUE(writer.metadata("begin", {{"k", "v"}}));
    ASSERT_TRUE(writer.attachment("att", "text/plain", 5, "hello", 5));
    std::uint32_t sequence = 0;
    for (const Message& m : messages) {
      const std::string body(m.size, 'x');
      ASSERT_TRUE(writer.message(channel[m.channel], sequence++, m.log_ns, body.data(), body.size()));
    }
    ASSERT_TRUE(writer.metadata("end", {}));
    ASSERT_TRUE(writer.end());
    std::fclose(out);
    std::ifstream in(scratch.path("file"), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
    ASSERT_GT(bytes.size(), 16U);
    records = mcap_records(bytes, sizeof kMcapMagic, bytes.size() - sizeof kMcapMagic);
    chunks.clear();
    for (const McapRecord& record : records)
      if (record.code == op::kChunk) chunks.push_back(mcap_chunk(record));
  }
  // Records of this code: of the data section with its end, or of the summary.
  std::vector<McapRecord> of(std::uint8_t code, bool summary) const {
    std::vector<McapRecord> found;
    const std::uint64_t end = data_end();
    for (const McapRecord& record : records)
      if (record.code == code && (record.at > end) == summary) found.push_back(record);
    return found;
  }
  std::uint64_t data_end() const {
    return std::find_if(records.begin(), records.end(), [](const McapRecord& r) { return r.code == op::kDataEnd; })->at;
  }
  // Message indexes that follow this chunk, by channel: where each is.
  std::map<std::uint64_t, McapRecord> indexes_behind(const McapChunk& chunk) const {
    std::map<std::uint64_t, McapRecord> found;
    auto at = std::find_if(records.begin(), records.end(), [&](const McapRecord& r) { return r.at == chunk.record.at; });
    for (++at; at != records.end() && at->code == op::kMessageIndex; ++at) found[at->fields().u16()] = *at;
    return found;
  }
  // By time with a pause, by size, by both channels.
  std::vector<Message> many() const {
    std::vector<Message> messages;
    for (std::uint64_t i = 0; i < 40; ++i) messages.push_back({static_cast<int>(i % 2), i * 100'000'000, 40});
    for (std::uint64_t i = 0; i < 60; ++i) messages.push_back({static_cast<int>(i % 3 == 0), 9'000'000'000 + i, 100'000});
    return messages;
  }

  std::vector<Message> sent;
  std::string bytes;
  std::vector<McapRecord> records;
  std::vector<McapChunk> chunks;
};

// verifies: IF-JR-10 (version 0, and the order of its parts)
TEST_F(McapLayout, TheFileIsOfVersionZeroFromItsMagicToItsMagic) {
  write(many());
  const std::string magic("\x89MCAP0\r\n", 8);
  EXPECT_EQ(bytes.substr(0, 8), magic);
  EXPECT_EQ(bytes.substr(bytes.size() - 8), magic);
  EXPECT_EQ(records.front().code, op::kHeader);
  EXPECT_EQ(records.back().code, op::kFooter);
  EXPECT_EQ(std::count_if(records.begin(), records.end(), [](const McapRecord& r) { return r.code == op::kDataEnd; }), 1);
  EXPECT_EQ(std::count_if(records.begin(), records.end(), [](const McapRecord& r) { return r.code == op::kMessage; }), 0) << "all are in chunks";
}

// verifies: IF-JR-10 (chunks: uncompressed, with their CRC and times)
TEST_F(McapLayout, ChunksHoldTheMessagesAsTheyAre) {
  write(many());
  ASSERT_GE(chunks.size(), 8U);
  std::size_t next = 0;
  for (const McapChunk& chunk : chunks) {
    EXPECT_EQ(chunk.compression, "");
    EXPECT_EQ(chunk.size, chunk.records.size());
    EXPECT_EQ(chunk.stored_size, chunk.records.size());
    EXPECT_EQ(chunk.crc, crc_of(chunk.records));
    ASSERT_FALSE(chunk.messages.empty());
    Numbers times;
    for (const McapMessage& message : chunk.messages) {
      ASSERT_LT(next, sent.size());
      EXPECT_EQ(message.channel, sent[next].channel + 1);
      EXPECT_EQ(message.log_ns, sent[next++].log_ns);
      times.push_back(message.log_ns);
    }
    EXPECT_EQ(chunk.first_ns, *std::min_element(times.begin(), times.end()));
    EXPECT_EQ(chunk.last_ns, *std::max_element(times.begin(), times.end()));
  }
  EXPECT_EQ(next, sent.size());
}

// verifies: IF-JR-10 (chunks of at most 1 MiB or 1 s)
TEST_F(McapLayout, NoChunkIsLongerThanAMebibyteOrASecond) {
  constexpr std::size_t mebibyte = 1 << 20, head = 31;  // of a message in a chunk
  std::vector<Message> messages = many();
  for (const std::size_t size : {mebibyte - 2 * head - 1, std::size_t{1}, std::size_t{0}, mebibyte - head, mebibyte - head - 1, std::size_t{0}, std::size_t{700'000}, std::size_t{700'000}})
    messages.push_back({0, 20'000'000'000, size});
  for (const std::uint64_t ns : {30'000'000'000, 31'000'000'000, 31'000'000'001, 32'000'000'001, 32'000'000'002}) messages.push_back({1, static_cast<std::uint64_t>(ns), 9});
  write(messages);
  std::uint64_t longest_ns = 0, largest = 0;
  for (const McapChunk& chunk : chunks) {
    EXPECT_LE(chunk.records.size(), mebibyte);
    EXPECT_LE(chunk.last_ns - chunk.first_ns, 1'000'000'000U);
    longest_ns = std::max(longest_ns, chunk.last_ns - chunk.first_ns);
    largest = std::max<std::uint64_t>(largest, chunk.records.size());
  }
  EXPECT_EQ(largest, mebibyte) << "what just fits is not cut";
  EXPECT_EQ(longest_ns, 1'000'000'000U);
  write({{0, 0, 2 * mebibyte}, {0, 0, 1}});
  ASSERT_EQ(chunks.size(), 2U) << "a message that is longer by itself has a chunk of its own";
  EXPECT_EQ(chunks[0].messages.size(), 1U);
}

// verifies: IF-JR-10 (message indexes)
TEST_F(McapLayout, BehindEachChunkItsMessagesAreListedByChannel) {
  write(many());
  for (const McapChunk& chunk : chunks) {
    std::map<std::uint64_t, Numbers> expected;
    for (const McapMessage& m : chunk.messages) expected[m.channel].insert(expected[m.channel].end(), {m.log_ns, m.offset});
    std::map<std::uint64_t, Numbers> listed;
    for (const auto& [channel, record] : indexes_behind(chunk)) {
      ByteReader in = record.fields();
      in.u16();
      const std::uint32_t size = in.u32();
      ASSERT_EQ(size, in.left());
      while (in.left() > 0) listed[channel].push_back(in.u64());
    }
    EXPECT_EQ(listed, expected);
  }
}

// verifies: IF-JR-10 (chunk indexes)
TEST_F(McapLayout, TheSummaryTellsWhereEachChunkAndItsIndexesAre) {
  write(many());
  const std::vector<McapRecord> indexes = of(op::kChunkIndex, true);
  ASSERT_EQ(indexes.size(), chunks.size());
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const McapChunk& chunk = chunks[i];
    ByteReader in = indexes[i].fields();
    EXPECT_EQ((Numbers{in.u64(), in.u64(), in.u64(), in.u64()}), (Numbers{chunk.first_ns, chunk.last_ns, chunk.record.at, chunk.record.length()}));
    std::map<std::uint64_t, std::uint64_t> expected, listed;
    std::uint64_t length = 0;
    for (const auto& [channel, record] : indexes_behind(chunk)) {
      expected[channel] = record.at;
      length += record.length();
    }
    for (std::uint32_t left = in.u32(); left > 0; left -= 10) {
      const std::uint64_t channel = in.u16();
      listed[channel] = in.u64();
    }
    EXPECT_EQ(listed, expected);
    EXPECT_EQ(in.u64(), length);
    EXPECT_EQ(in.text(), "");
    EXPECT_EQ((Numbers{in.u64(), in.u64()}), (Numbers{chunk.records.size(), chunk.records.size()}));
    EXPECT_TRUE(in.good() && in.left() == 0);
  }
}

// verifies: IF-JR-10 (attachment and metadata indexes)
TEST_F(McapLayout, TheSummaryTellsWhereAttachmentsAndMetadataAre) {
  write(many());
  const std::vector<McapRecord> attached = of(op::kAttachment, false), attachment_index = of(op::kAttachmentIndex, true);
  ASSERT_EQ(attached.size(), 1U);
  ASSERT_EQ(attachment_index.size(), 1U);
  ByteReader in = attachment_index[0].fields();
  EXPECT_EQ((Numbers{in.u64(), in.u64(), in.u64(), in.u64(), in.u64()}), (Numbers{attached[0].at, attached[0].length(), 5, 0, 5}));
  EXPECT_EQ(in.text(), "att");
  EXPECT_EQ(in.text(), "text/plain");
  const std::vector<McapRecord> metadata = of(op::kMetadata, false), metadata_index = of(op::kMetadataIndex, true);
  ASSERT_EQ(metadata.size(), 2U);
  ASSERT_EQ(metadata_index.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    ByteReader entry = metadata_index[i].fields();
    EXPECT_EQ((Numbers{entry.u64(), entry.u64()}), (Numbers{metadata[i].at, metadata[i].length()}));
    EXPECT_EQ(entry.text(), i == 0 ? "begin" : "end");
  }
}

// verifies: IF-JR-10 (statistics)
TEST_F(McapLayout, TheStatisticsCountWhatIsThere) {
  write(many());
  const std::vector<McapRecord> statistics = of(op::kStatistics, true);
  ASSERT_EQ(statistics.size(), 1U);
  ByteReader in = statistics[0].fields();
  EXPECT_EQ(in.u64(), sent.size());
  EXPECT_EQ(in.u16(), of(op::kSchema, false).size());
  EXPECT_EQ((Numbers{in.u32(), in.u32(), in.u32(), in.u32()}), (Numbers{of(op::kChannel, false).size(), 1, 2, chunks.size()}));
  EXPECT_EQ((Numbers{in.u64(), in.u64()}), (Numbers{sent.front().log_ns, sent.back().log_ns}));
  std::map<std::uint64_t, std::uint64_t> expected, counted;
  for (const Message& m : sent) ++expected[static_cast<std::uint64_t>(m.channel) + 1];
  for (std::uint32_t left = in.u32(); left > 0; left -= 10) {
    const std::uint64_t channel = in.u16();
    counted[channel] = in.u64();
  }
  EXPECT_EQ(counted, expected);
  EXPECT_TRUE(in.good() && in.left() == 0);
  for (const std::uint8_t code : {op::kSchema, op::kChannel}) {
    const std::vector<McapRecord> in_data = of(code, false), in_summary = of(code, true);
    ASSERT_EQ(in_data.size(), in_summary.size());
    for (std::size_t i = 0; i < in_data.size(); ++i) EXPECT_EQ(in_data[i].content, in_summary[i].content) << "repeated for who reads the summary alone";
  }
}

// verifies: IF-JR-10 (summary offsets)
TEST_F(McapLayout, TheOffsetsLeadToEveryGroupOfTheSummary) {
  write(many());
  std::map<std::uint64_t, Numbers> expected, listed;
  for (const McapRecord& record : records) {
    if (record.at <= data_end() || record.code == op::kSummaryOffset || record.code == op::kFooter) continue;
    Numbers& group = expected.try_emplace(record.code, Numbers{record.at, 0}).first->second;
    ASSERT_EQ(group[0] + group[1], record.at) << "a group is in one piece";
    group[1] += record.length();
  }
  for (const McapRecord& record : of(op::kSummaryOffset, true)) {
    ByteReader in = record.fields();
    const std::uint64_t code = in.u8(), at = in.u64();
    listed[code] = {at, in.u64()};
  }
  EXPECT_EQ(listed, expected);
  EXPECT_EQ(listed.size(), 6U);
  ByteReader footer = records.back().fields();
  EXPECT_EQ((Numbers{footer.u64(), footer.u64()}), (Numbers{of(op::kSchema, true).front().at, of(op::kSummaryOffset, true).front().at}));
}

// verifies: IF-JR-10 (the CRCs of data section and summary)
TEST_F(McapLayout, DataSectionAndSummaryHaveTheirCrcs) {
  write(many());
  const std::uint64_t data = data_end();
  const McapRecord end = of(op::kDataEnd, false).at(0);
  EXPECT_EQ(end.fields().u32(), crc_of(bytes.substr(0, data)));
  ByteReader footer = records.back().fields();
  const std::uint64_t begin = footer.u64();
  footer.u64();
  EXPECT_EQ(footer.u32(), crc_of(bytes.substr(begin, records.back().at + 9 + 16 - begin)));
}

}  // namespace
}  // namespace berm::record
