// Requests as the bytes an app writes.
#pragma once

#include <array>
#include <cstdint>

#include "contract/berm_contract.h"
#include "core/request_check.h"

namespace berm::core_test {

using RequestBytes = std::array<std::uint8_t, SK_REQUEST_BYTES>;

constexpr std::int64_t kNow = 5'000'000;

// A request that is acceptable at kNow: every field differs from zero and from its neighbours.
berm_request valid_request();
// With the right CRC.
RequestBytes sealed(berm_request request);
// A state whose last accepted request is the one before valid_request().
sk_request_state state_before();
// An output that no request decodes to.
sk_request untouched_output();
bool same(const sk_request& a, const sk_request& b);
bool same(const sk_request_state& a, const sk_request_state& b);

}  // namespace berm::core_test
