// What a reader finds in the state segment at any moment while the kernel writes: between any two instructions of the publisher.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <memory>
#include <vector>

#include "io/publisher.hpp"
#include "mini_machine.hpp"
#include "single_stepped.hpp"

namespace berm::kernel {
namespace {

template <class T>
void fill(T& object, int byte) {
  std::memset(static_cast<void*>(&object), byte, sizeof object);
}

class PublisherOrder : public ::testing::Test {
 protected:
  // The guard is even only while the bytes are all the former ones or all the new ones, whichever it says; and odd in between.
  void expect_guarded(const std::uint32_t& guard, const std::function<bool()>& are_former, const std::function<bool()>& are_new, const std::function<void()>& write) {
    const std::uint32_t before = guard;
    ASSERT_EQ(before % 2, 0U);
    ASSERT_TRUE(are_former());
    long half = 0, steps = test::single_stepped(write, [&](long step) {
      const std::uint32_t now = __atomic_load_n(&guard, __ATOMIC_ACQUIRE);
      if (now == before) ASSERT_TRUE(are_former()) << "the bytes changed under an even guard, step " << step;
      else if (now == before + 2) ASSERT_TRUE(are_new()) << "the guard is even before the bytes are whole, step " << step;
      else ASSERT_EQ(now, before + 1) << "step " << step;
      half += !are_former() && !are_new();
    });
    EXPECT_EQ(guard, before + 2) << "after " << steps << " instructions";
    EXPECT_GT(half, 0) << "the write was never seen half done: nothing was tested";
  }

  const berm_parameters parameters = berm::test::demo_parameters();
  test::Shared<berm_state_segment> segment = test::shared<berm_state_segment>();
  Publisher publisher{*segment, parameters, false};
};

// verifies: IF-CT-14 (the writer's order: state)
TEST_F(PublisherOrder, TheStateChangesUnderAnOddGuardOnly) {
  berm_state former, next;
  fill(former, 0x11);
  fill(next, 0xEE);
  publisher.state(former);
  const auto holds = [&](const berm_state& s) { return std::memcmp(&segment->state, &s, sizeof s) == 0; };
  expect_guarded(segment->state_guard, [&] { return holds(former); }, [&] { return holds(next); }, [&] { publisher.state(next); });
}

// verifies: IF-CT-14 (the writer's order: slices)
TEST_F(PublisherOrder, TheSlicesChangeUnderAnOddGuardOnly) {
  const auto former = std::make_unique<SliceSet>(), next = std::make_unique<SliceSet>();
  fill(former->slice, 0x11);
  fill(next->slice, 0x6E);
  former->count = 2;
  next->count = 3;
  publisher.slices(*next);
  const std::vector<berm_slice> next_slices(segment->slice, segment->slice + 3);
  publisher.slices(*former);
  const std::vector<berm_slice> former_slices(segment->slice, segment->slice + 3);  // the third is not of it, and stays
  const auto holds = [&](const std::vector<berm_slice>& slices, std::uint32_t count) {
    return segment->slice_count == count && std::memcmp(segment->slice, slices.data(), count * sizeof slices[0]) == 0;
  };
  expect_guarded(segment->slice_guard, [&] { return holds(former_slices, 2); }, [&] { return holds(next_slices, 3); }, [&] { publisher.slices(*next); });
}

// Heights of which every byte differs: what was stored in parts would be seen as neither.
// verifies: IF-CT-17 (each cell is stored as one)
TEST_F(PublisherOrder, ACellOfTheMapIsNeverHalfWritten) {
  static_assert(offsetof(berm_state_segment, map_height_mm) % sizeof segment->map_height_mm[0][0] == 0);
  constexpr std::int32_t former = -0x01020304, next = 0x01020304;
  constexpr std::int64_t now = 1'000'000;
  const auto map = std::make_unique<sk_height_map>();
  const auto publish = [&](std::int32_t height) {
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      map->height_mm[0][ix] = map->previous_mm[0][ix] = height;
      map->began_us[0][ix] = map->seen_us[0][ix] = now;
    }
  };
  sk_map_clear(map.get());
  publish(former);
  for (int cycle = 0; cycle < SK_MAP_CELLS / Publisher::kMapRows; ++cycle) publisher.map_rows(*map, now);
  publish(next);
  int changes = 0;
  std::int32_t last[SK_MAP_CELLS];
  std::memcpy(last, segment->map_height_mm[0], sizeof last);
  test::single_stepped([&] { publisher.map_rows(*map, now); },
                       [&](long step) {
                         const auto& row = segment->map_height_mm[0];
                         if (std::memcmp(row, last, sizeof last) == 0) return;
                         std::memcpy(last, row, sizeof last);
                         ++changes;
                         for (int ix = 0; ix < SK_MAP_CELLS; ++ix) ASSERT_TRUE(row[ix] == former || row[ix] == next) << "cell " << ix << ": " << row[ix] << ", step " << step;
                       });
  EXPECT_GT(changes, 0);
  for (const std::int32_t height : segment->map_height_mm[0]) ASSERT_EQ(height, next);
}

}  // namespace
}  // namespace berm::kernel
