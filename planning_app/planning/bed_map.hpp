// The soil in the truck's bed: 0.15 m cells from scan points, and the bookkeeping of dumps for what the walls hide.
#pragma once

#include <vector>

#include "motion/implement_scale.hpp"
#include "planning/bed_grid.hpp"
#include "planning/load_balance.hpp"

namespace berm::app {

class BedMap {
public:
  explicit BedMap(const TruckBed& bed, const ImplementScale& scale = {});

  // Points outside the inside of the bed, a hand's breadth from the walls, are ignored.
  void insert(double x, double y, double z, double time_s);
  // A dump of this many kilograms about the point.
  void note_dump(const BedPoint& at, double mass_kg);

  // What was seen since the time; the other cells are unknown.
  BedGrid seen(double since_s) const;
  // The load as the books have it: every dump falls evenly over what a bucket covers, and slides to rest.
  const BedGrid& noted() const { return noted_; }
  const LoadMoment& noted_load() const { return load_; }

  const TruckBed& bed() const { return bed_; }

  // What a dump covers about its point before it slides, m, by the bucket's scales: its width, and the way of its lip while it pours.
  static constexpr double dump_along = 1.1, dump_across = 1.4;
  static constexpr double loose_density = 1340.0;  // kg/m3
  static constexpr double repose = 0.65;           // rise over run at which loose soil rests

private:
  TruckBed bed_;
  ImplementScale scale_;
  BedGrid grid_, noted_;
  std::vector<double> time_;  // of each cell's height; negative: never seen
  LoadMoment load_;
};

}  // namespace berm::app
