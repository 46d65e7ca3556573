// The histograms of heights: random sequences beside a reference of other code.
#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <memory>
#include <random>

#include "histogram_scene.hpp"
#include "reference_histogram.hpp"

namespace berm::core_test {
namespace {

constexpr std::uint64_t kSeed = 4711;

// All that can be said of a cell, of either.
void expect_same(const sk_monitor_histogram& h, const ReferenceHistogram& reference, int iy, int ix, int turn) {
  const ReferenceHistogram::Cell c = reference.cell({iy, ix});
  const int states[] = {SK_CELL_LEARNING, SK_CELL_CLEAR, SK_CELL_SOMEBODY};
  ASSERT_EQ(h.state[iy][ix], states[static_cast<int>(c.state)]) << turn << ": " << iy << " " << ix;
  ASSERT_EQ(h.observed[iy][ix], static_cast<std::uint32_t>(c.observed)) << turn;
  for (std::size_t back = 0; back < 2; ++back)
    ASSERT_EQ(h.departed_us[iy][ix][back], back < c.departed.size() ? c.departed[c.departed.size() - 1 - back] : -1) << turn << ": " << back;
  ASSERT_EQ(h.ground_us[iy][ix], c.ground < 0 ? SK_NO_GROUND : static_cast<std::uint64_t>(c.ground)) << turn;
  ASSERT_EQ(h.lines[iy][ix], c.votes) << turn;
  ASSERT_EQ(h.line_mm[iy][ix], c.line) << turn;
  for (int b = 0; b < SK_HISTOGRAM_BINS; ++b) {
    const auto found = c.seen.find(b);
    ASSERT_EQ(h.seen[iy][ix][b], found == c.seen.end() ? 0 : found->second) << turn << ": bin " << b;
  }
}

bool lower_half(ReferenceHistogram::Place at) { return at.first < 52; }

// verifies: SK-WM-60, SK-WM-61, SK-WM-62, SK-WM-63, SK-WM-64, SK-WM-65, SK-WM-67, SK-WM-68, SK-WM-71, SK-WM-72
TEST_F(MonitorHistogram, RandomSequencesAreAsTheReferenceHasThem) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  std::mt19937_64 random(kSeed);
  const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto others = std::make_unique<sk_monitor_histogram>();
  int departed = 0, stops = 0, left = 0, passed = 0;
  for (int sequence = 0; sequence < 30; ++sequence) {
    ReferenceHistogram reference, reference_of_others;
    sk_histogram_begin(h.get());
    sk_histogram_begin(others.get());
    now_us = below(1'000'000);
    rules->height_threshold_mm = 100 + below(900);
    rules->wait_us = sequence % 5 == 0 ? 0 : below(400'000);
    rules->period_us = 1 + below(100'000);
    rules->dwell_us = below(500'000);
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) rules->watched[iy][ix] = lower_half({iy, ix}) ? 1 : 0;
    const ReferenceRules r{rules->height_threshold_mm, rules->wait_us, rules->period_us, rules->dwell_us};
    const int corner = sequence % 3 == 0 ? -1 : 50;  // at the map's border too
    for (int turn = 0; turn < 6000; ++turn) {
      const int iy = corner + below(4), ix = corner + below(4), what = below(1000);
      now_us += below(20) == 0 ? below(200'000) : below(2000);
      if (below(500) == 0) now_us -= below(300'000);
      if (now_us < 0) now_us = 0;
      const bool was = sk_is_in_map(iy, ix) && somebody(iy, ix);
      if (what < 2) {
        const std::int32_t x = SK_MAP_ORIGIN_MM + SK_CELL_MM * ix + below(500), y = SK_MAP_ORIGIN_MM + SK_CELL_MM * iy + below(500);
        sk_histogram_forget(h.get(), x, y, x + 200, y + 400);
        reference.forget(x, y, x + 200, y + 400);
      } else if (what < 6) {
        const std::int32_t x = SK_MAP_ORIGIN_MM + SK_CELL_MM * ix, y = SK_MAP_ORIGIN_MM + SK_CELL_MM * iy;
        sk_histogram_settle(h.get(), x - 600, y - 600, x + 600, y + 600);
        reference.settle(x - 600, y - 600, x + 600, y + 600);
      } else if (what < 40) {
        const std::int32_t z = below(3) > 0 ? below(200) : below(2000) - 500;
        sk_histogram_line(h.get(), iy, ix, z);
        reference.line({iy, ix}, z);
      } else if (what < 100) {
        const std::int32_t z = below(20) > 0 ? below(2500) - 500 : std::numeric_limits<std::int32_t>::max() - below(2);
        sk_histogram_beside(h.get(), iy, ix, z);
        reference.beside({iy, ix}, z);
      } else if (what < 300) {
        const std::int32_t z = below(5) > 0 ? below(400) : below(2500) - 500;
        const std::int64_t at_us = below(50) == 0 ? -1 : now_us;
        sk_histogram_pass(h.get(), sk_histogram_known(others.get(), iy, ix), rules.get(), iy, ix, z, at_us);
        reference.pass(r, reference_of_others, {iy, ix}, z, at_us);
        passed += was && !somebody(iy, ix) ? 1 : 0;
      } else {
        std::int32_t z = below(300);
        if (below(30) == 0) z = 500 + below(1500);
        if (below(300) == 0) z = below(2) == 0 ? -6000 : 7000;
        if (below(3000) == 0) z = below(2) == 0 ? std::numeric_limits<std::int32_t>::min() : std::numeric_limits<std::int32_t>::max();
        if (sequence % 2 == 0 && below(3) == 0) {  // what the others see
          sk_histogram_insert(others.get(), SK_NOBODY_KNOWS, false, rules.get(), iy, ix, z, now_us);
          reference_of_others.insert(r, reference_of_others, false, {iy, ix}, z, now_us);
          continue;
        }
        if (below(20) == 0) {
          sk_histogram_settle(others.get(), kLow, kLow, kHigh, kHigh);
          reference_of_others.settle(kLow, kLow, kHigh, kHigh);
        }
        const std::int32_t known = sk_histogram_known(others.get(), iy, ix);
        const bool yields = below(2) == 0;
        const bool departs = sk_histogram_insert(h.get(), known, yields, rules.get(), iy, ix, z, now_us);
        ASSERT_EQ(departs, reference.insert(r, reference_of_others, yields, {iy, ix}, z, now_us)) << sequence << " " << turn << ": " << z << " mm";
        departed += departs ? 1 : 0;
        left += was && !somebody(iy, ix) ? 1 : 0;
      }
      if (sk_is_in_map(iy, ix)) expect_same(*h, reference, iy, ix, turn);
      if (HasFatalFailure()) return;
      if (turn % 7 != 0) continue;
      ReferenceHistogram::Place expected;
      const bool stop = reference.step(r, lower_half, now_us, expected);
      ASSERT_EQ(step(), stop) << sequence << " " << turn;
      ASSERT_EQ(where.iy, expected.first);
      ASSERT_EQ(where.ix, expected.second);
      stops += stop ? 1 : 0;
    }
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) expect_same(*h, reference, iy, ix, -1);
  }
  std::printf("%d points departed, %d steps said stop, %d times somebody left, %d times more by what passed\n", departed, stops, left, passed);
  EXPECT_GT(departed, 1000);
  EXPECT_GT(stops, 100);
  EXPECT_GT(left, 10);
  EXPECT_GT(passed, 3);
}

}  // namespace
}  // namespace berm::core_test
