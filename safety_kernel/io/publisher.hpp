// Writes the state segment. Readers only map it; nothing of theirs comes back. Each part has its sequence lock, as the contract says.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "contract/berm_contract.h"
#include "core/height_map.h"
#include "geometry/swept_slices.hpp"
#include "io/scan_intake.hpp"

namespace berm::kernel {

class Publisher {
 public:
  static constexpr int kMapRows = 8;  // refreshed a cycle

  // segment: zeroed memory of sizeof(berm_state_segment). own_body: whether cells under the machine are shown as such.
  Publisher(berm_state_segment& segment, const berm_parameters& parameters, bool own_body);

  void state(const berm_state& state);
  void decision(const berm_decision& decision);
  void scans(const ScanBlocks& blocks);
  void slices(const SliceSet& slices);
  void map_rows(const sk_height_map& map, std::int64_t now_us);
  // Last in a cycle: wakes everyone who waits for it.
  void wake();

 private:
  std::uint8_t status(const sk_height_map& map, int iy, int ix, std::int64_t now_us) const;

  berm_state_segment& segment_;
  const berm_parameters& parameters_;
  std::int64_t own_cells_radius_mm_;
  int next_row_ = 0;
};

}  // namespace berm::kernel
