// Medians of the thread's CPU time. The parties take turns within each repetition, so that what disturbs one disturbs all.
#pragma once

#include <time.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace berm::bench {

inline double cpu_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

struct Party {
  std::string name;
  std::function<void()> run;
  int inner = 1;  // runs between two readings of the clock
  std::vector<double> sample_us{};

  double median() const {
    std::vector<double> sorted = sample_us;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
  }
};

// One warm-up run each, which also sets how many runs make a sample of half a millisecond; then the repetitions.
inline void measure(std::vector<Party>& parties, int repetitions) {
  constexpr double kSampleUs = 500.0;
  for (Party& party : parties) {
    party.run();
    const double begin = cpu_us();
    party.run();
    const double once = std::max(0.5, cpu_us() - begin);
    party.inner = std::clamp(static_cast<int>(kSampleUs / once), 1, 1000);
  }
  for (int r = 0; r < repetitions; ++r)
    for (Party& party : parties) {
      const double begin = cpu_us();
      for (int i = 0; i < party.inner; ++i) party.run();
      party.sample_us.push_back((cpu_us() - begin) / party.inner);
    }
}

}  // namespace berm::bench
