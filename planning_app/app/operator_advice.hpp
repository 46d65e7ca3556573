// What the operator is told to do about what keeps the machine, in plain words: for each stop reason of the contract.
#pragma once

#include <cstdint>
#include <string>

namespace berm::app {

// One line. Nothing for BERM_STOP_NONE.
const char* operator_advice(std::uint8_t stop_reason);
// Of BERM_SIGHT_BLOCKED bits, for an advice: "left scanner, lidar 1".
std::string eye_names(std::uint32_t sight);

}  // namespace berm::app
