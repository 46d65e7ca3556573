// The plant's generator draws what the standard library's draws.
#include <gtest/gtest.h>

#include <random>

#include "plant/world/twister.hpp"

namespace berm::plant {
namespace {

TEST(Twister, DrawsWhatTheStandardOneDraws) {
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{5489}, ~std::uint64_t{0}, std::uint64_t{0x9E3779B97F4A7C15}}) {
    Twister twister(seed);
    std::mt19937_64 standard(seed);
    for (int i = 0; i < 10000; ++i) ASSERT_EQ(twister(), standard()) << "seed " << seed << ", draw " << i;
  }
}

}  // namespace
}  // namespace berm::plant
