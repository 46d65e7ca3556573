#include "plant/world/bucket_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace berm::plant {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double slide_time = 0.35;  // s: what does not rest leaves with this time constant
constexpr double least_flow = 0.15;  // m3/s: the tail does not trickle for ever

struct Knot { double tilt, share; };
// Share of the heaped volume that rests: the heap goes first, then what lies over the line of repose behind the lip; the bottom
// plate is about 33 degrees from the mouth's plane, so all of it slides once that plate is steeper than the soil rests.
constexpr std::array<Knot, 5> rest = {{{0, 1.0}, {20 * degree, 1.0}, {35 * degree, 0.85}, {90 * degree, 0.30}, {125 * degree, 0.0}}};
// Sticking soil lets go between these tilts.
constexpr double stick_begin = 135 * degree, stick_end = 170 * degree;

}  // namespace

BucketLoad::BucketLoad(const ImplementShape& shape, const SoilConfig& soil, double ballast_kg)
    : heaped_(std::max(0.0, std::min(shape.bucket_heaped_m3, shape.bucket_payload_max_kg * soil.swell / soil.density_bank) -
                                ballast_kg * soil.swell / soil.density_bank)),
      stick_(soil.stick_fraction) {}

double BucketLoad::mouth_tilt(const LinkFrame& bucket) { return std::acos(std::clamp(-bucket.cos_angle, -1.0, 1.0)); }

double BucketLoad::capacity(double tilt) const {
  for (size_t k = 1; k < rest.size(); ++k) {
    if (tilt < rest[k].tilt) {
      const double f = (tilt - rest[k - 1].tilt) / (rest[k].tilt - rest[k - 1].tilt);
      return heaped_ * (rest[k - 1].share + f * (rest[k].share - rest[k - 1].share));
    }
  }
  return 0;
}

double BucketLoad::struck() const { return 0.85 * heaped_; }

double BucketLoad::take(double loose_volume) {
  const double taken = std::min(loose_volume, std::max(0.0, heaped_ - volume_));
  volume_ += taken;
  before_dump_ = volume_;
  return loose_volume - taken;
}

double BucketLoad::release(double tilt, double dt, bool held_by_ground) {
  if (held_by_ground) return 0;
  const double letting_go = std::clamp((tilt - stick_begin) / (stick_end - stick_begin), 0.0, 1.0);
  const double stays = std::max(capacity(tilt), stick_ * before_dump_ * (1 - letting_go));
  const double loose = volume_ - stays;
  if (loose <= 0) return 0;
  const double out = std::min(loose, std::max(loose * (1 - std::exp(-dt / slide_time)), least_flow * dt));
  volume_ -= out;
  if (volume_ < 1e-9) {
    const double all = out + volume_;
    volume_ = before_dump_ = 0;
    return all;
  }
  return out;
}

}  // namespace berm::plant
