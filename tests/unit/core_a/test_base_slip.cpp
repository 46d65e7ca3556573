// What the sums of the registration mean: a block's vote, the weight of the votes, and the rounds until a slip is called.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base_slip.h"

namespace berm::core_test {
namespace {

constexpr std::int32_t kSome = 40;                     // blocks
constexpr std::int32_t kExcluded = -60, kOpen = 0, kLeaning = 20, kFavoured = 60;  // votes of so many blocks

// A round whose shifts are all excluded but one, which has these votes.
bool round_with(sk_slip_state& s, std::int32_t votes, std::int32_t shift = 100, std::int32_t blocks = kSome) {
  bool closed = false;
  for (std::int32_t i = 0; i < SK_SLIP_SHIFTS; ++i) {
    EXPECT_FALSE(closed);
    closed = sk_slip_judge(&s, i == shift ? votes : kExcluded, i == shift ? blocks : kSome);
  }
  return closed;
}

sk_slip_state trusted() {
  sk_slip_state s;
  sk_slip_begin(&s);
  while (s.trust < SK_SLIP_TRUST_LEAST) EXPECT_TRUE(round_with(s, kExcluded));
  return s;
}

// verifies: SK-BM-22
TEST(BaseSlip, AVoteIsTheSumInHalfStandardDeviationsCutAtThree) {
  for (const std::int64_t square : {std::int64_t{SK_SLIP_LEAST_SQUARE}, std::int64_t{65536}, std::int64_t{1000000}, std::int64_t{2147483647}}) {
    for (int level = 1; level <= SK_SLIP_VOTE_MOST; ++level) {
      const auto least = static_cast<std::int32_t>(std::ceil(level * std::sqrt(static_cast<double>(square)) / 2));
      const auto q = static_cast<std::int32_t>(square);
      EXPECT_EQ(sk_slip_vote(least, q), level) << square;
      EXPECT_EQ(sk_slip_vote(-least, q), -level);
      EXPECT_EQ(sk_slip_vote(least - 1, q), level - 1);
    }
    EXPECT_EQ(sk_slip_vote(SK_SLIP_SUM_MAX, static_cast<std::int32_t>(square)), SK_SLIP_VOTE_MOST);
  }
}

// verifies: SK-BM-22
TEST(BaseSlip, ABlockThatSaysTooLittleOrCannotBeHasNoVote) {
  EXPECT_EQ(sk_slip_vote(1000, SK_SLIP_LEAST_SQUARE - 1), 0);
  EXPECT_EQ(sk_slip_vote(1000, 0), 0);
  EXPECT_EQ(sk_slip_vote(1000, -5), 0);
  EXPECT_EQ(sk_slip_vote(SK_SLIP_SUM_MAX + 1, 65536), 0);
  EXPECT_EQ(sk_slip_vote(std::numeric_limits<std::int32_t>::min(), 65536), 0);
}

// Every number of blocks and votes that can be, and some beyond, against the definition in real numbers.
// verifies: SK-BM-22
TEST(BaseSlip, TheWeightFollowsTheVotesOverTheRootOfTheBlocks) {
  for (std::int32_t blocks = -1; blocks <= SK_SLIP_BLOCKS + 1; ++blocks) {
    for (std::int32_t votes = -500; votes <= 500; ++votes) {
      const bool poll = blocks >= SK_SLIP_LEAST_BLOCKS && blocks <= SK_SLIP_BLOCKS && std::abs(votes) <= SK_SLIP_VOTE_MOST * blocks;
      const double deviations = poll ? votes / 2.0 / std::sqrt(blocks) : 0.0;
      const int weight = deviations <= -4 ? SK_SLIP_EXCLUDED : deviations >= 4 ? SK_SLIP_FAVOURED : deviations >= 1 ? SK_SLIP_LEANS : SK_SLIP_OPEN;
      ASSERT_EQ(sk_slip_weigh(votes, blocks), weight) << votes << " votes of " << blocks << " blocks";
    }
  }
}

// verifies: SK-BM-22
TEST(BaseSlip, TwoSuccessiveRoundsThatFavourAShiftAreASlipForGood) {
  sk_slip_state s = trusted();
  round_with(s, kFavoured);
  EXPECT_FALSE(s.slipped);
  round_with(s, kExcluded);
  round_with(s, kFavoured, 0);
  EXPECT_FALSE(s.slipped) << "not successive";
  round_with(s, kFavoured, SK_SLIP_SHIFTS - 1);
  EXPECT_TRUE(s.slipped);
  for (int i = 0; i < 100; ++i) round_with(s, kExcluded);
  EXPECT_TRUE(s.slipped);
  sk_slip_begin(&s);
  EXPECT_FALSE(s.slipped);
  EXPECT_EQ(s.trust, 0);
}

// verifies: SK-BM-23
TEST(BaseSlip, ATerrainThatNeverExcludedEveryShiftShowsNone) {
  sk_slip_state s;
  sk_slip_begin(&s);
  for (int i = 0; i < 1000; ++i) round_with(s, kFavoured);
  EXPECT_FALSE(s.slipped);
  EXPECT_EQ(s.trust, 0);
  // One confirmed round in four others is not enough, ever.
  for (int i = 0; i < 1000; ++i) round_with(s, i % 5 == 0 ? kExcluded : kOpen);
  for (int i = 0; i < 10; ++i) round_with(s, kFavoured);
  EXPECT_FALSE(s.slipped);
}

// verifies: SK-BM-23
TEST(BaseSlip, TrustIsGainedByThreesAndLostByOnes) {
  sk_slip_state s = trusted();
  EXPECT_EQ(s.trust, (SK_SLIP_TRUST_LEAST + SK_SLIP_TRUST_GAIN - 1) / SK_SLIP_TRUST_GAIN * SK_SLIP_TRUST_GAIN);
  for (int i = 0; i < 200; ++i) round_with(s, kExcluded);
  EXPECT_EQ(s.trust, SK_SLIP_TRUST_MOST);
  for (int i = 0; i < SK_SLIP_TRUST_MOST - SK_SLIP_TRUST_LEAST + 1; ++i) round_with(s, kOpen);
  EXPECT_EQ(s.trust, SK_SLIP_TRUST_LEAST - 1);
  round_with(s, kFavoured);
  round_with(s, kFavoured);
  EXPECT_FALSE(s.slipped) << "what it showed is too long ago";
}

// verifies: SK-BM-21, SK-BM-25
TEST(BaseSlip, OneShiftThatIsNotExcludedUnconfirmsAndOneLeantToEndsTheLearning) {
  sk_slip_state s = trusted();
  EXPECT_TRUE(s.confirmed);
  EXPECT_TRUE(s.learns);
  for (std::int32_t shift = 0; shift < SK_SLIP_SHIFTS; shift += 7) {
    round_with(s, kOpen, shift);
    EXPECT_FALSE(s.confirmed);
    EXPECT_TRUE(s.learns);
    round_with(s, kLeaning, shift);
    EXPECT_FALSE(s.confirmed);
    EXPECT_FALSE(s.learns);
    round_with(s, kExcluded);
    EXPECT_TRUE(s.confirmed);
    EXPECT_TRUE(s.learns);
    round_with(s, kExcluded, shift, SK_SLIP_LEAST_BLOCKS - 1);
    EXPECT_FALSE(s.confirmed) << "too few blocks";
  }
  EXPECT_FALSE(s.slipped);
}

}  // namespace
}  // namespace berm::core_test
