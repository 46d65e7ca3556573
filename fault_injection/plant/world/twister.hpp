// The Mersenne Twister of 64 bits (Nishimura, 2000), as std::mt19937_64 draws: the same numbers, made 312 at a time in loops that a compiler puts in lanes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace berm::plant {

class Twister {
 public:
  explicit Twister(std::uint64_t seed);
  std::uint64_t operator()() {
    if (next_ == words) refill();
    return drawn_[next_++];
  }
  // The next so many.
  void fill(std::uint64_t* to, std::size_t count);

 private:
  static constexpr std::size_t words = 312, ahead = 156;
  void refill();

  std::array<std::uint64_t, words> state_, drawn_;
  std::size_t next_ = words;
};

}  // namespace berm::plant
