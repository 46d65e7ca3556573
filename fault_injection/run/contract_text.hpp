// Names of the contract's codes, as they stand in summaries, journals and JSON.
#pragma once

#include <string>

namespace berm::run {

std::string stop_reason_name(unsigned reason);    // "collision_predicted"
std::string kernel_state_name(unsigned state);    // "run"
std::string request_result_name(unsigned result); // "accepted"
std::string phase_name(unsigned phase);           // "dig"
std::string cell_status_name(unsigned status);    // "observed"

}  // namespace berm::run
