// Takes new scan blocks out of the state segment's ring, each once, whole or not at all.
#pragma once

#include <cstdint>

#include "contract/berm_contract.h"
#include "perception/truck_sweep.hpp"
#include "planning/bed_map.hpp"
#include "planning/terrain_map.hpp"

namespace berm::app {

class ScanIntake {
public:
  // Points that the kernel took into its map go into terrain and bed (null: none is known), whole blocks into the sweep. Returns the number of points.
  int take(const berm_state_segment& segment, TerrainMap& terrain, BedMap* bed, TruckSweep& sweep);
  std::uint64_t blocks_missed() const { return missed_; }

private:
  std::uint32_t next_ = 0;
  bool started_ = false;
  std::uint64_t missed_ = 0;  // overwritten before they were read
};

// Copies block n if it is complete and still n after the copy.
bool copy_scan_block(const berm_state_segment& segment, std::uint32_t n, berm_scan_block& out);

}  // namespace berm::app
