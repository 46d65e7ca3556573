// CPU time of the cycle: a fixed histogram of 1 us bins up to 20 ms, so that recording allocates nothing.
#pragma once

#include <cstdint>

namespace berm::kernel {

class CpuHistogram {
 public:
  static constexpr int kBins = 20001;  // the last holds everything longer

  void add(std::int64_t us);
  std::uint64_t count() const { return count_; }
  std::int64_t max_us() const { return max_us_; }
  // Smallest time that at least this share of all cycles did not exceed; 0 without cycles.
  std::int64_t quantile_us(double share) const;

 private:
  std::uint32_t bin_[kBins] = {};
  std::uint64_t count_ = 0;
  std::int64_t max_us_ = 0;
};

}  // namespace berm::kernel
