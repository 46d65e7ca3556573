// Machine side of the guard frames: a guarded message is used only if its guard came just before it, with the right CRC and a counter
// 1..3 ahead of the last. A sender silent for 100 ms (or restarted) is taken up again once two of its messages follow on one another;
// while it is heard, no replayed pair can take its place.
#pragma once

#include <cstdint>

#include "can/berm_can.h"

namespace berm::plant {

class GuardReceiver {
 public:
  explicit GuardReceiver(std::uint32_t can_id) : can_id_(can_id), guard_id_(berm_can_guard_id(can_id)) {}

  // Every received frame. True when it is this receiver's message and may be used.
  bool accept(const berm_can_frame& frame, double t);
  std::uint64_t refused() const { return refused_; }

 private:
  std::uint32_t can_id_, guard_id_;
  bool armed_ = false, primed_ = false;
  berm_guard guard_{};
  std::uint8_t accepted_counter_ = 0;  // of the newest message used
  bool has_candidate_ = false;
  std::uint8_t candidate_counter_ = 0; // of the newest message whose CRC was right but whose counter was not
  double accepted_at_ = 0.0;
  std::uint64_t refused_ = 0;
};

// Guard frames for a sender: counts each message's guards.
class GuardSender {
 public:
  berm_can_frame guard_for(const berm_can_frame& frame) { return berm_can_make_guard(&frame, counter_++); }

 private:
  std::uint8_t counter_ = 0;
};

}  // namespace berm::plant
