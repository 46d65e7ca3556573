#include <gtest/gtest.h>

#include <vector>

#include "geometry/scan_projection.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint32_t threshold = 1000;

std::vector<uint32_t> filtered(std::vector<uint32_t> ranges, std::vector<uint8_t> own = {}) {
  const std::vector<uint32_t> before = ranges;
  own.resize(ranges.size(), 0);
  const int dropped = filter_spurious(ranges.data(), own.data(), static_cast<int>(ranges.size()), threshold);
  int changed = 0;
  for (size_t i = 0; i < ranges.size(); ++i) {
    EXPECT_TRUE(ranges[i] == before[i] || ranges[i] == 0);
    changed += ranges[i] != before[i] ? 1 : 0;
  }
  EXPECT_EQ(dropped, changed);
  return ranges;
}

using Ranges = std::vector<uint32_t>;

} // namespace

// verifies: SK-GE-23
TEST(Spurious, DropsOneReturnThatDiffersFromBothNeighbours) {
  EXPECT_EQ(filtered({5000, 5000, 2000, 5000, 5000}), (Ranges{5000, 5000, 0, 5000, 5000}));
  EXPECT_EQ(filtered({5000, 5000, 9000, 5000, 5000}), (Ranges{5000, 5000, 0, 5000, 5000}));
  EXPECT_EQ(filtered({5000, 5000, 0, 2000, 0, 5000, 5000}), (Ranges{5000, 5000, 0, 0, 0, 5000, 5000})); // neighbours within two samples
}

// verifies: SK-GE-23
TEST(Spurious, TheThresholdItselfIsKept) {
  EXPECT_EQ(filtered({5000, 4000, 5000}), (Ranges{5000, 4000, 5000}));
  EXPECT_EQ(filtered({5000, 5000, 3999, 5000, 5000}), (Ranges{5000, 5000, 0, 5000, 5000}));
}

// Ground that recedes steeply is no spurious return, however far apart its samples lie.
// verifies: SK-GE-23
TEST(Spurious, KeepsAReturnBetweenItsNeighbours) {
  EXPECT_EQ(filtered({4500, 5000, 7000, 9500, 10000}), (Ranges{4500, 5000, 7000, 9500, 10000}));
  EXPECT_EQ(filtered({10000, 9500, 7000, 5000, 4500}), (Ranges{10000, 9500, 7000, 5000, 4500}));
}

// verifies: SK-GE-23
TEST(Spurious, KeepsTwoReturnsThatAgree) {
  EXPECT_EQ(filtered({9000, 9000, 5000, 5100, 9000, 9000}), (Ranges{9000, 9000, 5000, 5100, 9000, 9000}));
  EXPECT_EQ(filtered({0, 0, 0, 5000, 5100, 0, 0, 0}), (Ranges{0, 0, 0, 5000, 5100, 0, 0, 0}));
  EXPECT_EQ(filtered({0, 0, 0, 5000, 0, 5100, 0, 0, 0}), (Ranges{0, 0, 0, 5000, 0, 5100, 0, 0, 0}));
}

