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

// Twice as many must come before the next time, so that each scan pays for a fixed number of looks.
void ScanTimes::forget_unnamed(const CloudStore& store) {
  std::vector<std::uint32_t> named;
  named.reserve(store.size());
  for (std::uint32_t index = 0; index < store.places(); ++index)
    if (store.used(index)) named.push_back(store[index].scan);
  std::sort(named.begin(), named.end());
  const auto unnamed = [&named](const auto& entry) { return !std::binary_search(named.begin(), named.end(), entry.first); };
  times_.erase(std::remove_if(times_.begin(), times_.end(), unnamed), times_.end());
  forget_at_ = std::max(kFewest, 2 * times_.size());
}

}  // namespace berm::app
