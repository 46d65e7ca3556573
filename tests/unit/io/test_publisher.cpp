// What a reader finds in the state segment: what the kernel published, under even locks, each ring's entry in its place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include "io/publisher.hpp"
#include "mini_machine.hpp"

namespace berm::kernel {
namespace {

class PublisherTest : public ::testing::Test {
 protected:
  const berm_parameters parameters = berm::test::demo_parameters();
  std::unique_ptr<berm_state_segment> segment = std::make_unique<berm_state_segment>();
  Publisher publisher{*segment, parameters, false};
};

// verifies: IF-CT-3 (the kernel's side), IF-CT-20
TEST_F(PublisherTest, TheHeadIsThereBeforeAnythingIsPublishedAndStays) {
  const auto head = [&] {
    return std::vector<std::int64_t>{segment->magic, segment->version, segment->size, segment->cell_mm, segment->map_origin_mm, segment->parameter_crc32};
  };
  const auto before = head();
  EXPECT_EQ(before, (std::vector<std::int64_t>{BERM_CONTRACT_MAGIC, BERM_CONTRACT_VERSION, sizeof(berm_state_segment), SK_CELL_MM, SK_MAP_ORIGIN_MM,
                                               static_cast<std::uint32_t>(parameters.crc32)}));
  const auto map = std::make_unique<sk_height_map>();
  sk_map_clear(map.get());
  publisher.state(berm_state{});
  publisher.decision(berm_decision{});
  publisher.map_rows(*map, 0);
  publisher.wake();
  EXPECT_EQ(head(), before);
}

// verifies: IF-CT-14 (that the guards are even and have moved on after a write)
TEST_F(PublisherTest, StateAndSlicesStandUnderEvenGuardsThatMoveOn) {
  for (std::uint32_t n = 1; n <= 3; ++n) {
    berm_state state{};
    state.cycle = n;
    publisher.state(state);
    EXPECT_EQ(segment->state_guard, 2 * n);
    EXPECT_EQ(segment->state.cycle, n);
    const auto slices = std::make_unique<SliceSet>();
    slices->count = static_cast<std::int32_t>(n);
    slices->slice[n - 1].link = 2;
    slices->slice[n - 1].vertices = SK_SLICE_VERTICES;
    slices->slice[n - 1].xyz_mm[2][SK_SLICE_VERTICES - 1] = -700;
    publisher.slices(*slices);
    EXPECT_EQ(segment->slice_guard, 2 * n);
    EXPECT_EQ(segment->slice_count, n);
    EXPECT_EQ(segment->slice[n - 1].link, 2U);
    EXPECT_EQ(segment->slice[n - 1].vertex_mm[SK_SLICE_VERTICES - 1][2], -700);
  }
}

// verifies: IF-CT-15
TEST_F(PublisherTest, BlockNOfTheScanRingSaysThatItIsBlockN) {
  const auto blocks = std::make_unique<ScanBlocks>();
  blocks->count = 1;
  for (std::uint32_t n = 0; n < 2 * BERM_SCAN_RING + 5; ++n) {
    blocks->block[0].sequence = 77;  // not the block's own to say
    blocks->block[0].scanline = n;
    publisher.scans(*blocks);
    ASSERT_EQ(segment->scan_head, n + 1);
    const berm_scan_block& written = segment->scan[n % BERM_SCAN_RING];
    ASSERT_EQ(written.sequence, 2 * n + 2);
    ASSERT_EQ(written.scanline, n);
  }
  EXPECT_NE(segment->scan[0].sequence, 2U) << "block 0 has been overwritten, and says so";
}

// verifies: IF-CT-16 (the writer's side)
TEST_F(PublisherTest, DecisionNIsAtItsPlaceInTheRing) {
  for (std::uint32_t n = 0; n < 2 * BERM_DECISION_RING + 5; ++n) {
    berm_decision decision{};
    decision.cycle = n;
    publisher.decision(decision);
    ASSERT_EQ(segment->decision_head, n + 1);
    for (std::uint32_t back = 0; back < std::min<std::uint32_t>(n + 1, BERM_DECISION_RING); ++back)
      ASSERT_EQ(segment->decision[(n - back) % BERM_DECISION_RING].cycle, n - back);
  }
}

// verifies: IF-CT-17
TEST_F(PublisherTest, TheWholeMapIsRefreshedWithinThirteenCycles) {
  const auto map = std::make_unique<sk_height_map>();
  sk_map_clear(map.get());
  for (auto& row : segment->map_status) std::fill(std::begin(row), std::end(row), std::uint8_t{0xEE});
  for (int cycle = 0; cycle < 13; ++cycle) publisher.map_rows(*map, 0);
  for (const auto& row : segment->map_status)
    for (const std::uint8_t status : row) ASSERT_EQ(status, BERM_CELL_UNKNOWN);
  const std::int64_t now = 1'000'000;
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy) {
    map->height_mm[iy][iy] = map->previous_mm[iy][iy] = 10 * iy;
    map->began_us[iy][iy] = map->seen_us[iy][iy] = now;
  }
  for (int cycle = 0; cycle < 13; ++cycle) publisher.map_rows(*map, now);
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy) {
    ASSERT_EQ(segment->map_status[iy][iy], BERM_CELL_OBSERVED) << iy;
    ASSERT_EQ(segment->map_height_mm[iy][iy], 10 * iy) << iy;
  }
  for (int cycle = 0; cycle < 13; ++cycle) publisher.map_rows(*map, now + parameters.fresh_us + 1);
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy) ASSERT_EQ(segment->map_status[iy][iy], BERM_CELL_STALE) << iy;
}

// verifies: IF-CT-18 (that the word counts cycles)
TEST_F(PublisherTest, TheWakeWordGoesUpByOne) {
  for (std::uint32_t n = 1; n <= 5; ++n) {
    publisher.wake();
    EXPECT_EQ(segment->wake, n);
  }
}

}  // namespace
}  // namespace berm::kernel
