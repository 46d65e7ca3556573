// Small bounded noise from a stream of its own.
#pragma once

#include <cstdint>
#include <random>

namespace berm::plant {

class SeededNoise {
 public:
  SeededNoise(std::uint64_t seed, std::uint64_t stream) : engine_(seed * 0x9E3779B97F4A7C15ull + stream) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }  // [0, 1)
  // Triangular, standard deviation sigma, never beyond 2.45 sigma: the sensors' error bounds hold always, not nearly always.
  double bounded(double sigma) { return sigma * 2.4494 * (uniform() + uniform() - 1.0); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace berm::plant
