#include "run/memory_watch.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <string>

namespace berm::run {

namespace {

constexpr double kEvery_s = 10.0;
constexpr double kSettled_s = 300.0;      // the first truck: buffers grow to what they need
constexpr std::size_t kFewest = 12;

// Of VmRSS; none when the process is gone.
std::optional<double> resident_kib(pid_t process) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  for (std::string word; status >> word;) {
    double kib = 0.0;
    if (word == "VmRSS:" && status >> kib) return kib;
  }
  return std::nullopt;
}

template <typename Value>
double slope_per_hour(const std::vector<MemorySample>& samples, Value value) {
  double n = 0, t = 0, v = 0, tt = 0, tv = 0;
  for (const MemorySample& s : samples) {
    if (s.time_s < kSettled_s) continue;
    const double hours = s.time_s / 3600;
    n += 1, t += hours, v += value(s), tt += hours * hours, tv += hours * value(s);
  }
  return (n * tv - t * v) / (n * tt - t * t);
}

}  // namespace

MemoryGrowth memory_growth(const std::vector<MemorySample>& samples) {
  std::size_t settled = 0;
  for (const MemorySample& s : samples) settled += s.time_s >= kSettled_s ? 1 : 0;
  if (settled < kFewest) return {};
  const double kernel = slope_per_hour(samples, [](const MemorySample& s) { return s.kernel_kib; });
  const double app = slope_per_hour(samples, [](const MemorySample& s) { return s.app_kib; });
  return {kernel + app, kernel, app};
}

void MemoryWatch::watch(pid_t kernel, pid_t app) {
  kernel_ = kernel;
  app_ = app;
}

void MemoryWatch::sample(double time_s) {
  if (time_s < next_s_) return;
  const auto kernel = resident_kib(kernel_), app = resident_kib(app_);
  if (!kernel || !app) return;
  samples_.push_back({time_s, *kernel, *app});
  next_s_ = time_s + kEvery_s;
}

}  // namespace berm::run
