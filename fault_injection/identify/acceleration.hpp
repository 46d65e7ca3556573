// The largest acceleration in runs of the same test. A reading's noise, over so short a time, would look like acceleration; so the speeds of all runs
// of a test are averaged first, cycle by cycle from the command on.
#pragma once

#include <cstddef>
#include <vector>

namespace berm::identify {

using Speeds = std::vector<float>;  // rad/s, every 10 ms from the command on, positive in the commanded direction

// Cycle by cycle, as far as the shortest goes.
std::vector<double> mean_speeds(const std::vector<const Speeds*>& runs);

// The most speed gained in a window of so many cycles (4 or more), rad/s2: the steepest line through its readings; where the motion turns round in it,
// what it gained in the positive direction. How fast a motion the other way is braked does not count: windows that end below speed_error are left out.
double steepest(const std::vector<double>& speeds, std::size_t window, double speed_error);

}  // namespace berm::identify
