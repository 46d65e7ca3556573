#include "plant/machine/guard_receiver.hpp"

namespace berm::plant {

namespace {

constexpr double kSilence = 0.1;  // s

bool follows(std::uint8_t counter, std::uint8_t last) {
  const auto ahead = static_cast<std::uint8_t>(counter - last);
  return ahead >= 1 && ahead <= 3;
}

}  // namespace

bool GuardReceiver::accept(const berm_can_frame& frame, double t) {
  if (frame.id == guard_id_) {
    berm_guard guard;
    armed_ = berm_decode_guard(&frame, &guard) && guard.data_id == BERM_CAN_DATA_ID(can_id_);
    if (armed_) guard_ = guard;
    return false;
  }
  if (frame.id != can_id_) return false;
  const bool guarded = armed_ && frame.length == 8 && berm_can_guard_crc(frame.id, guard_.counter, frame.data) == guard_.crc32;
  armed_ = false;
  if (!guarded) {
    ++refused_;
    return false;
  }
  const bool resumed = has_candidate_ && t - accepted_at_ > kSilence && follows(guard_.counter, candidate_counter_);
  if (!primed_ || follows(guard_.counter, accepted_counter_) || resumed) {
    primed_ = true;
    has_candidate_ = false;
    accepted_counter_ = guard_.counter;
    accepted_at_ = t;
    return true;
  }
  has_candidate_ = true;
  candidate_counter_ = guard_.counter;
  ++refused_;
  return false;
}

}  // namespace berm::plant
