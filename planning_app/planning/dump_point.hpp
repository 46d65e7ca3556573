// Where the next bucket goes: the lowest part of the bed along its long axis, but no nearer to the end of the site's truck zone than a bucket needs.
#pragma once

#include "motion/machine_model.hpp"
#include "planning/bed_map.hpp"

namespace berm::app {

struct DumpPoint {
  double u = 0.0;        // along the bed, m from its centre
  double bearing = 0.0;  // swing angle
  double radius = 0.0;   // m from the swing axis
  bool observed = false; // from the bed map; else from the books
};

// since_s: how new a bed cell must be to count. Candidates stand in the middle of each third of the stretch that a bucket can fill.
DumpPoint choose_dump_point(const BedMap& bed, double bucket_half_width, double since_s);

}  // namespace berm::app
