// The bounded queue between kernel and writer: order, wrap-around, no room, a hostile tail; and every input through a record and back.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <iostream>
#include <memory>
#include <random>

#include "io/journal.hpp"
#include "mini_machine.hpp"
#include "record/cycle_record.hpp"
#include "record/ring_reader.hpp"

namespace berm::record {
namespace {

class Ring : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(journal.create(berm::test::demo_parameters(), false, kernel::Vlp16Mount{}, error)) << error;
    void* mapped = mmap(nullptr, journal.tail().size(), PROT_READ | PROT_WRITE, MAP_SHARED, journal.tail().fd(), 0);
    ASSERT_NE(mapped, MAP_FAILED);
    tail = static_cast<berm_journal_tail*>(mapped);
    ring = static_cast<const berm_journal_ring*>(journal.ring().view());
    sk_map_clear(map.get());
  }
  void TearDown() override { munmap(tail, sizeof *tail); }
  void offer(std::uint64_t cycle, int frames, bool readable = true) {
    in->clear();
    in->cycle = cycle;
    in->now_us = static_cast<std::int64_t>(cycle) * 10000;
    in->frame_count = frames;
    for (int i = 0; i < frames; ++i) in->frame[i] = {static_cast<std::uint32_t>(cycle), 8, {1, 2, 3, 4, 5, 6, 7, static_cast<std::uint8_t>(i)}};
    out->frames.count = 0;
    out->state = berm_state{};
    out->decision = berm_decision{};
    out->decision.cycle = cycle;
    journal.offer(*in, *out, *map, readable);
  }

  kernel::Journal journal;
  berm_journal_tail* tail = nullptr;
  const berm_journal_ring* ring = nullptr;
  std::unique_ptr<sk_height_map> map = std::make_unique<sk_height_map>();
  std::unique_ptr<kernel::CycleInputs> in = std::make_unique<kernel::CycleInputs>();
  std::unique_ptr<kernel::CycleInputs> back = std::make_unique<kernel::CycleInputs>();
  std::unique_ptr<kernel::CycleOutputs> out = std::make_unique<kernel::CycleOutputs>();
  std::vector<std::uint8_t> record;
  RecordedOutputs recorded;
  std::string error;
};

// verifies: SK-JO-1, IF-JR-4, IF-JR-6
TEST_F(Ring, RecordsComeOutInOrderThreeTimesRound) {
  RingReader reader(*ring, *tail);
  std::uint64_t bytes = 0;
  for (std::uint64_t cycle = 0; bytes < 3ULL * BERM_JOURNAL_RING_BYTES; ++cycle) {
    const int frames = static_cast<int>(cycle * 7 % 500);
    offer(cycle, frames);
    ASSERT_EQ(reader.next(record), RingReader::Result::kRecord);
    ASSERT_TRUE(decode_cycle(record.data(), record.size(), {}, *back, recorded, error)) << error;
    ASSERT_EQ(back->cycle, cycle);
    ASSERT_EQ(back->frame_count, frames);
    if (frames > 0) {
      ASSERT_EQ(back->frame[frames - 1].data[7], static_cast<std::uint8_t>(frames - 1));
    }
    bytes += record.size();
  }
  EXPECT_EQ(reader.next(record), RingReader::Result::kNothing);
  EXPECT_EQ(journal.lost(), 0U);
}

// verifies: SK-JO-2, IF-JR-5
TEST_F(Ring, AFullRingLosesAndCountsAndGoesOnWhenThereIsRoom) {
  std::uint64_t cycle = 0;
  while (journal.lost() < 10) offer(cycle++, 400);
  const std::uint64_t head = ring->head;
  EXPECT_LE(head, BERM_JOURNAL_RING_BYTES);
  EXPECT_EQ(ring->lost, 10U);
  EXPECT_EQ(ring->offered, cycle);
  EXPECT_EQ(journal.lost_before(), 10U);
  RingReader reader(*ring, *tail);
  for (std::uint64_t i = 0; i < cycle - 10; ++i) ASSERT_EQ(reader.next(record), RingReader::Result::kRecord);
  EXPECT_EQ(reader.next(record), RingReader::Result::kNothing);
  offer(cycle, 1);
  ASSERT_EQ(reader.next(record), RingReader::Result::kRecord);
  ASSERT_TRUE(decode_cycle(record.data(), record.size(), {}, *back, recorded, error));
  EXPECT_EQ(recorded.sequence, cycle);
  EXPECT_EQ(back->journal_lost, 10U);
}

