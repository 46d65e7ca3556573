// Ours: the whole certified check of each step, from the joints' intervals to the core's verdict.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "config/parameter_block.h"
#include "core/columns.h"
#include "geometry/swept_slices.hpp"
#include "motion.hpp"

namespace berm::bench {

class Certificate {
 public:
  Certificate(const berm_parameters& parameters, const std::vector<std::int32_t>& heights_mm);

  // What the map costs once a cycle, whatever is asked of it then.
  void prepare();
  // Of each step, how many of its slices are blocked. Every slice of every step is checked.
  void run(const sk_reach_box* boxes, int* blocked_slices_of_step);
  // Only the first of the three: the slices.
  void slices_only(const sk_reach_box* boxes);

  const kernel::SliceSet& slices_of(const sk_reach_box& box);

 private:
  kernel::ImplementShape shape_;
  sk_clearance_rules rules_{};
  std::unique_ptr<sk_height_map> map_;
  std::unique_ptr<sk_columns> columns_;
  std::unique_ptr<sk_choice> choice_;
  std::unique_ptr<kernel::SliceSet> slices_;
};

}  // namespace berm::bench
