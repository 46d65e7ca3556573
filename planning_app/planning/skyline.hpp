// The surroundings as the swinging implements meet them: for each bearing and distance from the swing axis the highest ground within the
// implements' width. Answers whether a reach preview is clear of it.
#pragma once

#include <vector>

#include "motion/reach_preview.hpp"
#include "planning/site_model.hpp"
#include "planning/terrain_map.hpp"

namespace berm::app {

class Skyline {
public:
  // Ground never observed counts as level with the machine; the truck's bed as high as its walls, whatever was seen.
  Skyline(const MachineModel& machine, const SiteModel& site, const TerrainMap& terrain);

  // Whether the implements stay clear, by the kernel's margin and a little more, of everything under the intervals. In the dig zone contact is
  // allowed while the swing is slow and the lower edge above the zone's floor.
  bool clear(const ReachIntervals& box) const;
  bool clear(const Joints& angle, const Joints& velocity) const { return clear(preview(*machine_, angle, velocity)); }

  double height(double bearing, int bin) const { return all_[slot(bearing, bin)]; }

private:
  static constexpr int bearings = 180;
  static std::size_t slot(double bearing, int bin);

  const MachineModel* machine_;
  double floor_ = 0.0;
  std::vector<double> all_, outside_dig_zone_;
};

// Whether a point of the plan lies in a dig zone.
bool in_dig_zone(const SiteModel& site, double x, double y);

// Bed coordinates: u along the long axis, v to its left, origin at the bed's centre.
struct BedPoint { double u = 0.0, v = 0.0; };
BedPoint to_bed(const TruckBed& bed, double x, double y);
void from_bed(const TruckBed& bed, const BedPoint& p, double& x, double& y);

}  // namespace berm::app
