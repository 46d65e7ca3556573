// A stream of random numbers of its own: same seed, same numbers, on every standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "plant/world/twister.hpp"

namespace berm::plant {

// In [0, 1).
inline double uniform_of(uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

struct NormalPair { double first, second; };
// Two of mean 0 and standard deviation 1 out of two uniform ones (Box and Muller).
inline NormalPair normal_pair(double one, double other) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - one));
  const double angle = 2.0 * std::numbers::pi * other;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// Bits: a generator of 64 random bits.
template <typename Bits>
class Draws {
 public:
  explicit Draws(uint64_t seed) : bits_(seed) {}

  // In [0, 1).
  double uniform() { return uniform_of(bits_()); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // Mean 0, standard deviation 1; both of a pair are used.
  double normal() {
    if (spare_ready_) {
      spare_ready_ = false;
      return spare_;
    }
    const double one = uniform();
    const NormalPair pair = normal_pair(one, uniform());
    spare_ = pair.second;
    spare_ready_ = true;
    return pair.first;
  }

 private:
  Bits bits_;
  double spare_ = 0;
  bool spare_ready_ = false;
};

using Random = Draws<Twister>;

// Costs nothing to begin, for streams of a few hundred draws (splitmix64; Steele, Lea and Flood, 2014).
class SplitMix {
 public:
  explicit SplitMix(uint64_t seed) : state_(seed) {}
  uint64_t operator()() {
    uint64_t x = state_ += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
  }

 private:
  uint64_t state_;
};

}  // namespace berm::plant
