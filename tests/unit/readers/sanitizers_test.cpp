// That the other tests of this program would fail where a reader reads beyond its bytes, or overflows: without the sanitizers these do not.
#include <gtest/gtest.h>

#include <climits>
#include <cstdio>
#include <memory>

namespace {

TEST(SanitizersDeathTest, AReadBeyondTheEndEndsTheProgram) {
  constexpr std::size_t kBytes = 16;
  const auto bytes = std::make_unique<unsigned char[]>(kBytes);
  volatile std::size_t at = kBytes;
  EXPECT_DEATH(std::printf("%d", bytes[at]), "AddressSanitizer: heap-buffer-overflow");
}

TEST(SanitizersDeathTest, AnOverflowEndsTheProgram) {
  volatile int most = INT_MAX;
  EXPECT_DEATH(std::printf("%d", most + 1), "signed integer overflow");
}

}  // namespace
