// Independent streams of random numbers of one scene: what one subject draws does not change what another does.
#pragma once

#include <cstddef>
#include <cstdint>

#include "plant/world/random.hpp"

namespace berm::truck_world {

using plant::Random;

enum class Stream : std::uint64_t { content = 1, place, body, mud, load, ground, clutter, look_alike, occluder, sweep, noise };

// The stream of (seed, scene, subject); attempt tells apart draws that are repeated because the one before did not fit the site.
inline Random stream(std::uint64_t seed, int scene, Stream subject, int attempt = 0) {
  // SplitMix64's finaliser (Steele et al., 2014): neighbouring numbers give unrelated seeds.
  const auto mixed = [](std::uint64_t z) {
    z += 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  };
  const std::uint64_t which = static_cast<std::uint64_t>(subject) << 32 | static_cast<std::uint32_t>(attempt);
  return Random(mixed(mixed(mixed(seed) ^ static_cast<std::uint64_t>(scene)) ^ which));
}

inline bool chance(Random& random, double share) { return random.uniform() < share; }
// A whole number in [0, count).
inline std::size_t below(Random& random, std::size_t count) { return static_cast<std::size_t>(random.uniform() * static_cast<double>(count)); }

}  // namespace berm::truck_world
