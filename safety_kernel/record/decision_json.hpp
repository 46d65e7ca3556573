// A decision as JSON, and the JSON schemas of the journal's channels, for tools that show such files.
#pragma once

#include <cstdint>
#include <string>

#include "contract/berm_contract.h"

namespace berm::record {

std::string decision_json(const berm_decision& decision);
std::string decision_schema();
// before_cycle: the first cycle after the gap.
std::string lost_json(std::uint64_t lost, std::uint64_t before_cycle);
std::string lost_schema();

}  // namespace berm::record
