// The journal as a file: what stands before the first record, what is said of lost records, what ends it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/sk_common.h"
#include "record/journal_file.hpp"

namespace berm::record {
namespace {

struct Item {
  McapItem::Kind kind;
  std::string name, encoding, bytes;
  TextMap map;
  std::uint64_t log_ns;
};

std::string bytes_of(const McapItem& item) {
  if (item.kind == McapItem::Kind::kMetadata) return {};
  return {reinterpret_cast<const char*>(item.bytes), item.size};
}

class JournalFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/berm-journal-file-XXXXXX";
    close(mkstemp(name));
    path = name;
    start.version = BERM_JOURNAL_VERSION;
    start.contract_version = BERM_CONTRACT_VERSION;
    start.cell_mm = SK_CELL_MM;
    start.map_only = 1;
    start.mount[0] = 0.1;  // no binary fraction: only hexadecimal brings back its very bits
    start.mount[3] = -1.0 / 3.0;
    start.parameters.magic = 12345;
  }
  void TearDown() override { std::remove(path.c_str()); }
  // Records of these sequences, of cycles 100 higher; with or without the file's end.
  std::string written(const std::vector<std::uint64_t>& sequences, std::uint64_t offered, bool whole = true) {
    std::FILE* out = std::fopen(path.c_str(), "wb");
    JournalFile file(fileno(out));
    EXPECT_TRUE(file.begin(start));
    for (const std::uint64_t sequence : sequences) {
      berm_journal_cycle record{};
      record.bytes = sizeof record;
      record.sequence = sequence;
      record.cycle = sequence + 100;
      record.now_us = static_cast<std::int64_t>(sequence) * 10000;
      EXPECT_TRUE(file.cycle(reinterpret_cast<const std::uint8_t*>(&record), sizeof record));
    }
    if (whole) {
      EXPECT_TRUE(file.end(offered));
    }
    std::fclose(out);
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::vector<Item> items() {
    std::vector<Item> found;
    McapReader reader;
    EXPECT_TRUE(reader.open(path)) << reader.error();
    McapItem item;
    for (last = McapReader::Result::kItem; (last = reader.next(item)) == McapReader::Result::kItem;)
      found.push_back({item.kind, item.name, item.encoding, bytes_of(item), item.map, item.log_ns});
    return found;
  }
  std::vector<Item> of(const std::vector<Item>& all, const std::string& name) {
    std::vector<Item> found;
    for (const Item& item : all)
      if (item.name == name) found.push_back(item);
    return found;
  }
  std::string path;
  berm_journal_start start{};
  McapReader::Result last = McapReader::Result::kItem;
};

// verifies: IF-JR-11
TEST_F(JournalFileTest, TheStartStandsBeforeTheFirstMessage) {
  written({0, 1}, 2);
  const std::vector<Item> all = items();
  ASSERT_GE(all.size(), 3U);
  EXPECT_EQ(all[0].name, names::kStart);
  EXPECT_EQ(all[1].name, names::kParameters);
  EXPECT_EQ(all[1].kind, McapItem::Kind::kAttachment);
  ASSERT_EQ(all[1].bytes.size(), sizeof(berm_parameters));
  EXPECT_EQ(std::memcmp(all[1].bytes.data(), &start.parameters, sizeof(berm_parameters)), 0);
  EXPECT_EQ(all[2].kind, McapItem::Kind::kMessage);
  StartConditions back;
  std::string error;
  ASSERT_TRUE(read_start(all[0].map, back, error)) << error;
  EXPECT_TRUE(back.map_only);
  EXPECT_EQ(back.mount.x_m, start.mount[0]);
  EXPECT_EQ(back.mount.yaw_rad, start.mount[3]);
  EXPECT_EQ(all[0].map.at("journal_version"), std::to_string(BERM_JOURNAL_VERSION));
  EXPECT_EQ(all[0].map.at("contract_version"), std::to_string(BERM_CONTRACT_VERSION));
  EXPECT_EQ(all[0].map.at("cell_mm"), std::to_string(SK_CELL_MM));
  EXPECT_NE(all[0].map.at("vlp16_x_m").find("0x"), std::string::npos);
}

// verifies: IF-JR-12 (each record once, as it is), IF-JR-13 (a decision beside each record)
TEST_F(JournalFileTest, EachRecordIsThereAsItWasWithItsDecision) {
  written({0, 1, 2}, 3);
  const std::vector<Item> all = items(), cycles = of(all, names::kCycleTopic), decisions = of(all, names::kDecisionTopic);
  ASSERT_EQ(cycles.size(), 3U);
  ASSERT_EQ(decisions.size(), 3U);
  for (std::uint64_t i = 0; i < 3; ++i) {
    berm_journal_cycle record;
    ASSERT_EQ(cycles[i].bytes.size(), sizeof record);
    std::memcpy(&record, cycles[i].bytes.data(), sizeof record);
    EXPECT_EQ(record.sequence, i);
    EXPECT_EQ(cycles[i].encoding, names::kCycleEncoding);
    EXPECT_EQ(decisions[i].encoding, "json");
    EXPECT_EQ(decisions[i].bytes.front(), '{');
  }
}

// verifies: IF-JR-10 (log time is the kernel's)
TEST_F(JournalFileTest, WhatIsToldOfACycleHasItsTime) {
  written({0, 1, 5}, 9);
  const std::vector<Item> all = items();
  const auto times = [&](const char* name) {
    std::vector<std::uint64_t> found;
    for (const Item& item : of(all, name)) found.push_back(item.log_ns);
    return found;
  };
  const std::vector<std::uint64_t> cycles{0, 10'000'000, 50'000'000};
  EXPECT_EQ(times(names::kCycleTopic), cycles);
  EXPECT_EQ(times(names::kDecisionTopic), cycles);
  EXPECT_EQ(times(names::kLostTopic), (std::vector<std::uint64_t>{50'000'000, 50'000'000})) << "of the cycle after the gap, and of the last";
}

// verifies: IF-JR-14
TEST_F(JournalFileTest, LostRecordsAreToldOfBeforeTheCycleThatCameAfterThem) {
  written({0, 1, 5, 6}, 9);
  const std::vector<Item> lost = of(items(), names::kLostTopic);
  ASSERT_EQ(lost.size(), 2U);
  EXPECT_EQ(lost[0].encoding, "json");
  EXPECT_EQ(lost[0].bytes, R"({"lost":3,"before_cycle":105})");
  EXPECT_EQ(lost[1].bytes, R"({"lost":2,"before_cycle":107})");
  written({0, 1, 2}, 3);
  EXPECT_TRUE(of(items(), names::kLostTopic).empty());
}

// verifies: IF-JR-15
TEST_F(JournalFileTest, TheEndHasTheCountsAndWithoutItTheFileIsNotComplete) {
  written({0, 1, 5, 6}, 9);
  const std::vector<Item> all = items(), end = of(all, names::kEnd);
  EXPECT_EQ(last, McapReader::Result::kEnd);
  ASSERT_EQ(end.size(), 1U);
  EXPECT_EQ(end[0].map, (TextMap{{"cycles", "4"}, {"lost", "5"}, {"offered", "9"}}));
  written({0, 1, 5, 6}, 9, false);
  EXPECT_TRUE(of(items(), names::kEnd).empty());
  EXPECT_NE(last, McapReader::Result::kEnd);
}

// verifies: IF-JR-16
TEST_F(JournalFileTest, TheSameRecordsGiveTheSameBytes) {
  const std::string once = written({0, 1, 5}, 7), again = written({0, 1, 5}, 7);
  EXPECT_GT(once.size(), 3 * sizeof(berm_journal_cycle));
  EXPECT_EQ(once, again);
  EXPECT_NE(once, written({0, 1, 4}, 7));
}

}  // namespace
}  // namespace berm::record
