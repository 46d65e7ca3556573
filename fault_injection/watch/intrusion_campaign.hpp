// Many drawn intrusions. Those that share a preparation go on from it, each in a copy of the process that made it.
#pragma once

#include <functional>

#include "watch/bench.hpp"
#include "watch/intrusion_report.hpp"

namespace berm::watch {

// Runs trials 0 to count - 1 of the campaign's seed, so many processes at a time (0: one for each core), and puts those that are over into it, in
// order of their numbers. done(result) follows each. Whatever the number of processes, the results are the same. Once stop says
// so those under way are given up.
void run_campaign(const Bench& bench, int count, int jobs, Campaign& campaign, const std::function<void(const IntrusionResult&)>& done,
                  const std::function<bool()>& stop = {});

}  // namespace berm::watch
