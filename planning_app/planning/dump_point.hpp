// Where the next bucket goes: template-based dump planning (stentz-1999, 4.3), held to what the axles bear.
//
// The bed map is smoothed, what the walls hide is filled with the mean (as the books raise or lower it), and three templates are convolved over all of it. A cell's price is in metres of
// height, and the cheapest cell is dumped on:
//   constant elevation   the mean height under the bucket: the lowest part of the load is filled first;
//   hole                 less by half the hole's depth: a dip that the mean does not show is worth filling;
//   slope                more by a tenth of the rise: what falls on a slope does not stay there.
// The bucket may not come over every cell (walls, the end of the site's truck zone, its own reach). Soil for a cell beyond is poured as near to it as it may
// and has to run there down a slope, so such a cell's price is higher by a share of its distance.
// Balance: from the load's centre as books and sight have it, a dump may only be where what is still to come can bring the whole load's centre to the
// bed's middle, also if this bucket comes as full as it may; what it would miss by is added to the price, manyfold.
// Height: of the cells so ordered the first is taken where the heap, poured and slid to rest at the density and slope that this load was weighed and seen to have,
// stays well under the truck zone's ceiling; where it does nowhere, the one where it stays lowest. By the books alone that is not asked.
#pragma once

#include <limits>
#include <optional>

#include "motion/implement_scale.hpp"
#include "planning/bed_map.hpp"
#include "planning/over_walls.hpp"

namespace berm::app {

struct DumpNeeds {
  double bucket_half_width = 0.0;  // m
  double since_s = 0.0;            // how new a bed cell must be to count
  double dump_kg = 0.0;            // in the bucket, as planned
  double most_kg = std::numeric_limits<double>::infinity();  // what may be in it at most
  double rest_kg = 0.0;            // of the passes after it
  double farthest_radius = std::numeric_limits<double>::infinity();  // of a dump point from the swing axis, m
  ImplementScale scale;
  bool may_be_part = false;        // of the bucket only a part may be poured
  double dig_beyond = 0.0;         // rad: by how much the bucket swings farther to the truck than from the middle of the digs, in the sense of the swing
};

struct DumpPoint {
  BedPoint at;                     // m from the bed's centre
  double bearing = 0.0;            // swing angle
  double radius = 0.0;             // m from the swing axis
  bool observed = false;           // from the bed map; else from the books
  double seen_share = 0.0;         // of the bed map's cells
  double height = 0.0;             // mean height of the load there, m over the floor
  bool fits = true;                // the heap stays under the truck zone's ceiling ...
  double heap_top = std::numeric_limits<double>::quiet_NaN();  // ... to which it then stands, m over the floor; where that was in question
  BedPoint load_centre;            // of the whole load with this dump
  std::optional<OverWalls> over_walls;  // of the load before it, where that was observed: what is hidden by the books and by what is seen near it
};

DumpPoint choose_dump_point(const BedMap& bed, const DumpNeeds& needs);

// Where the middle of a bucket of this much falls that is poured at a point: a heaped one begins to pour when it has hardly tilted, its lip still towards
// the machine; a small load slides only when the lip has passed the point.
BedPoint landing(const TruckBed& bed, const BedPoint& at, double kg, const ImplementScale& scale = {});

// Where a dump point may be along the bed, and across it at its middle.
BedArea dump_area(const TruckBed& bed, double bucket_half_width, const ImplementScale& scale = {});

}  // namespace berm::app