// verifies: SK-GE-23
TEST(Spurious, DropsAReturnWithoutNeighbours) {
  EXPECT_EQ(filtered({0, 0, 0, 5000, 0, 0, 0}), (Ranges{0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(filtered({5000, 0, 0, 5000, 0, 0, 5000}), (Ranges{0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(filtered({5000}), (Ranges{0}));
}

// One neighbour must agree: a lone return against the sky is a bird or noise. A run's last return that agrees stays.
// verifies: SK-GE-23
TEST(Spurious, WantsAnAgreeingNeighbourAtTheEndOfARun) {
  EXPECT_EQ(filtered({5000, 2000}), (Ranges{0, 0}));
  EXPECT_EQ(filtered({5000, 5000, 2000, 0, 0, 0}), (Ranges{5000, 5000, 0, 0, 0, 0}));
  EXPECT_EQ(filtered({5000, 5000, 5500, 0, 0, 0}), (Ranges{5000, 5000, 5500, 0, 0, 0}));
}

// Each return is judged by its neighbours as they came, not by what the filter left of them.
// verifies: SK-GE-23
TEST(Spurious, JudgesByTheRawNeighbours) {
  EXPECT_EQ(filtered({9000, 9000, 2000, 9000, 2000, 9000, 9000}), (Ranges{9000, 9000, 0, 0, 0, 9000, 9000}));
  EXPECT_EQ(filtered({9000, 9000, 2000, 6000, 6000}), (Ranges{9000, 9000, 0, 6000, 6000}));
}

// Of two in a row that do not agree, one lies between the other and the ground.
// verifies: SK-GE-23
TEST(Spurious, DropsBothOfTwoInARowThatDoNotAgree) {
  EXPECT_EQ(filtered({9000, 9000, 2000, 6000, 9000, 9000}), (Ranges{9000, 9000, 0, 0, 9000, 9000}));
  EXPECT_EQ(filtered({9000, 9000, 6000, 2000, 9000, 9000}), (Ranges{9000, 9000, 0, 0, 9000, 9000}));
  EXPECT_EQ(filtered({9000, 9000, 14000, 30000, 9000, 9000}), (Ranges{9000, 9000, 0, 0, 9000, 9000}));
  EXPECT_EQ(filtered({9000, 0, 9000, 0, 2000, 0, 6000, 0, 9000, 0, 9000}), (Ranges{9000, 0, 9000, 0, 0, 0, 0, 0, 9000, 0, 9000}));
}

// But the second one stays where it lies between what is before and behind both, and ground that recedes from an edge loses nothing.
// verifies: SK-GE-23
TEST(Spurious, KeepsTheGroundBesideOneThatStandsOut) {
  EXPECT_EQ(filtered({5000, 5000, 2000, 7000, 9500, 12000, 12500}), (Ranges{5000, 5000, 0, 7000, 9500, 12000, 12500}));

  EXPECT_EQ(filtered({5000, 5000, 7000, 9500, 12000, 12500}), (Ranges{5000, 5000, 7000, 9500, 12000, 12500}));
  EXPECT_EQ(filtered({9000, 9000, 2000, 4000, 6000, 9000, 9000}), (Ranges{9000, 9000, 0, 0, 6000, 9000, 9000})) << "of what recedes before farther ground the first two go";
}

// A lone return over the own bucket: what agrees with it, or encloses it, is the machine itself.
// verifies: SK-GE-23
TEST(Spurious, TheOwnMachineSupportsNothing) {
  EXPECT_EQ(filtered({4000, 4000, 4500, 4000, 4000}, {1, 1, 0, 1, 1})[2], 0u);
  EXPECT_EQ(filtered({4000, 4000, 6000, 8000, 8000}, {1, 1, 0, 1, 1})[2], 0u);
  EXPECT_EQ(filtered({5348, 5348, 6784, 26320, 30080}, {1, 1, 0, 0, 0})[2], 0u) << "over the bucket's edge, far ground behind";
  EXPECT_EQ(filtered({30080, 26320, 6784, 5348, 5348}, {0, 0, 0, 1, 1})[2], 0u);
  EXPECT_EQ(filtered({4000, 0, 4500, 0, 4000}, {1, 0, 0, 0, 1})[2], 0u);
  EXPECT_EQ(filtered({4000, 4000, 4500}, {1, 1, 0})[2], 0u);
}

// Ground or a person beside the bucket's edge is no less seen than elsewhere.
// verifies: SK-GE-23
TEST(Spurious, BesideTheOwnMachineAReturnKeepsItsOtherNeighbour) {
  EXPECT_EQ(filtered({4000, 4000, 7000, 7500}, {1, 1, 0, 0})[2], 7000u);
  EXPECT_EQ(filtered({4000, 4000, 7000, 9500, 12000}, {1, 1, 0, 0, 0}), (Ranges{0, 0, 0, 9500, 0})) << "ground that recedes loses its first sample";
  EXPECT_EQ(filtered({7500, 7000, 4000, 4000}, {0, 0, 1, 1})[1], 7000u);
  EXPECT_EQ(filtered({4000, 6000, 6500, 4000}, {1, 0, 0, 1}), (Ranges{0, 6000, 6500, 0})) << "two that agree between the arm's sides";
}

// The smallest object that is never hidden: two samples in a row that agree, wherever they lie in the run and whatever is behind them.
// verifies: SK-GE-23
TEST(Spurious, NeverHidesTwoAgreeingSamplesInARow) {
  for (const uint32_t behind : {0u, 3000u, 9000u, 60000u})
    for (int n = 2; n <= 40; ++n)
      for (int at = 0; at + 1 < n; ++at)
        for (const uint32_t step : {0u, 500u, 1000u}) {
          Ranges ranges(static_cast<size_t>(n), behind);
          ranges[static_cast<size_t>(at)] = 5000;
          ranges[static_cast<size_t>(at) + 1] = 5000 + step;
          const Ranges out = filtered(ranges);
          ASSERT_EQ(out[static_cast<size_t>(at)], 5000u);
          ASSERT_EQ(out[static_cast<size_t>(at) + 1], 5000 + step);
        }
}

// verifies: SK-GE-23
TEST(Spurious, AnEmptyRunIsFine) {
  uint32_t none = 7;
  EXPECT_EQ(filter_spurious(&none, nullptr, 0, threshold), 0);
  EXPECT_EQ(none, 7u);
}

} // namespace berm::kernel::test
