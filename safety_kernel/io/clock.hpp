// Time: the monotonic clock in microseconds, the cycle's absolute timer, the thread's CPU time.
#pragma once

#include <cstdint>

#include "can/berm_can.h"

namespace berm::kernel {

std::int64_t monotonic_us();
std::int64_t thread_cpu_us();

// Wakes at a fixed period. A cycle that starts late does not shift the ones after it; cycles that fell out altogether are left out.
class CycleTimer {
 public:
  CycleTimer(std::int64_t start_us, std::int32_t period_us) : due_us_(start_us), period_us_(period_us) {}
  // Sleeps until the next due time and returns the time then; interrupted sleeps return early (the caller looks at its stop flag).
  std::int64_t wait();

 private:
  std::int64_t due_us_;
  std::int32_t period_us_;
};

// Judges the distance between the starts of consecutive cycles. After the longest the machine has braked by itself, and is not to go on unasked.
constexpr std::int64_t kCycleLateUs = 20000;
constexpr std::int64_t kCycleFaultUs = BERM_CAN_SILENCE_US;

class CycleWatch {
 public:
  // Returns true when time ran backwards or the cycle came so late that it is a fault (BERM_STOP_CLOCK).
  bool check(std::int64_t now_us);
  std::uint64_t lost_cycles() const { return lost_cycles_; }
  // Whether what the cycle that began last has decided may still be sent, now; counts when not. The box has no more than that (SK-CY-28).
  bool may_send(std::int64_t now_us);
  std::uint64_t unsent_cycles() const { return unsent_cycles_; }

 private:
  std::int64_t previous_us_ = -1;
  std::uint64_t lost_cycles_ = 0, unsent_cycles_ = 0;
};

}  // namespace berm::kernel
