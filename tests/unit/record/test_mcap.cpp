// The MCAP writer and reader: what is written comes back; what is cut off or damaged is never taken for whole.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>

#include "journal/mcap_reader.hpp"
#include "record/mcap_writer.hpp"

namespace berm::record {
namespace {

using Result = McapReader::Result;

class Mcap : public ::testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/berm-mcap-XXXXXX";
    const int fd = mkstemp(name);
    ASSERT_GE(fd, 0);
    path = name;
    McapWriter writer(fd);
    ASSERT_TRUE(writer.begin("test"));
    const auto channel = writer.channel(writer.schema("s", "jsonschema", "{}"), "/a", "json");
    ASSERT_TRUE(writer.metadata("m", {{"k", "v"}, {"empty", ""}}));
    ASSERT_TRUE(writer.attachment("att", "text/plain", 5, "hello", 5));
    for (std::uint32_t i = 0; i < kMessages; ++i) {
      const std::string body = "{\"i\":" + std::to_string(i) + "}";
      ASSERT_TRUE(writer.message(channel, i, i * 100000000ULL, body.data(), body.size()));
    }
    ASSERT_TRUE(writer.end()) << writer.error();
    close(fd);
    std::ifstream file(path, std::ios::binary);
    whole.assign(std::istreambuf_iterator<char>(file), {});
    ASSERT_EQ(writer.position(), whole.size());
  }
  void TearDown() override { std::remove(path.c_str()); }
  Result read(const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    McapReader reader;
    messages = 0;
    error.clear();
    if (!reader.open(path)) {
      error = reader.error();
      return Result::kBad;
    }
    McapItem item;
    Result result;
    while ((result = reader.next(item)) == Result::kItem) {
      if (item.kind == McapItem::Kind::kMessage) ++messages;
      if (item.kind == McapItem::Kind::kAttachment) attachment.assign(reinterpret_cast<const char*>(item.bytes), item.size);
      if (item.kind == McapItem::Kind::kMetadata) metadata = item.map;
    }
    error = reader.error();
    return result;
  }
  static constexpr std::uint32_t kMessages = 40;
  std::string path, whole, error, attachment;
  TextMap metadata;
  std::uint32_t messages = 0;
};

// verifies: IF-JR-10 (that what is written is read back)
TEST_F(Mcap, WhatIsWrittenComesBack) {
  EXPECT_EQ(read(whole), Result::kEnd) << error;
  EXPECT_EQ(messages, kMessages);
  EXPECT_EQ(attachment, "hello");
  EXPECT_EQ(metadata["k"], "v");
}

// verifies: SK-JO-11
TEST_F(Mcap, CutAtEveryByteItIsNeverWhole) {
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Result result = read(whole.substr(0, size));
    ASSERT_TRUE(result == Result::kCut || result == Result::kBad) << size;
    ASSERT_FALSE(error.empty()) << size;
    ASSERT_EQ(error.find('\n'), std::string::npos);
  }
}

// Every single bit flipped: noticed, but for the few bytes that the format leaves without a CRC and that carry nothing here.
// verifies: SK-JO-11
TEST_F(Mcap, FlippedBitsAreNoticed) {
  const unsigned seed = 3;
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  int unnoticed = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string damaged = whole;
    damaged[random() % damaged.size()] ^= static_cast<char>(1U << (random() % 8));
    if (read(damaged) == Result::kEnd) ++unnoticed;
    else ASSERT_FALSE(error.empty());
  }
  EXPECT_EQ(unnoticed, 0);
}

}  // namespace
}  // namespace berm::record
