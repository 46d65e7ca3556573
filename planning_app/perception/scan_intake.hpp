// Takes new scan blocks out of the state segment's ring, each once, whole or not at all, processes them, and hands the points to who plans with them.
#pragma once

#include <cstdint>

#include "contract/berm_contract.h"
#include "perception/machine_history.hpp"
#include "perception/scanline_processor.hpp"
#include "perception/second_sweep.hpp"
#include "perception/truck_sweep.hpp"
#include "planning/bed_map.hpp"
#include "planning/terrain_map.hpp"

namespace berm::app {

class ScanIntake {
public:
  explicit ScanIntake(const MachineModel& machine) : processor_(machine) {}

  // Once a cycle. Returns that are not the machine's own go into terrain and bed (null: none is known): no lone ones, and those with several echoes
  // when a second sweep confirms them. Every processed part of a scanline goes into the sweep. A block that is newer than the machine's newest state
  // waits. Returns the number of points for the maps.
  int take(const berm_state_segment& segment, TerrainMap& terrain, BedMap* bed, TruckSweep& sweep);

  struct Counts {
    std::uint64_t blocks_missed = 0;   // overwritten before they were read
    std::uint64_t blocks_refused = 0;  // a field outside the contract's bounds, or a time that is not the machine's
    std::uint64_t returns = 0;         // not from the machine itself
    std::uint64_t flagged = 0, confirmed = 0;  // lone or with several echoes; of the latter, by a second sweep
  };
  const Counts& counts() const { return counts_; }
  const ProjectionCheck& check() const { return processor_.check(); }

private:
  void hand_on(const ScanlinePart& part, TerrainMap& terrain, BedMap* bed, int& points);

  MachineHistory history_;
  ScanlineProcessor processor_;
  SecondSweep second_sweep_;
  std::uint32_t next_ = 0;
  bool started_ = false;
  Counts counts_;
};

// Copies block n if it is complete and still n after the copy.
bool copy_scan_block(const berm_state_segment& segment, std::uint32_t n, berm_scan_block& out);

}  // namespace berm::app
