#include "request_bytes.hpp"

#include <cstddef>
#include <cstring>

#include "core/crc32.h"

namespace berm::core_test {

berm_request valid_request() {
  berm_request r{};
  r.magic = BERM_CONTRACT_MAGIC;
  r.version = BERM_CONTRACT_VERSION;
  r.phase = BERM_PHASE_DUMP;
  r.sequence = 0x01020304u;
  r.flags = BERM_REQUEST_FLAG_HORN;
  r.stamp_us = kNow - 10'000;
  const std::int32_t velocity[4] = {123'456, -234'567, 345'678, -456'789};
  std::memcpy(r.joint_velocity_urad_s, velocity, sizeof velocity);
  r.pan_goal_urad[0] = 1'000'001;
  r.pan_goal_urad[1] = -1'100'003;
  r.pan_rate_urad_s[0] = 500'009;
  r.pan_rate_urad_s[1] = 600'011;
  return r;
}

RequestBytes sealed(berm_request request) {
  RequestBytes bytes{};
  std::memcpy(bytes.data(), &request, bytes.size());
  request.crc32 = sk_crc32(bytes.data(), SK_REQUEST_CRC_AT);
  std::memcpy(bytes.data(), &request, bytes.size());
  return bytes;
}

sk_request_state state_before() {
  sk_request_state s{};
  s.primed = true;
  s.last_sequence = valid_request().sequence - 1;
  s.last_accept_us = kNow - 10'000;
  return s;
}

sk_request untouched_output() {
  sk_request out{};
  out.phase = 0x5A5A;
  out.flags = 0xA5A5A5A5u;
  out.sequence = 0xDEADBEEFu;
  out.stamp_us = -77;
  for (std::int32_t& v : out.joint_velocity_urad_s) v = 0x11111111;
  for (std::int32_t& v : out.pan_goal_urad) v = 0x22222222;
  for (std::int32_t& v : out.pan_rate_urad_s) v = 0x33333333;
  return out;
}

bool same(const sk_request& a, const sk_request& b) {
  return a.phase == b.phase && a.flags == b.flags && a.sequence == b.sequence && a.stamp_us == b.stamp_us &&
         std::memcmp(a.joint_velocity_urad_s, b.joint_velocity_urad_s, sizeof a.joint_velocity_urad_s) == 0 &&
         std::memcmp(a.pan_goal_urad, b.pan_goal_urad, sizeof a.pan_goal_urad) == 0 &&
         std::memcmp(a.pan_rate_urad_s, b.pan_rate_urad_s, sizeof a.pan_rate_urad_s) == 0;
}

bool same(const sk_request_state& a, const sk_request_state& b) {
  return a.primed == b.primed && a.last_sequence == b.last_sequence && a.last_accept_us == b.last_accept_us;
}

}  // namespace berm::core_test
