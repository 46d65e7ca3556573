// Independent trials over the cores of this computer.
#pragma once

#include <functional>

namespace berm::in_process {

// Runs do_one(i) for every i below count on that many threads (0: one for each core). done(finished, i) follows each, one at a time. What a
// trial throws ends the rest and is thrown here. Once stop says so no trial is begun; those that are begun end, so that the ones done are always the
// first. Gives how many.
int run_trials(int count, int jobs, const std::function<void(int)>& do_one, const std::function<void(int, int)>& done, const std::function<bool()>& stop = {});

}  // namespace berm::in_process
