#include "gathering/scan_times.hpp"

#include <algorithm>

namespace berm::app {

void ScanTimes::begin_scan(double time_s, const CloudStore& store) {
  if (times_.size() >= forget_at_) forget_unnamed(store);
  times_.emplace_back(next_++, time_s);
}

double ScanTimes::of(std::uint32_t scan) const {
  return std::lower_bound(times_.begin(), times_.end(), scan, [](const auto& entry, std::uint32_t number) { return entry.first < number; })->second;
}

// One look at each point, and twice as many scans must come before the next time.
void ScanTimes::forget_unnamed(const CloudStore& store) {
  const std::uint32_t first = times_.front().first;
  std::vector<bool> named(next_ - first);
  for (std::uint32_t index = 0; index < store.places(); ++index)
    if (store.used(index)) named[store[index].scan - first] = true;
  const auto unnamed = [&named, first](const auto& entry) { return !named[entry.first - first]; };
  times_.erase(std::remove_if(times_.begin(), times_.end(), unnamed), times_.end());
  forget_at_ = std::max(kFewest, 2 * times_.size());
}

}  // namespace berm::app
