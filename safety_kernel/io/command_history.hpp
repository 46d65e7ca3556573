// Velocity commands that may still be under way: sent, and not yet for certain replaced at the joint by a later one.
#pragma once

#include <cstdint>

namespace berm::kernel {

class CommandHistory {
 public:
  // window_us: command latency, state latency and one cycle.
  explicit CommandHistory(std::int32_t window_us) : window_us_(window_us) {}

  void push(std::int64_t sent_us, const std::int32_t (&velocity_urad_s)[4]);
  // Smallest and largest command of each joint under way at now_us, or sent since. Before the first command the machine is under none: zero.
  void range(std::int64_t now_us, std::int32_t (&low_urad_s)[4], std::int32_t (&high_urad_s)[4]) const;

 private:
  static constexpr int kCapacity = 2048;  // the longest window at the shortest cycle that the parameter check lets pass
  struct Command {
    std::int64_t sent_us;
    std::int32_t velocity_urad_s[4];
  };
  std::int32_t window_us_;
  Command ring_[kCapacity];
  int newest_ = -1;
  int count_ = 0;
};

}  // namespace berm::kernel
