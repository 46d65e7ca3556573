// Goes through a run's journal from its begin to its end. Both throw std::runtime_error with one line when the file is damaged or incomplete.
#pragma once

#include <functional>
#include <string>

#include "contract/berm_contract.h"
#include "io/cycle.hpp"

namespace berm::watch {

// Every decision as it was recorded.
void walk_decisions(const std::string& path, const std::function<void(const berm_decision&)>& visit);
// Feeds every cycle's inputs to a fresh kernel, so that its own state can be looked at, and refuses the first decision that is not the recorded one.
void walk_replayed(const std::string& path, const std::function<void(const kernel::Cycle&, const kernel::CycleOutputs&)>& visit);

}  // namespace berm::watch
