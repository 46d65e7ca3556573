// When each scan was taken, of the scans that some point still names: what a shift of any length needs stays bounded by the points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "gathering/cloud_store.hpp"

namespace berm::app {

class ScanTimes {
public:
  // A scan more, numbered from 0. Now and then those that no point of the store names are forgotten.
  void begin_scan(double time_s, const CloudStore& store);
  std::uint32_t newest() const { return next_ - 1; }
  // Of a scan that a point names, or of the newest.
  double of(std::uint32_t scan) const;
  std::size_t bytes() const { return times_.capacity() * sizeof(times_[0]); }

private:
  void forget_unnamed(const CloudStore& store);

  static constexpr std::size_t kFewest = 4096;
  std::vector<std::pair<std::uint32_t, double>> times_;  // in rising number
  std::size_t forget_at_ = kFewest;
  std::uint32_t next_ = 0;
};

}  // namespace berm::app
