// From a record of the journal back to what a cycle was given and what it gave. Any bytes may come.
#pragma once

#include <cstdint>
#include <string>

#include "io/cycle.hpp"
#include "journal/journal_record.h"

namespace berm::record {

struct RecordedOutputs {
  std::uint64_t sequence = 0;
  std::uint64_t map_row_hash = 0;
  kernel::FrameList frames;
  berm_state state{};
  berm_decision decision{};
};

// False with what is wrong in error. What a kernel could not have been given (a scan field out of its range, more frames than a cycle takes) is
// refused, so that a forged record cannot drive the cycle out of its bounds.
bool decode_cycle(const std::uint8_t* bytes, std::size_t size, const kernel::Vlp16Mount& mount, kernel::CycleInputs& in, RecordedOutputs& out, std::string& error);

}  // namespace berm::record
