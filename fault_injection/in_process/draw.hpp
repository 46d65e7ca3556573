// The draws of one trial: the same seed and run give the same numbers on every library.
#pragma once

#include <cstdint>
#include <random>

namespace berm::in_process {

class Draw {
 public:
  Draw(std::uint64_t seed, int run) : engine_(seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(run)) {}
  // 53 bits of the engine: the same on every library, unlike std::uniform_real_distribution.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  bool chance(double share) { return unit() < share; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace berm::in_process
