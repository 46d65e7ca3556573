// Where the joints were at the time of a scan sample: the machine's states of the last cycles, as the kernel publishes them with its decisions (the
// "position system" of stentz-1999, Figure 5). Radians; time in ns of the kernel's clock.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "contract/berm_contract.h"
#include "motion/angles.hpp"

namespace berm::app {

class MachineHistory {
public:
  static constexpr int capacity = 64;  // states: as many blocks are in the scan ring, two a cycle

  // New decisions out of the ring, each once, also of cycles that the app slept through.
  void take(const berm_state_segment& segment);
  // Left out where the time does not rise, or where not one angle has changed although the swing moves: no new angles have come in that cycle.
  void push(const berm_decision& decision);

  struct Pose {
    Joints angle{};
    bool neighbours = false;  // between states of neighbouring cycles: none is missing here
  };
  // Linear between the states before and after, the swing the short way round. Nothing before the oldest and after the newest.
  std::optional<Pose> at(std::int64_t time_ns) const;
  std::int64_t newest_ns() const { return size_ == 0 ? -1 : of(size_ - 1).time_ns; }

  static constexpr double least_swing = 0.01;  // rad/s: what moves slower may show the same angles twice
  static constexpr std::int64_t cycle_ns = 10'000'000;

private:
  struct State {
    std::int64_t time_ns = 0;
    std::array<std::int32_t, joints> urad{};
    Joints angle{};
  };
  const State& of(int i) const { return state_[static_cast<std::size_t>((first_ + i) % capacity)]; }  // 0: the oldest

  std::array<State, capacity> state_;
  int first_ = 0, size_ = 0;
  bool started_ = false;
  std::uint32_t next_ = 0;
};

}  // namespace berm::app
