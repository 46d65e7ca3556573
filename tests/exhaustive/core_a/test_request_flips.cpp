// Every single and double bit flip of a valid request is refused, by the check whose field was hit, and nothing is touched.
#include <gtest/gtest.h>

#include "request_bytes.hpp"
#include "valid_parameters.hpp"

namespace berm::core_test {
namespace {

constexpr int kBits = SK_REQUEST_BYTES * 8;

void flip(RequestBytes& raw, int bit) { raw[static_cast<std::size_t>(bit / 8)] ^= static_cast<std::uint8_t>(1u << (bit % 8)); }

std::int32_t refusal(int bit) {
  if (bit < 4 * 8) return BERM_REQUEST_MAGIC;
  return bit < 6 * 8 ? BERM_REQUEST_VERSION : BERM_REQUEST_CRC;
}

class RequestFlips : public testing::Test {
 protected:
  // True when refused as expected and nothing was touched.
  bool refused(const RequestBytes& raw, std::int32_t expected) {
    sk_request_state state = state_before();
    sk_request out = untouched_output();
    const std::int32_t result = sk_request_check(&state, raw.data(), &parameters, kNow, &out);
    return result == expected && same(state, state_before()) && same(out, untouched_output());
  }
  const berm_parameters parameters = valid_parameters();
  const RequestBytes valid = sealed(valid_request());
};

// verifies: SK-RQ-1, SK-RQ-2, SK-RQ-9, SK-RQ-12, IF-CT-9, IF-CT-11 (that nothing changes)
TEST_F(RequestFlips, Single) {
  ASSERT_FALSE(refused(valid, BERM_REQUEST_CRC));
  for (int bit = 0; bit < kBits; ++bit) {
    RequestBytes raw = valid;
    flip(raw, bit);
    EXPECT_TRUE(refused(raw, refusal(bit))) << "bit " << bit;
  }
}

// verifies: SK-RQ-1, SK-RQ-2, SK-RQ-9, SK-RQ-12, IF-CT-8 (the kernel: bytes that are not whole), IF-CT-9
TEST_F(RequestFlips, Double) {
  for (int a = 0; a < kBits; ++a) {
    RequestBytes once = valid;
    flip(once, a);
    for (int b = a + 1; b < kBits; ++b) {
      RequestBytes raw = once;
      flip(raw, b);
      ASSERT_TRUE(refused(raw, refusal(a))) << "bits " << a << " and " << b;
    }
  }
}

}  // namespace
}  // namespace berm::core_test
