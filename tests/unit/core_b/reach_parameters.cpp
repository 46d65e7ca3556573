#include "reach_parameters.hpp"

#include <cstring>

namespace berm::core_test {

berm_parameters reach_parameters() {
  berm_parameters p{};
  p.state_latency_us = 20'000;
  p.cycle_us = 10'000;
  p.command_latency_us = 70'000;
  for (int joint = 0; joint < SK_JOINTS; ++joint) {
    p.velocity_max_urad_s[joint] = 700'000;
    p.acceleration_max_urad_s2[joint] = 1'000'000;
    p.angle_error_urad[joint] = 1'000;
    p.velocity_error_urad_s[joint] = 2'000;
    for (int row = 0; row < BERM_BRAKE_REACHES; ++row)
      for (int column = 0; column < BERM_BRAKE_SPEEDS; ++column) p.brake_angle_urad[joint][row][column] = (row + 1) * column * 10'000 + joint;
  }
  for (int row = 0; row < BERM_BRAKE_REACHES; ++row) p.brake_reach_mm[row] = 3'000 * (row + 1);
  return p;
}

sk_reach_box untouched_box() {
  sk_reach_box box{};
  for (int joint = 0; joint < SK_JOINTS; ++joint) {
    box.low_urad[joint] = 0x11111111 + joint;
    box.high_urad[joint] = 0x22222222 + joint;
    box.speed_urad_s[joint] = 0x33333333 + joint;
  }
  return box;
}

bool same(const sk_reach_box& a, const sk_reach_box& b) {
  return std::memcmp(a.low_urad, b.low_urad, sizeof a.low_urad) == 0 && std::memcmp(a.high_urad, b.high_urad, sizeof a.high_urad) == 0 &&
         std::memcmp(a.speed_urad_s, b.speed_urad_s, sizeof a.speed_urad_s) == 0;
}

}  // namespace berm::core_test
