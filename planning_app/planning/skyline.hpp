// The surroundings as the swinging implements meet them: for each bearing and distance from the swing axis the highest ground within the
// implements' width. Answers whether a reach preview is clear of it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "motion/reach_preview.hpp"
#include "planning/site_model.hpp"
#include "planning/terrain_map.hpp"

namespace berm::app {

// Height of the ground at a point of the plan; infinity where nothing may pass over it.
using Ground = std::function<double(double x, double y)>;

// The same of so many points at once: x, y, and where to put the heights.
using GroundRow = std::function<void(const double* x, const double* y, double* height, std::size_t points)>;

// The app's own terrain map; ground never observed counts as level with the machine.
Ground ground_of(const TerrainMap& terrain);

class Skyline {
public:
  // The truck's bed counts as high as its walls, whatever was seen. machine must outlive the skyline, ground need not.
  // OverHigh::refused: what stands higher than the site's limits may not be passed over at all, as the kernel has it, by the boom neither.
  enum class OverHigh { ignored, refused };
  // Height: called with a point's x and y, as Ground is; a hundred thousand times, so that a map's own type spares the call through one.
  template <class Height>
  Skyline(const MachineModel& machine, const SiteModel& site, const Height& ground, OverHigh over_high = OverHigh::ignored)
      : Skyline(machine, site, by_rows(ground), over_high, Rows{}) {}

  static constexpr double own_slack = 0.10;   // m beyond the kernel's margin: the kernel's slices are wider than the implements
  static constexpr double over_floor = 0.1;  // m: so far over a dig zone's floor contact is to be asked for at the lowest, ...
  static constexpr double scatter = 0.02;    // ... and asked for with so much more: where a bucket that comes down is foreseen wavers with the speeds as measured

  // Whether the implements stay clear, by the kernel's margin and a little more, of everything under the intervals. In the dig zone contact is
  // allowed while the swing is slow and the lower edge above the zone's floor.
  bool clear(const ReachIntervals& box) const { return !blocking(box); }
  bool clear(const Joints& angle, const Joints& velocity) const { return clear(preview(*machine_, angle, velocity)); }

  struct Blocking {
    enum class What { joint_range, own_body, ground, too_high } what = What::ground;
    double bearing = 0.0, distance = 0.0, height = 0.0;  // of the ground; height is infinite where it is unseen
    bool of_ground() const { return what == What::ground || what == What::too_high; }
    bool unseen() const { return of_ground() && std::isinf(height); }
    const char* name() const;  // as an operator reads it
  };
  // Ranges::left_to_guard: intervals that go beyond a joint's range block nothing, and do not hide what else they meet.
  enum class Ranges { kept, left_to_guard };
  std::optional<Blocking> blocking(const ReachIntervals& box, Ranges ranges = Ranges::kept, double slack = own_slack) const;
  // Whether it may not be passed over with the implements up either: ground that is too near below them is what a box meets first. Not of unseen ground.
  bool stands_too_high(const Blocking& blocking) const;

  // The highest ground within the implements' width, between two bearings (low to high) and two distances.
  double highest(double bearing_low, double bearing_high, double r_low, double r_high) const;
  double height(double bearing, int bin) const { return all_[slot(bearing, bin)]; }

private:
  struct Rows {};
  Skyline(const MachineModel& machine, const SiteModel& site, const GroundRow& ground, OverHigh over_high, Rows);
  template <class Height>
  static GroundRow by_rows(const Height& ground) {
    return [&ground](const double* x, const double* y, double* height, std::size_t points) {
      for (std::size_t i = 0; i < points; ++i) height[i] = ground(x[i], y[i]);
    };
  }
  static constexpr int bearings = 180;
  static std::size_t slot(double bearing, int bin);

  const MachineModel* machine_;
  double floor_ = 0.0;
  static constexpr int over_bearings = 360, cells_side = 100;
  bool may_pass(double bearing, int bin) const;
  bool passable(double r, double bearing, double half_width) const;

  std::vector<double> all_, outside_dig_zone_;
  double half_width_ = 0.0;               // of the implements
  std::vector<std::uint8_t> too_high_;    // by cell of the kernel's map: nothing may pass over it, however high; empty where that is not asked
  std::vector<std::uint8_t> no_passing_;  // the same by bearing and distance
};

// Whether a point of the plan lies in a dig zone.
bool in_dig_zone(const SiteModel& site, double x, double y);

// The parked truck: its bed with the walls, and at either end as far as a cab reaches. Behind its far side, where the walls hide the ground, the map has
// lines from their tops.
bool at_truck(const SiteModel& site, double x, double y);

// The height up to which the implements may pass over a point: of its cell of the kernel's map, by the site's file.
double pass_over_limit(const SiteModel& site, double x, double y);

// Bed coordinates: u along the long axis, v to its left, origin at the bed's centre.
struct BedPoint { double u = 0.0, v = 0.0; };
BedPoint to_bed(const TruckBed& bed, double x, double y);
void from_bed(const TruckBed& bed, const BedPoint& p, double& x, double& y);

}  // namespace berm::app
