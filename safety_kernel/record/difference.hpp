// Compares what a cycle gave with what the journal says it gave, field by field, and names the first difference.
#pragma once

#include <optional>
#include <string>

#include "io/cycle.hpp"
#include "record/cycle_record.hpp"

namespace berm::record {

struct Difference {
  std::string field;  // "decision.commanded_urad_s[0]", "frame 3 out", "map row 17"
  std::string recorded, replayed;
};

// Nothing when everything is the same. The decision comes first, then frames, state, map row.
std::optional<Difference> first_difference(const RecordedOutputs& recorded, const kernel::CycleOutputs& replayed, const sk_height_map& map);

}  // namespace berm::record
