#include "geometry/joint_history.hpp"

#include <cmath>

namespace berm::kernel {
namespace {

constexpr double two_pi = 6.283185307179586;

double between(double a, double b, double fraction) noexcept { return a + fraction * (b - a); }

} // namespace

bool JointHistory::push(int64_t time_us, const int32_t (&angle_urad)[4]) noexcept {
  if (size_ > 0 && time_us <= oldest_plus(size_ - 1).time_us) return false;
  if (size_ == capacity) {
    first_ = (first_ + 1) % capacity;
    --size_;
  }
  state_[(first_ + size_) % capacity] = {time_us, joint_angles(angle_urad)};
  ++size_;
  return true;
}

JointHistory::Result JointHistory::at(int64_t time_us) const noexcept {
  if (size_ == 0) return {};
  const State& newest = oldest_plus(size_ - 1);
  if (time_us >= newest.time_us) return {newest.angles, time_us == newest.time_us};
  const State& oldest = oldest_plus(0);
  if (time_us < oldest.time_us) return {oldest.angles, false};
  int i = size_ - 2; // scans are about as new as the states: the search ends soon
  while (oldest_plus(i).time_us > time_us) --i;
  const State &a = oldest_plus(i), &b = oldest_plus(i + 1);
  const double fraction = static_cast<double>(time_us - a.time_us) / static_cast<double>(b.time_us - a.time_us);
  JointAngles out;
  out.swing = a.angles.swing + fraction * std::remainder(b.angles.swing - a.angles.swing, two_pi);
  out.boom = between(a.angles.boom, b.angles.boom, fraction);
  out.stick = between(a.angles.stick, b.angles.stick, fraction);
  out.bucket = between(a.angles.bucket, b.angles.bucket, fraction);
  return {out, true};
}

} // namespace berm::kernel
