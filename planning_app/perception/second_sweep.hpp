// Whether a return with several echoes is believed: only where an earlier passage of a scanline found the same height. Dust drifts; ground and soil
// stay. Where the terrain map holds that height the first passage has been; otherwise the return waits here for the next. Metres, base frame;
// seconds.
#pragma once

#include <cstddef>
#include <vector>

#include "planning/terrain_map.hpp"

namespace berm::app {

class SecondSweep {
public:
  SecondSweep();

  // A return that is in doubt; true: it may go into the maps.
  bool confirms(const TerrainMap& terrain, double x, double y, double z, double time_s);

  static constexpr double same_height = 0.3;   // m: what a face of 56 degrees rises in a cell of the terrain map
  static constexpr double same_passage = 0.3;  // s, as in the terrain map
  static constexpr double longest_wait = 10.0; // s: in that time both scanners can see their whole range once

private:
  static constexpr int side = static_cast<int>(2.0 * TerrainMap::half_side / TerrainMap::cell);
  struct Waiting { float z = 0.0F; double time_s = -1.0; };
  std::vector<Waiting> waiting_;  // by cell: the first return in doubt of a passage
};

}  // namespace berm::app
