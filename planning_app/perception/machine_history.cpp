#include "perception/machine_history.hpp"

#include <cmath>
#include <cstring>

namespace berm::app {

void MachineHistory::take(const berm_state_segment& segment) {
  const std::uint32_t head = __atomic_load_n(&segment.decision_head, __ATOMIC_ACQUIRE);
  if (!started_ || head - next_ > capacity) next_ = head > capacity ? head - capacity : 0;
  started_ = true;
  berm_decision decision;
  for (; next_ != head; ++next_) {
    std::memcpy(&decision, &segment.decision[next_ % BERM_DECISION_RING], sizeof decision);
    __atomic_thread_fence(__ATOMIC_ACQUIRE);
    if (__atomic_load_n(&segment.decision_head, __ATOMIC_RELAXED) - next_ < BERM_DECISION_RING) push(decision);
  }
}

void MachineHistory::push(const berm_decision& decision) {
  constexpr std::int64_t latest_us = 1'000'000'000'000'000;  // 30 years: in ns it still fits
  if (decision.time_us < 0 || decision.time_us > latest_us) return;
  State next;
  next.time_ns = decision.time_us * 1000;
  for (std::size_t j = 0; j < joints; ++j) {
    next.urad[j] = decision.joint_angle_urad[j];
    next.angle[j] = decision.joint_angle_urad[j] * 1e-6;
  }
  if (size_ > 0) {
    const State& last = of(size_ - 1);
    if (next.time_ns <= last.time_ns) return;
    if (next.urad == last.urad && std::fabs(decision.joint_velocity_urad_s[swing] * 1e-6) > least_swing) return;
  }
  if (size_ == capacity) first_ = (first_ + 1) % capacity;
  else ++size_;
  state_[static_cast<std::size_t>((first_ + size_ - 1) % capacity)] = next;
}

std::optional<MachineHistory::Pose> MachineHistory::at(std::int64_t time_ns) const {
  if (size_ == 0 || time_ns > newest_ns() || time_ns < of(0).time_ns) return std::nullopt;
  int i = size_ - 1;  // blocks are about as new as the states: the search ends soon
  while (of(i).time_ns > time_ns) --i;
  const State& before = of(i);
  if (before.time_ns == time_ns) return Pose{before.angle, true};
  const State& after = of(i + 1);
  const std::int64_t span = after.time_ns - before.time_ns;
  const double share = static_cast<double>(time_ns - before.time_ns) / static_cast<double>(span);
  Pose pose;
  for (std::size_t j = 0; j < joints; ++j) {
    const double turned = after.angle[j] - before.angle[j];
    pose.angle[j] = before.angle[j] + share * (j == swing ? wrapped(turned) : turned);
  }
  pose.neighbours = span <= cycle_ns + cycle_ns / 2;
  return pose;
}

}  // namespace berm::app
