#include "plant/world/shot_draws.hpp"

#include <bit>
#include <numbers>
#include <tuple>

#include "plant/world/lanes.hpp"

namespace berm::plant {
namespace {

constexpr std::size_t pairs = ShotDraws::lasers / 2;
struct Uniforms { std::array<double, pairs> one, other; };

// A product costs less than a quotient, and these need not be right to the last bit.
constexpr double over(int n) { return 1.0 / n; }

// Box and Muller's pairs by series, which go into lanes: the logarithm of [sqrt(1/2), sqrt(2)) by that of the area tangent, sine and cosine of an
// eighth of a turn to either side.
BERM_PLANT_LANES void near_normals(const Uniforms& u, double* noise) {
  constexpr std::uint64_t half_root = 0x3FE6A09E667F3BCDu, bias = std::uint64_t{1024} << 52, magic_bits = 0x4330000000000000u;
  constexpr double magic = 0x1.0p52, nearest = 0x1.8p52, quarter = std::numbers::pi / 2;
  std::array<double, pairs> first, second;
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(1.0 - u.one[i]), shifted = bits - half_root + bias, twos = shifted >> 52;
    const double exponent = std::bit_cast<double>(magic_bits | twos) - (magic + 1024.0);
    const double m = std::bit_cast<double>(bits - (twos << 52) + bias);
    const double s = (m - 1.0) / (m + 1.0), q = s * s;
    const double series = 1.0 + q * (1.0 / 3 + q * (1.0 / 5 + q * (1.0 / 7 + q * (1.0 / 9 + q * (1.0 / 11)))));
    const double log = exponent * std::numbers::ln2 + 2.0 * s * series;
    const double radius = std::sqrt(-2.0 * log);
    const double turn = 4.0 * u.other[i], rounded = turn + nearest;
    const std::uint64_t quadrant = std::bit_cast<std::uint64_t>(rounded);
    const double a = (turn - (rounded - nearest)) * quarter, b = a * a;
    const double sine = a * (1.0 - b * over(6) * (1.0 - b * over(20) * (1.0 - b * over(42) * (1.0 - b * over(72) * (1.0 - b * over(110))))));
    const double cosine =
        1.0 - b * over(2) * (1.0 - b * over(12) * (1.0 - b * over(30) * (1.0 - b * over(56) * (1.0 - b * over(90) * (1.0 - b * over(132))))));
    const std::uint64_t odd = 0 - (quadrant & 1);
    const std::uint64_t sine_bits = std::bit_cast<std::uint64_t>(sine), cosine_bits = std::bit_cast<std::uint64_t>(cosine);
    const std::uint64_t x = (cosine_bits & ~odd) | (sine_bits & odd), y = (sine_bits & ~odd) | (cosine_bits & odd);
    first[i] = radius * std::bit_cast<double>(x ^ ((((quadrant + 1) >> 1) & 1) << 63));
    second[i] = radius * std::bit_cast<double>(y ^ (((quadrant >> 1) & 1) << 63));
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    noise[2 * i] = first[i];
    noise[2 * i + 1] = second[i];
  }
}

}  // namespace

ShotDraws::Firing ShotDraws::next() {
  static_assert(std::tuple_size_v<decltype(word_)> >= pairs * words_a_pair(true));
  bits_.fill(word_.data(), words());
  Uniforms u;
  for (std::size_t i = 0; i < pairs; ++i) {
    u.one[i] = uniform_of(word_[i * words_a_pair(more_)]);
    u.other[i] = uniform_of(word_[i * words_a_pair(more_) + 1]);
  }
  near_normals(u, near_.data());
  Firing firing;
  firing.word_ = word_.data();
  firing.near_ = near_.data();
  firing.more_ = more_;
  return firing;
}

}  // namespace berm::plant
