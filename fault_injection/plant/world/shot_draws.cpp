#include "plant/world/shot_draws.hpp"

#include <bit>
#include <numbers>

#include "plant/world/lanes.hpp"

namespace berm::plant {
namespace {

constexpr std::size_t pairs = ShotDraws::lasers / 2;
struct Uniforms { std::array<double, pairs> one, other; };

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
    const double sine = a * (1.0 - b / 6 * (1.0 - b / 20 * (1.0 - b / 42 * (1.0 - b / 72 * (1.0 - b / 110)))));
    const double cosine = 1.0 - b / 2 * (1.0 - b / 12 * (1.0 - b / 30 * (1.0 - b / 56 * (1.0 - b / 90 * (1.0 - b / 132)))));
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

void ShotDraws::draw(std::size_t firings) {
  if (taken_ > 0) {
    word_.erase(word_.begin(), word_.begin() + static_cast<std::ptrdiff_t>(taken_ * words()));
    near_.erase(near_.begin(), near_.begin() + static_cast<std::ptrdiff_t>(taken_ * lasers));
    drawn_ -= taken_;
    taken_ = 0;
  }
  word_.resize((drawn_ + firings) * words());
  near_.resize((drawn_ + firings) * lasers);
  for (; firings > 0; --firings, ++drawn_) {
    std::uint64_t* const word = word_.data() + drawn_ * words();
    bits_.fill(word, words());
    Uniforms u;
    for (std::size_t i = 0; i < pairs; ++i) {
      u.one[i] = uniform_of(word[i * words_a_pair(more_)]);
      u.other[i] = uniform_of(word[i * words_a_pair(more_) + 1]);
    }
    near_normals(u, near_.data() + drawn_ * lasers);
  }
}

void ShotDraws::ahead(std::size_t firings) {
  if (drawn_ - taken_ < firings) draw(firings - (drawn_ - taken_));
}

ShotDraws::Firing ShotDraws::next() {
  if (taken_ == drawn_) draw(1);
  Firing firing;
  firing.word_ = word_.data() + taken_ * words();
  firing.near_ = near_.data() + taken_ * lasers;
  firing.more_ = more_;
  ++taken_;
  return firing;
}

}  // namespace berm::plant
