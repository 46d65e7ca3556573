// Reach boxes over all that a machine can do: any position of its joints, any speed and command, any width.
#ifndef BERM_TESTS_GEOMETRY_REACH_BOXES_HPP
#define BERM_TESTS_GEOMETRY_REACH_BOXES_HPP

#include <random>
#include <string>
#include <vector>

#include "config/parameter_block.h"
#include "core/reach_box.h"

namespace berm::kernel::test {

struct CompiledMachine {
  std::string name;
  berm_parameters parameters; // whole, with the braking table: by the project's compiler of machine files
};
std::vector<CompiledMachine> compiled_machines();

// Which braking row the box came from, and the box; row is -1 where the core bounds no box (reach beyond the braking table).
struct BoundedBox {
  int32_t row;
  sk_reach_box box;
};
// Of a joint position, at these speeds and with these commands under way, as the kernel makes it.
BoundedBox box_of(const berm_parameters& parameters, const int32_t (&angle_urad)[4], const int32_t (&velocity_urad_s)[4], const int32_t (&command_urad_s)[4]);

// At a random position over the whole range, with speeds and commands up to share of the greatest. Drawn again until the core bounds it.
BoundedBox box_at_speed(const berm_parameters& parameters, double share, std::mt19937_64& random);

// Widths from nothing to the joint's whole range, small ones as likely as large; the largest now and then.
sk_reach_box box_of_any_width(const berm_parameters& parameters, std::mt19937_64& random);

} // namespace berm::kernel::test
#endif
