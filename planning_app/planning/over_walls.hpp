// What of a dump falls over the bed's walls: late in a truck the heap stands at its slope from wall to wall, and what is poured on it slides over them.
#pragma once

#include "motion/implement_scale.hpp"
#include "planning/bed_grid.hpp"
#include "planning/load_balance.hpp"

namespace berm::app {

// kg, of a dump of so many about the point on heights (m over the floor, all known), with walls that stand so high over the floor, m. It is laid as far across
// as a pour reaches, and slides at the books' slope. In six simulated trucks forecasts came to seven tenths of what fell, 32 kg too much at most (PASSES_TRIED.md).
double falls_over_walls(const BedGrid& heights, double wall, const BedPoint& at, double kg, double density, const ImplementScale& scale);

}  // namespace berm::app
