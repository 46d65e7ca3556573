// The machine as its bus shows it, in lockstep with its clock frames: guarded velocity commands and heartbeats out, guarded state frames in.
// Times are those of the clock frames.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "can/can_transport.hpp"
#include "identify/machine_shape.hpp"

namespace berm::identify {

// Of one cycle of 10 ms.
struct Reading {
  double time_s = 0.0;
  Joints angle{}, velocity{};
};

enum class StopManner : std::size_t {
  zero_command,  // velocity zero, the heartbeat goes on
  category_1,    // heartbeat without enable, category 1
  category_0,    // heartbeat without enable, category 0
  silence,       // no valid frame any more
};
constexpr std::size_t kManners = 4;
extern const std::array<const char*, kManners> kMannerNames;

class MachineLink {
 public:
  // Throws std::runtime_error naming the address.
  explicit MachineLink(const std::string& address);

  // Waits at most this long for anything on the bus; true when there is something.
  bool heard(int milliseconds) const;
  // Asked ten times a second while nothing comes: what it throws ends the wait. Who waits for a machine that has gone would hear of it seconds later.
  void while_silent(std::function<void()> watch) { while_silent_ = std::move(watch); }
  // Waits for the machine's first cycle.
  Reading first();
  // Answers the newest reading with a velocity command, and gives the next. Throws std::runtime_error when the machine is silent or sends no valid
  // state.
  Reading drive(const Joints& velocity);
  Reading stop(StopManner manner);

  // Mean of the machine's own weighing so far, kg; none before the first.
  std::optional<double> weighed_kg() const;
  double largest_state_gap_s() const { return largest_gap_s_; }  // between two valid state frames

 private:
  Reading next();
  void take(const berm_can_frame& frame);
  bool guarded(const berm_can_frame& frame);
  void send_guarded(const berm_can_frame& frame, std::uint8_t& counter);
  // A heartbeat without its guard keeps the lockstep, and is none to the machine.
  void answer(const std::optional<Joints>& velocity, bool enable, std::uint8_t category, bool valid);

  std::string address_;
  std::function<void()> while_silent_;
  can::Transport bus_;
  std::uint32_t cycle_ = 0;
  std::uint8_t velocity_counter_ = 0, heartbeat_counter_ = 0, alive_ = 0;
  std::optional<berm_guard> guard_;
  std::array<std::optional<std::uint8_t>, 256> last_counter_{};  // by data id
  std::optional<Joints> angle_, velocity_;                       // of the cycle that arrives
  std::optional<double> last_state_s_;
  double largest_gap_s_ = 0.0;
  double weighed_sum_ = 0.0;
  long weighed_ = 0;
};

}  // namespace berm::identify
