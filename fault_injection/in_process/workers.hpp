// Independent trials over the cores of this computer.
#pragma once

#include <functional>

namespace berm::in_process {

// Runs do_one(i) for every i below count on that many threads (0: one for each core). done(finished, i) follows each, one at a time. What a
// trial throws ends the rest and is thrown here.
void run_trials(int count, int jobs, const std::function<void(int)>& do_one, const std::function<void(int, int)>& done);

}  // namespace berm::in_process
