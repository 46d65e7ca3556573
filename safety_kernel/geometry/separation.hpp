// Search for planes that separate a slice from the map's columns. The core checks what is found here; a plane that is missed costs
// a needless stop and nothing else. All tests are exact, in integers; only which candidate is tried first is decided in floating point.
#ifndef BERM_KERNEL_GEOMETRY_SEPARATION_HPP
#define BERM_KERNEL_GEOMETRY_SEPARATION_HPP

#include "core/clearance.h"
#include "core/columns.h"
#include "geometry/slice_planes.hpp"

namespace berm::kernel {

// Writes choice.plane_of for every cell of the slice's bounding rectangle (0 where none separates, or where the level plane does; other cells are left
// alone), and adds to the slice those of the candidates that are needed. The planes that the slice has are tried first.
// columns: of this map and these rules. Returns whether every cell has a plane or needs none. Where not, the search has ended at the first such cell, row by row, and the core
// blocks there; the cells after it have 0. False with nothing written where the slice leaves the map or is malformed.
bool choose_planes(const sk_height_map& map, const sk_columns& columns, const sk_clearance_rules& rules, const PlaneCandidates& candidates, sk_slice& slice,
                   sk_choice& choice) noexcept;

// The same for slice i of a set, with its own candidates.
bool choose_planes(const sk_height_map& map, const sk_columns& columns, const sk_clearance_rules& rules, SliceSet& set, int i, sk_choice& choice) noexcept;

// Whether slice i of the set is clear: by its height alone, or by the planes that are found. What the core says of it; the search only claims. columns: of
// this map and these rules (sk_columns_of).
sk_clearance_result clear_slice(const sk_height_map& map, const sk_columns& columns, const sk_clearance_rules& rules, SliceSet& set, int i, sk_choice& choice) noexcept;

} // namespace berm::kernel
#endif
