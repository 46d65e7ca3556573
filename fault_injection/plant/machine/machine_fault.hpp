// Faults of the machine itself, planted by the scenario.
#pragma once

#include <cstddef>
#include <optional>

namespace berm::plant {

enum class MachineFaultKind {
  weak_brake,   // the joint brakes at a share of its deceleration, power or not
  stuck_valve,  // the valve stays where it is when the joint is next driven: the joint goes on, whatever is commanded, until power is removed
  runaway,      // the joint is driven, whatever is commanded, until power is removed
  stuck_angle,  // the angle's sensor says what it said then; the joint, and its speed's sensor, are sound
  own_error,    // the machine's controller reports a system error; nothing else is wrong with it
};

struct MachineFault {
  MachineFaultKind kind;
  std::size_t joint;  // 0 swing, 1 boom, 2 stick, 3 bucket; not used by own_error
  double at_s;
  double factor;      // of the deceleration, or of velocity_max (signed); not used by what sticks
  std::optional<double> for_s{};  // repaired then; nullopt: never
};

}  // namespace berm::plant
