// A trial's result as a line, from the process that ran it to the one that gathers.
#pragma once

#include <functional>
#include <string>

#include "watch/intrusion_run.hpp"

namespace berm::watch {

std::string line_of(const IntrusionResult& result);
// drawn: the intrusion of a trial's number, which the line does not hold.
IntrusionResult result_of(const std::string& line, const std::function<Intrusion(int run)>& drawn);

}  // namespace berm::watch
