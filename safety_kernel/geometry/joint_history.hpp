// The newest measured joint positions, for the position at the time of a scan sample.
#ifndef BERM_KERNEL_GEOMETRY_JOINT_HISTORY_HPP
#define BERM_KERNEL_GEOMETRY_JOINT_HISTORY_HPP

#include "geometry/kinematics.hpp"

namespace berm::kernel {

class JointHistory {
public:
  static constexpr int capacity = 64;

  struct Result {
    JointAngles angles;
    bool inside = false; // the time lies between the oldest and the newest state; else the nearer of them is given
  };

  // time_us: when the angles were true. False, and nothing kept, where it is not later than the newest.
  bool push(int64_t time_us, const int32_t (&angle_urad)[4]) noexcept;

  // Linear between the two states around the time; the swing the short way round. Empty: zero angles, not inside.
  Result at(int64_t time_us) const noexcept;

  int size() const noexcept { return size_; }
  void clear() noexcept { size_ = 0; }

private:
  struct State {
    int64_t time_us;
    JointAngles angles;
  };
  const State& oldest_plus(int i) const noexcept { return state_[(first_ + i) % capacity]; }

  State state_[capacity];
  int first_ = 0, size_ = 0;
};

} // namespace berm::kernel
#endif
