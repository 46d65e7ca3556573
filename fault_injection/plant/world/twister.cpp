#include "plant/world/twister.hpp"

#include <algorithm>

#include "plant/world/lanes.hpp"

namespace berm::plant {
namespace {

constexpr std::uint64_t upper = 0xFFFFFFFF80000000u, lower = 0x7FFFFFFFu, twist = 0xB5026F5AA96619E9u;

inline std::uint64_t mixed(std::uint64_t here, std::uint64_t next, std::uint64_t far) {
  const std::uint64_t y = (here & upper) | (next & lower);
  return far ^ (y >> 1) ^ ((0 - (y & 1)) & twist);
}

// The new state in place of the old one, and what is drawn from it.
BERM_PLANT_LANES void twisted(std::uint64_t* state, std::uint64_t* drawn, std::size_t words, std::size_t ahead) {
  for (std::size_t i = 0; i < words - ahead; ++i) state[i] = mixed(state[i], state[i + 1], state[i + ahead]);
  for (std::size_t i = words - ahead; i + 1 < words; ++i) state[i] = mixed(state[i], state[i + 1], state[i + ahead - words]);
  state[words - 1] = mixed(state[words - 1], state[0], state[ahead - 1]);
  for (std::size_t i = 0; i < words; ++i) {
    std::uint64_t z = state[i];
    z ^= (z >> 29) & 0x5555555555555555u;
    z ^= (z << 17) & 0x71D67FFFEDA60000u;
    z ^= (z << 37) & 0xFFF7EEE000000000u;
    drawn[i] = z ^ (z >> 43);
  }
}

}  // namespace

Twister::Twister(std::uint64_t seed) {
  state_[0] = seed;
  for (std::size_t i = 1; i < words; ++i) state_[i] = 6364136223846793005u * (state_[i - 1] ^ (state_[i - 1] >> 62)) + i;
}

void Twister::fill(std::uint64_t* to, std::size_t count) {
  while (count > 0) {
    if (next_ == words) refill();
    const std::size_t part = std::min(count, words - next_);
    to = std::copy_n(drawn_.data() + next_, part, to);
    next_ += part;
    count -= part;
  }
}

void Twister::refill() {
  twisted(state_.data(), drawn_.data(), words, ahead);
  next_ = 0;
}

}  // namespace berm::plant
