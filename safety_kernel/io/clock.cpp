#include "io/clock.hpp"

#include <time.h>

namespace berm::kernel {

namespace {

std::int64_t read_us(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1000000 + t.tv_nsec / 1000;
}

}  // namespace

std::int64_t monotonic_us() { return read_us(CLOCK_MONOTONIC); }

std::int64_t thread_cpu_us() { return read_us(CLOCK_THREAD_CPUTIME_ID); }

std::int64_t CycleTimer::wait() {
  due_us_ += period_us_;
  const std::int64_t before = monotonic_us();
  if (before > due_us_ + period_us_) due_us_ += (before - due_us_) / period_us_ * period_us_;
  timespec until{};
  until.tv_sec = due_us_ / 1000000;
  until.tv_nsec = due_us_ % 1000000 * 1000;
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  return monotonic_us();
}

bool CycleWatch::check(std::int64_t now_us) {
  const std::int64_t gap_us = now_us - previous_us_;
  const bool first = previous_us_ < 0;
  previous_us_ = now_us;
  if (first) return false;
  if (gap_us > kCycleLateUs) ++lost_cycles_;
  return gap_us <= 0 || gap_us > kCycleFaultUs;
}

bool CycleWatch::may_send(std::int64_t now_us) {
  const bool in_time = now_us >= previous_us_ && now_us - previous_us_ <= BERM_CAN_SEND_LATE_US;
  if (!in_time) ++unsent_cycles_;
  return in_time;
}

}  // namespace berm::kernel
