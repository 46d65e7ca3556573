// What of a dump falls over the bed's walls: late in a truck the heap stands at its slope from wall to wall, and what is poured on it slides over them.
#pragma once

#include <optional>
#include <utility>

#include "motion/implement_scale.hpp"
#include "planning/bed_grid.hpp"
#include "planning/load_balance.hpp"

namespace berm::app {

class OverWalls {
public:
  // heights: of the load, m over the floor, all known; wall: of its walls, m over the floor; density: of the load, kg/m3.
  OverWalls(BedGrid heights, double wall, double density, const ImplementScale& scale) : heights_(std::move(heights)), wall_(wall), density_(density), scale_(scale) {}

  // kg, of a dump of so many about the point. It is laid as far across as a pour reaches, and slides at the books' slope. How near that comes: PASSES_TRIED.md.
  double falls(const BedPoint& at, double kg);

private:
  double leaves(BedGrid grid) const;

  BedGrid heights_;
  double wall_, density_;
  ImplementScale scale_;
  std::optional<double> without_;  // what leaves without a dump
};

}  // namespace berm::app
