// ISO 13855's distance, what a sector remembers, and the stopping time that is left.
#include <gtest/gtest.h>

#include <memory>

#include "core/separation.h"

namespace berm::core_test {
namespace {

constexpr std::int32_t kMemory = 1'000'000;
constexpr sk_separation_rules kWalking = {1600, 1200, 500'000};

sk_sector unseen() { return {-1, 0, 0, 0}; }

// verifies: SK-SD-1
TEST(Separation, DistanceIsRoundedUp) {
  EXPECT_EQ(sk_separation_distance(1600, 0, 0), 0);
  EXPECT_EQ(sk_separation_distance(1600, 1'000'000, 0), 1600);
  EXPECT_EQ(sk_separation_distance(1600, 1, 0), 1);
  EXPECT_EQ(sk_separation_distance(1600, 1'000'001, 1200), 2801);
  EXPECT_EQ(sk_separation_distance(2000, 500'000, 850), 1850);
  EXPECT_EQ(sk_separation_distance(SK_APPROACH_MOST_MM_S, SK_SEPARATION_TIME_MOST_US, SK_INTRUSION_MOST_MM), 20'000'000 + 10'000);
}

// verifies: SK-SD-1
TEST(Separation, DistanceRefusesWhatIsOutOfRange) {
  EXPECT_EQ(sk_separation_distance(-1, 0, 0), -1);
  EXPECT_EQ(sk_separation_distance(SK_APPROACH_MOST_MM_S + 1, 0, 0), -1);
  EXPECT_EQ(sk_separation_distance(1600, -1, 0), -1);
  EXPECT_EQ(sk_separation_distance(1600, std::int64_t{SK_SEPARATION_TIME_MOST_US} + 1, 0), -1);
  EXPECT_EQ(sk_separation_distance(1600, INT64_MAX, 0), -1);
  EXPECT_EQ(sk_separation_distance(1600, 0, -1), -1);
  EXPECT_EQ(sk_separation_distance(1600, 0, SK_INTRUSION_MOST_MM + 1), -1);
}

// verifies: SK-SD-2
TEST(Separation, ASectorNeverSeenIsBlindForEver) {
  sk_sector s = unseen();
  EXPECT_EQ(sk_sector_blind(&s, 0), SK_BLIND_MOST_US);
  sk_sector_see(&s, 5'000'000, kMemory);
  EXPECT_EQ(sk_sector_blind(&s, 5'000'000), 0) << "the first look ends no gap";
  EXPECT_EQ(sk_sector_blind(&s, 5'300'000), 300'000);
  EXPECT_EQ(sk_sector_blind(&s, 5'000'000 + std::int64_t{SK_BLIND_MOST_US} + 1), SK_BLIND_MOST_US);
  EXPECT_EQ(sk_sector_blind(&s, 4'999'999), SK_BLIND_MOST_US) << "time has run backwards";
}

// verifies: SK-SD-3
TEST(Separation, AGapIsRememberedAsLongAsWhoCameInItMayNotHaveBeenToldOf) {
  sk_sector s = unseen();
  sk_sector_see(&s, 1'000'000, kMemory);
  sk_sector_see(&s, 4'000'000, kMemory);  // three seconds unseen
  for (std::int64_t t = 4'010'000; t <= 4'000'000 + kMemory; t += 10'000) {
    sk_sector_see(&s, t, kMemory);
    ASSERT_EQ(sk_sector_blind(&s, t), 3'000'000) << t;
  }
  for (std::int64_t t = 5'010'000; t <= 4'000'000 + 2 * kMemory + 50'000; t += 10'000) sk_sector_see(&s, t, kMemory);
  EXPECT_EQ(sk_sector_blind(&s, 6'050'000), 10'000) << "seen since without a gap: forgotten";
}

// verifies: SK-SD-3
TEST(Separation, ASmallerGapDoesNotEndWithALargerOne) {
  sk_sector s = unseen();
  sk_sector_see(&s, 1'000'000, kMemory);
  sk_sector_see(&s, 6'000'000, kMemory);
  sk_sector_see(&s, 6'900'000, kMemory);  // 0.9 s
  for (std::int64_t t = 6'910'000; t <= 6'900'000 + kMemory; t += 10'000) {
    sk_sector_see(&s, t, kMemory);
    ASSERT_GE(sk_sector_blind(&s, t), 900'000) << t;
  }
}

// verifies: SK-SD-2
TEST(Separation, ALookBackInTimeChangesNothing) {
  sk_sector s = unseen();
  sk_sector_see(&s, 2'000'000, kMemory);
  const sk_sector before = s;
  sk_sector_see(&s, 1'999'999, kMemory);
  sk_sector_see(&s, -1, kMemory);
  sk_sector_see(&s, 3'000'000, -1);
  EXPECT_EQ(s.seen_us, before.seen_us);
  EXPECT_EQ(s.window_us, before.window_us);
  EXPECT_EQ(s.gap_us, before.gap_us);
  EXPECT_EQ(s.gap_before_us, before.gap_before_us);
}

// verifies: SK-SD-5
TEST(Separation, StopTimeIsWhatTheDistanceLeaves) {
  // 9.2 m less 1.2 m at 1.6 m/s: 5 s.
  EXPECT_EQ(sk_separation_stop_time(kWalking, 1'000'000, 9200), 3'500'000);
  EXPECT_EQ(sk_separation_stop_time(kWalking, 4'500'000, 9200), 0) << "who stands still may go on standing";
  EXPECT_EQ(sk_separation_stop_time(kWalking, 4'500'001, 9200), -1);
  EXPECT_EQ(sk_separation_stop_time(kWalking, 0, 1199), -1) << "nearer than C";
  EXPECT_EQ(sk_separation_stop_time(kWalking, 0, -5), -1) << "the implements reach beyond the region";
  EXPECT_EQ(sk_separation_stop_time(kWalking, 0, INT32_MIN), -1);
  EXPECT_EQ(sk_separation_stop_time({SK_APPROACH_LEAST_MM_S, 0, 0}, SK_BLIND_MOST_US, SK_COORD_MAX_MM), -1) << "unseen for ever";
}

// verifies: SK-SD-5
TEST(Separation, StopTimeRefusesRulesOutOfRange) {
  EXPECT_EQ(sk_separation_stop_time({SK_APPROACH_LEAST_MM_S - 1, 0, 0}, 0, 9000), -1);
  EXPECT_EQ(sk_separation_stop_time({SK_APPROACH_MOST_MM_S + 1, 0, 0}, 0, 9000), -1);
  EXPECT_EQ(sk_separation_stop_time({1600, -1, 0}, 0, 9000), -1);
  EXPECT_EQ(sk_separation_stop_time({1600, SK_INTRUSION_MOST_MM + 1, 0}, 0, 9000), -1);
  EXPECT_EQ(sk_separation_stop_time({1600, 0, -1}, 0, 9000), -1);
  EXPECT_EQ(sk_separation_stop_time({1600, 0, SK_DETECT_MOST_US + 1}, 0, 9000), -1);
  EXPECT_EQ(sk_separation_stop_time(kWalking, -1, 9000), -1);
  EXPECT_EQ(sk_separation_stop_time(kWalking, SK_BLIND_MOST_US + 1, 9000), -1);
  EXPECT_EQ(sk_separation_stop_time(kWalking, 0, SK_COORD_MAX_MM + 1), -1);
}

// verifies: SK-SD-6
TEST(Separation, TheWorstSectorDecidesAndIsNamed) {
  auto s = std::make_unique<sk_sectors>();
  sk_sectors_begin(s.get());
  EXPECT_EQ(sk_separate(s.get(), 1'000'000, kWalking, 9200).stop_us, -1);
  for (sk_sector& sector : s->sector) sk_sector_see(&sector, 1'000'000, kMemory);
  for (int k = 0; k < SK_SECTORS; ++k)
    if (k != 117) sk_sector_see(&s->sector[k], 2'000'000, kMemory);
  // The others have a gap of one second, sector 117 is seen no more.
  for (sk_sector& sector : s->sector)
    if (&sector != &s->sector[117]) sk_sector_see(&sector, 2'500'000, kMemory);
  const sk_separation left = sk_separate(s.get(), 2'500'000, kWalking, 9200);
  EXPECT_EQ(left.sector, 117);
  EXPECT_EQ(left.stop_us, 5'000'000 - 500'000 - 1'500'000);
  sk_sector_see(&s->sector[117], 2'500'000, kMemory);
  EXPECT_EQ(sk_separate(s.get(), 2'500'000, kWalking, 9200).sector, 117) << "its gap is remembered";
}

}  // namespace
}  // namespace berm::core_test
