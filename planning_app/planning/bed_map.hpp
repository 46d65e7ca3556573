// The soil in the truck's bed: 0.15 m cells from scan points, and the bookkeeping of dumps for what the walls hide.
#pragma once

#include <vector>

#include "planning/skyline.hpp"

namespace berm::app {

class BedMap {
public:
  static constexpr double cell = 0.15;

  explicit BedMap(const TruckBed& bed);

  // Points outside the inside of the bed, a hand's breadth from the walls, are ignored.
  void insert(double x, double y, double z, double time_s);
  // A dump of this many kilograms around u along the bed.
  void note_dump(double u, double mass_kg);

  // Share of cells seen since the time.
  double seen_share(double since_s) const;
  // Mean height above the bed's floor of a stretch of the bed; hidden cells count as the mean of those that were seen (stentz-1999, 4.3).
  double mean_height(double u_low, double u_high, double since_s) const;
  // Mass dumped into the stretch by the books; a dump is spread evenly over its spread.
  double noted_mass(double u_low, double u_high) const;

  const TruckBed& bed() const { return bed_; }

  static constexpr double dump_spread = 1.6;  // m along the bed

private:
  struct Dump { double u = 0.0, mass = 0.0; };

  TruckBed bed_;
  int columns_ = 0, rows_ = 0;
  std::vector<double> height_, time_;
  std::vector<Dump> dumps_;
};

}  // namespace berm::app
