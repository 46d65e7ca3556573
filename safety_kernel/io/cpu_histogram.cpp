#include "io/cpu_histogram.hpp"

#include <cmath>

namespace berm::kernel {

void CpuHistogram::add(std::int64_t us) {
  const std::int64_t bin = us < 0 ? 0 : us >= kBins ? kBins - 1 : us;
  ++bin_[bin];
  ++count_;
  if (us > max_us_) max_us_ = us;
}

std::int64_t CpuHistogram::quantile_us(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    seen += bin_[bin];
    if (seen > 0 && seen >= wanted) return bin == kBins - 1 ? max_us_ : bin;
  }
  return 0;
}

}  // namespace berm::kernel
