// How much memory kernel and app hold in the course of a run, from /proc.
#pragma once

#include <sys/types.h>

#include <optional>
#include <vector>

namespace berm::run {

struct MemorySample { double time_s, kernel_kib, app_kib; };

// Resident memory's slope over simulated time, least squares, after settling: of kernel and app together; none of a run too short to tell.
struct MemoryGrowth { std::optional<double> kib_per_hour, kernel_kib_per_hour, app_kib_per_hour; };

MemoryGrowth memory_growth(const std::vector<MemorySample>& samples);

class MemoryWatch {
 public:
  void watch(pid_t kernel, pid_t app);
  // Takes a sample when one is due.
  void sample(double time_s);
  MemoryGrowth growth() const { return memory_growth(samples_); }

 private:
  pid_t kernel_ = 0, app_ = 0;
  double next_s_ = 0.0;
  std::vector<MemorySample> samples_;
};

}  // namespace berm::run
