// What is drawn for the shots of a lidar of sixteen lasers, whatever they hit: range noise, whether the shot is lost, and, of sensors with dust or
// outliers, what comes back besides and from where. One stream, in the order in which Random draws for shot after shot: a normal number, a uniform
// one, and two more. It is kept as drawn, and made into numbers where a shot asks for them. A firing's is drawn when it is asked for: it stays near the
// processor until it is used, as that of a whole step would not.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "plant/world/random.hpp"

namespace berm::plant {

class ShotDraws {
 public:
  static constexpr std::size_t lasers = 16;
  static constexpr double near_by = 1e-7;  // more than near_noise differs from noise: 1e-9 seen

  // Of the shots of one firing; until the next is taken.
  class Firing {
   public:
    [[nodiscard]] double noise(std::size_t laser) const {
      const std::uint64_t* const pair = word_ + laser / 2 * words_a_pair(more_);
      const NormalPair both = normal_pair(uniform_of(pair[0]), uniform_of(pair[1]));
      return laser % 2 == 0 ? both.first : both.second;
    }
    [[nodiscard]] double near_noise(std::size_t laser) const { return near_[laser]; }
    [[nodiscard]] double lost(std::size_t laser) const { return uniform_of(of(laser)[0]); }
    [[nodiscard]] double what(std::size_t laser) const { return more_ ? uniform_of(of(laser)[1]) : 0.0; }
    [[nodiscard]] double where(std::size_t laser) const { return more_ ? uniform_of(of(laser)[2]) : 0.0; }
    // A range with its noise, as a sensor tells it that rounds to whole steps: it comes to as many as the range with the noise to the last bit.
    [[nodiscard]] double noisy(double range, double stddev, double step, std::size_t laser) const {
      const double near = range + stddev * near_[laser], per_step = 1.0 / step, steps = near * per_step, doubtful = near_by * stddev * per_step;
      const double part = steps - static_cast<double>(static_cast<std::int64_t>(steps));
      return std::abs(std::abs(part) - 0.5) > doubtful ? near : range + stddev * noise(laser);
    }

   private:
    friend class ShotDraws;
    [[nodiscard]] const std::uint64_t* of(std::size_t laser) const {
      return word_ + laser / 2 * words_a_pair(more_) + 2 + (laser % 2 == 0 ? 0 : more_ ? 3 : 1);
    }
    const std::uint64_t* word_ = nullptr;
    const double* near_ = nullptr;
    bool more_ = false;
  };

  // more: what and where as well.
  ShotDraws(std::uint64_t seed, bool more) : bits_(seed), more_(more) {}
  [[nodiscard]] Firing next();

 private:
  // The normal numbers of two shots come from the same two uniform ones.
  [[nodiscard]] static constexpr std::size_t words_a_pair(bool more) { return more ? 8 : 4; }
  [[nodiscard]] std::size_t words() const { return lasers / 2 * words_a_pair(more_); }

  Twister bits_;
  bool more_;
  std::array<std::uint64_t, lasers / 2 * 8> word_{};  // of the newest firing, as near_
  std::array<double, lasers> near_{};
};

}  // namespace berm::plant