// verifies: SK-JO-3
TEST_F(Ring, AWildTailOnlyLosesRecords) {
  const std::uint64_t seed = 77;
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  berm_journal_ring before = *ring;
  for (std::uint64_t cycle = 0; cycle < 20000; ++cycle) {
    const std::uint64_t draws[] = {random(), ring->head + 1 + random() % 100000, ring->head - random() % (2ULL * BERM_JOURNAL_RING_BYTES), ~0ULL, 0};
    tail->tail = draws[random() % 5];
    const std::uint64_t head = ring->head, used = head - tail->tail, lost = journal.lost();
    const int frames = static_cast<int>(random() % 500);
    offer(cycle, frames);
    const std::uint64_t bytes = sizeof(berm_journal_cycle) + static_cast<std::uint64_t>(frames) * sizeof(berm_journal_frame);
    const bool room = used <= BERM_JOURNAL_RING_BYTES && bytes <= BERM_JOURNAL_RING_BYTES - used;
    ASSERT_EQ(ring->head, head + (room ? bytes : 0));
    ASSERT_EQ(journal.lost(), lost + (room ? 0 : 1));
  }
  before.head = ring->head;
  before.lost = ring->lost;
  before.offered = ring->offered;
  EXPECT_EQ(std::memcmp(&before, ring, sizeof before), 0) << "the header and start conditions stay";
  EXPECT_GT(journal.lost(), 1000U);
  EXPECT_LT(journal.lost(), 19000U);
}

// verifies: SK-JO-4
TEST_F(Ring, WithoutAReaderEveryRecordIsLost) {
  offer(0, 1);
  offer(1, 1, false);
  offer(2, 1, false);
  EXPECT_EQ(journal.lost(), 2U);
  EXPECT_EQ(ring->offered, 3U);
}

// verifies: SK-JO-1, IF-JR-1, SK-LI-4
TEST_F(Ring, EveryInputComesBack) {
  offer(5, 3);
  in->clock_fault = in->app_connected = true;
  in->app_connections = 9;
  for (std::size_t i = 0; i < sizeof in->request; ++i) in->request[i] = static_cast<std::uint8_t>(200 - i);
  for (const std::uint8_t echoes : {std::uint8_t{1}, std::uint8_t{3}}) {
    berm_scan_packet p{};
    p.scanner = 1;
    p.sequence = 70000;
    p.scanline = 80000;
    p.time_us = 1234567;
    p.sample_period_ns = 83333;
    p.pan_start_urad = -5;
    p.pan_end_urad = 6;
    p.first_index = 7;
    p.samples_per_revolution = 400;
    p.count = 13;
    p.echoes_per_sample = echoes;
    p.window_percent = 99;
    for (int i = 0; i < p.count; ++i)
      for (int e = 0; e < echoes; ++e) p.range[i][e] = static_cast<std::uint16_t>(100 + 10 * i + e);
    in->packet[in->packet_count++] = p;
  }
  for (int i = 0; i < 3; ++i) {
    std::uint8_t bytes[kernel::kVlp16PacketBytes];
    for (std::size_t k = 0; k < sizeof bytes; ++k) bytes[k] = static_cast<std::uint8_t>(7 * k + static_cast<std::size_t>(i));
    ASSERT_TRUE(in->take_lidar(i % 2, bytes, sizeof bytes));
  }
  RingReader reader(*ring, *tail);
  ASSERT_EQ(reader.next(record), RingReader::Result::kRecord);
  journal.offer(*in, *out, *map, true);
  ASSERT_EQ(reader.next(record), RingReader::Result::kRecord);
  ASSERT_TRUE(decode_cycle(record.data(), record.size(), {}, *back, recorded, error)) << error;
  EXPECT_TRUE(back->clock_fault);
  EXPECT_TRUE(back->app_connected);
  EXPECT_EQ(back->app_connections, 9U);
  EXPECT_EQ(back->now_us, in->now_us);
  EXPECT_EQ(std::memcmp(back->request, in->request, sizeof in->request), 0);
  ASSERT_EQ(back->packet_count, 2);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(std::memcmp(&back->packet[i], &in->packet[i], sizeof in->packet[i]), 0) << i;
  ASSERT_EQ(back->lidar_count, 3);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(std::memcmp(&back->lidar[i], &in->lidar[i], sizeof in->lidar[i]), 0) << i;
}

// verifies: IF-JR-3
TEST_F(Ring, NobodyElseCanWriteTheRingAndNobodyResizesEither) {
  const int fixed = F_SEAL_GROW | F_SEAL_SHRINK | F_SEAL_SEAL;
  EXPECT_EQ(fcntl(journal.ring().fd(), F_GET_SEALS), fixed | F_SEAL_FUTURE_WRITE);
  EXPECT_EQ(fcntl(journal.tail().fd(), F_GET_SEALS), fixed);
  EXPECT_EQ(mmap(nullptr, journal.ring().size(), PROT_READ | PROT_WRITE, MAP_SHARED, journal.ring().fd(), 0), MAP_FAILED);
  for (const kernel::SharedSegment* segment : {&journal.ring(), &journal.tail()}) {
    EXPECT_EQ(ftruncate(segment->fd(), 0), -1);
    EXPECT_EQ(ftruncate(segment->fd(), static_cast<off_t>(segment->size() + 4096)), -1);
  }
  EXPECT_EQ(journal.tail().memory(), nullptr) << "the kernel's own mapping of the tail cannot be written";
}

