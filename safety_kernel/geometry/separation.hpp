// Search for planes that separate a slice from the map's columns. The core checks what is found here; a plane that is missed costs
// a needless stop and nothing else.
#ifndef BERM_KERNEL_GEOMETRY_SEPARATION_HPP
#define BERM_KERNEL_GEOMETRY_SEPARATION_HPP

#include "core/clearance.h"

namespace berm::kernel {

// Writes choice.plane_of for every cell of the slice's bounding rectangle (0 where none separates; other cells are left alone).
// Returns whether every cell has a plane or needs none. Where not, the search has ended at the first such cell, row by row, and the core
// blocks there; the cells after it have 0. False with nothing written where the slice leaves the map or is malformed.
bool choose_planes(const sk_height_map& map, const sk_slice& slice, const sk_clearance_rules& rules, sk_choice& choice) noexcept;

} // namespace berm::kernel
#endif
