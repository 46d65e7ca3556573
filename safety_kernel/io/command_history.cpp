#include "io/command_history.hpp"

#include <algorithm>

namespace berm::kernel {

void CommandHistory::push(std::int64_t sent_us, const std::int32_t (&velocity_urad_s)[4]) {
  newest_ = (newest_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
  ring_[newest_].sent_us = sent_us;
  std::copy(velocity_urad_s, velocity_urad_s + 4, ring_[newest_].velocity_urad_s);
}

void CommandHistory::range(std::int64_t now_us, std::int32_t (&low_urad_s)[4], std::int32_t (&high_urad_s)[4]) const {
  std::fill(low_urad_s, low_urad_s + 4, 0);
  std::fill(high_urad_s, high_urad_s + 4, 0);
  for (int back = 0; back < count_; ++back) {
    const Command& command = ring_[(newest_ + kCapacity - back) % kCapacity];
    for (int j = 0; j < 4; ++j) {
      const std::int32_t v = command.velocity_urad_s[j];
      low_urad_s[j] = back == 0 ? v : std::min(low_urad_s[j], v);
      high_urad_s[j] = back == 0 ? v : std::max(high_urad_s[j], v);
    }
    // This one was obeyed before the window began and may have been in force in its first part; those before it were not.
    if (command.sent_us + window_us_ <= now_us) return;
  }
}

}  // namespace berm::kernel