// verifies: IF-JR-7
TEST_F(Ring, TheMapsRowIsHashedAsTheFormatSays) {
  std::mt19937_64 random(5);
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      map->height_mm[iy][ix] = static_cast<std::int32_t>(random() % 40001) - 20000;
      map->previous_mm[iy][ix] = static_cast<std::int32_t>(random() % 40001) - 20000;
      map->began_us[iy][ix] = static_cast<std::int64_t>(random() >> 1);
      map->seen_us[iy][ix] = static_cast<std::int64_t>(random() >> 1);
    }
  RingReader reader(*ring, *tail);
  for (std::uint64_t cycle = 0; cycle < 2 * 104; ++cycle) {
    const std::size_t row = cycle % 104;
    std::uint64_t hash = 14695981039346656037ULL;
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      const std::uint64_t low = static_cast<std::uint32_t>(map->height_mm[row][ix]), high = static_cast<std::uint32_t>(map->previous_mm[row][ix]);
      for (const std::uint64_t word : {high << 32 | low, static_cast<std::uint64_t>(map->began_us[row][ix]), static_cast<std::uint64_t>(map->seen_us[row][ix])})
        hash = (hash ^ word) * 1099511628211ULL;
    }
    offer(cycle, 0);
    ASSERT_EQ(reader.next(record), RingReader::Result::kRecord);
    berm_journal_cycle head;
    std::memcpy(&head, record.data(), sizeof head);
    ASSERT_EQ(head.map_row_hash, hash) << cycle;
  }
}

// verifies: IF-JR-8
TEST_F(Ring, BehindThePacketsOfTheVlp16EachLidarsIsFollowedByItsNumber) {
  offer(5, 0);
  constexpr std::size_t size = kernel::kVlp16PacketBytes, room = 1208;  // 1206 bytes, the number or none, filled up to 8 bytes
  in->vlp16_count = 2;
  for (const int i : {0, 1}) std::fill_n(in->vlp16[i], size, static_cast<std::uint8_t>(0xA0 + i));
  const int number[] = {1, 0, 3};
  for (int i = 0; i < 3; ++i) {
    const std::vector<std::uint8_t> packet(size, static_cast<std::uint8_t>(0x50 + i));
    ASSERT_TRUE(in->take_lidar(number[i], packet.data(), packet.size()));
  }
  journal.offer(*in, *out, *map, true);
  RingReader reader(*ring, *tail);
  ASSERT_EQ(reader.next(record), RingReader::Result::kRecord);
  ASSERT_EQ(reader.next(record), RingReader::Result::kRecord);
  ASSERT_EQ(record.size(), sizeof(berm_journal_cycle) + 5 * room);
  const std::uint8_t* at = record.data() + sizeof(berm_journal_cycle);
  const auto holds = [&](int byte) { return std::all_of(at, at + size, [&](std::uint8_t b) { return b == byte; }); };
  for (const int i : {0, 1}) {
    EXPECT_TRUE(holds(0xA0 + i)) << "VLP-16 " << i;
    at += room;
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(holds(0x50 + i)) << "lidar's packet " << i;
    EXPECT_EQ(at[size], number[i]);
    EXPECT_EQ(at[size + 1], 0);
    at += room;
  }
}

// verifies: SK-JO-12
TEST_F(Ring, ARecordCutAnywhereOrWithWildFieldsIsRefused) {
  offer(5, 3);
  RingReader reader(*ring, *tail);
  ASSERT_EQ(reader.next(record), RingReader::Result::kRecord);
  for (std::size_t size = 0; size < record.size(); ++size) ASSERT_FALSE(decode_cycle(record.data(), size, {}, *back, recorded, error)) << size;
  for (const std::size_t at : {offsetof(berm_journal_cycle, frames_in), offsetof(berm_journal_cycle, frames_out), offsetof(berm_journal_cycle, scan_packets),
                               offsetof(berm_journal_cycle, vlp16_packets), offsetof(berm_journal_cycle, lidar_packets)}) {
    auto wild = record;
    wild[at + 1] = 0xFF;
    EXPECT_FALSE(decode_cycle(wild.data(), wild.size(), {}, *back, recorded, error)) << at;
  }
}

}  // namespace
}  // namespace berm::record
