// The machine with lidars all round, on a site where all round it is watched; one height of a cell is compared with, unless a test says otherwise.
#pragma once

#include "config/compile_parameters.hpp"

namespace berm::kernel::test {

inline berm_parameters watched_ring() {
  berm_parameters p = config::compile_parameters(config::load_machine_file(BERM_CONFIG_FILES "/machines/zx200_ring.toml"),
                                                 config::load_site_file(BERM_CONFIG_FILES "/sites/bench.toml"));
  p.dig_zones = 1;
  p.dig_zone[0] = {14000, 14000, 14500, 14500, -1000, 1000};  // out of the way: all is watched
  p.workspace_histogram = 0;
  p.ground_zones = p.truck_zones = p.lanes = 0;
  return p;
}

}  // namespace berm::kernel::test
