// How large a machine's implements are beside those of the machine on which the lengths of digs, passes and dumps were tried out. What follows the
// implements' size is written for that one, and multiplied by this.
#pragma once

#include <algorithm>

#include "motion/machine_model.hpp"

namespace berm::app {

struct ImplementScale {
  double arm = 1.0;     // boom and stick together
  double bucket = 1.0;  // pin to tip
  double width = 1.0;   // of the bucket, with the room that its prism has
  double load = 1.0;    // what the bucket holds
};

inline ImplementScale scale_of(const MachineModel& machine) {
  // 20 t class (interface_spec/config/machines/zx200.toml), m and kg.
  constexpr double boom_length = 5.648, stick_length = 2.889, bucket_length = 1.562, bucket_half_width = 0.60, payload_kg = 1600.0;
  double half_width = 0.0;
  for (const Prism& part : machine.parts)
    if (part.link == bucket) half_width = std::max(half_width, part.half_width);
  return {(machine.boom_length + machine.stick_length) / (boom_length + stick_length), machine.bucket_length / bucket_length, half_width / bucket_half_width,
          machine.bucket_payload_kg / payload_kg};
}

}  // namespace berm::app
