#include "plant/world/spinning_lidar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/world/lanes.hpp"

namespace berm::plant {
namespace {

constexpr std::int64_t firing_ns = 55296;       // of all sixteen lasers, one after the other
constexpr double turns_per_s = 10.0;
constexpr double range_least = 0.5, range_most = 100.0, range_lsb = 0.002;
constexpr std::size_t lasers = 16;
constexpr int blocks = 12;
constexpr std::size_t block_bytes = 100, record_bytes = 3;
constexpr std::int64_t hour_us = 3'600'000'000;
constexpr std::uint8_t strongest = 0x37, dual = 0x39, product = 0x22, reflectivity = 30;

// Of laser k in firing order, degrees.
constexpr double elevation_deg(int laser) { return laser % 2 == 0 ? -15.0 + laser : laser; }

// Of each laser: its elevation, and how far the sensor turns from the firing's begin until it fires.
struct Lasers {
  std::array<double, lasers> up_cosine, up_sine, turn_cosine, turn_sine;
  Lasers() {
    for (std::size_t k = 0; k < lasers; ++k) {
      const double e = elevation_deg(static_cast<int>(k)) * std::numbers::pi / 180, turn = turns_per_s * 2 * std::numbers::pi * static_cast<int>(k) * 2304e-9;
      up_cosine[k] = std::cos(e), up_sine[k] = std::sin(e), turn_cosine[k] = std::cos(turn), turn_sine[k] = std::sin(turn);
    }
  }
};
const Lasers fired;

// One vector for each laser.
struct Beams {
  std::array<double, lasers> x, y, z;
  [[nodiscard]] Vec3 of(std::size_t laser) const { return {x[laser], y[laser], z[laser]}; }
};
// Three axes of a frame in another.
struct Axes { Vec3 x, y, z; };

BERM_PLANT_LANES void turned_beams(const Beams& in, const Axes& by, Beams& out) {
  for (std::size_t k = 0; k < lasers; ++k) {
    out.x[k] = in.x[k] * by.x.x + in.y[k] * by.y.x + in.z[k] * by.z.x;
    out.y[k] = in.x[k] * by.x.y + in.y[k] * by.y.y + in.z[k] * by.z.y;
    out.z[k] = in.x[k] * by.x.z + in.y[k] * by.y.z + in.z[k] * by.z.z;
  }
}

BERM_PLANT_LANES void swung_beams(const Beams& in, const PlanarFrame& body, Beams& out) {
  for (std::size_t k = 0; k < lasers; ++k) {
    out.x[k] = body.x + body.cos_yaw * in.x[k] - body.sin_yaw * in.y[k];
    out.y[k] = body.y + body.sin_yaw * in.x[k] + body.cos_yaw * in.y[k];
    out.z[k] = body.z + in.z[k];
  }
}

// In the sensor's frame, which the firing began turned so far.
BERM_PLANT_LANES void beams_of(const Lasers& l, double cosine, double sine, Beams& out) {
  for (std::size_t k = 0; k < lasers; ++k) {
    const double ahead = cosine * l.turn_cosine[k] - sine * l.turn_sine[k], aside = sine * l.turn_cosine[k] + cosine * l.turn_sine[k];
    out.x[k] = l.up_cosine[k] * ahead;
    out.y[k] = -l.up_cosine[k] * aside;
    out.z[k] = l.up_sine[k];
  }
}

double azimuth(std::int64_t firing) {
  const double turns = static_cast<double>(firing) * firing_ns * 1e-9 * turns_per_s;
  return 2 * std::numbers::pi * (turns - std::floor(turns));
}

void put16(std::uint8_t* to, unsigned v) {
  to[0] = static_cast<std::uint8_t>(v & 0xFF);
  to[1] = static_cast<std::uint8_t>(v >> 8);
}

void put_return(std::uint8_t* to, double range) {
  if (range <= 0.0) return;
  put16(to, static_cast<unsigned>(std::clamp(static_cast<long>(range / range_lsb + 0.5), 1L, 65535L)));
  to[2] = reflectivity;
}

}  // namespace

SpinningLidar::SpinningLidar(const ScannerConfig& noise, const LidarMount& mount, std::uint8_t number, std::uint64_t seed)
    : noise_(noise), mount_(mount), number_(number), draws_(seed, draws_more()), dust_random_(~seed) {
  const BaseFrame turn({0, 0, mount.yaw, mount.roll, mount.pitch});
  x_ = turn.turned({1, 0, 0});
  y_ = turn.turned({0, 1, 0});
  z_ = turn.turned({0, 0, 1});
}

Vec3 SpinningLidar::turned(const Vec3& v) const { return v.x * x_ + v.y * y_ + v.z * z_; }

// Dust sends back less than the target behind it: the target is the last and the strongest, and the strongest but that is the dust (VLP-16 manual, dual
// return mode).
SpinningLidar::Returns SpinningLidar::received(const std::optional<double>& hit, const ShotDraws::Firing& drawn, std::size_t laser) const {
  Returns back;
  const bool hits = hit && *hit >= range_least;
  back.met = hits;
  if (hits) back.last = back.other = std::max(range_least, drawn.noisy(*hit, noise_.range_stddev, range_lsb, laser));
  if (!draws_more()) return back;
  const double outlier = mount_.outliers ? noise_.outlier_probability : 0.0, what = drawn.what(laser);
  const auto between = [&] { return range_least + drawn.where(laser) * std::max(0.0, hit.value_or(range_most) - range_least); };
  if (what < outlier) {
    back.last = back.other = between();
    back.met = false;
  } else if (hits && mount_.dual && what < outlier + noise_.dust_probability) {
    back.other = std::min(between(), back.last);
  }
  return back;
}

// Dust in the air, over what came back: a nearer return beside it, which single return does not tell of, or the dust's alone.
void SpinningLidar::blow(const std::optional<double>& hit, const SensorAir& air, Returns& back) {
  if (!air.dusty()) return;
  const double haze = dust_random_.uniform(), at = dust_random_.uniform();
  if (!back.met) return;
  const double in_haze = range_least + at * std::max(0.0, *hit - range_least);
  if (haze < air.lost) {
    back.last = back.other = in_haze;
    back.met = false;
  } else if (mount_.dual && haze < air.lost + air.dust) {
    back.other = std::min(in_haze, back.last);
  }
}

void SpinningLidar::fire(std::int64_t firing, double swing, const SensorAir& air, const Scene& scene, const BaseFrame& stand, std::uint8_t* records,
                         std::uint8_t* others, std::vector<MoverReturn>* returns) {
  const double at = azimuth(firing);
  const bool in_sector = std::min(at, 2 * std::numbers::pi - at) <= mount_.sector_deg / 180.0 * std::numbers::pi;
  const PlanarFrame body(0, 0, 0, swing);
  std::fill(records, records + record_bytes * lasers, std::uint8_t{0});
  if (others != nullptr) std::fill(others, others + record_bytes * lasers, std::uint8_t{0});
  if (!in_sector) return;
  const double cosine = std::cos(at), sine = std::sin(at);
  const Vec3 place{mount_.position[0], mount_.position[1], mount_.position[2]}, place_base = body.out(place), place_world = stand.out(place_base);
  // The firing's lasers are upright over one another but for the turn meanwhile, and no steeper than 15 degrees.
  const double turned_by = turns_per_s * 2 * std::numbers::pi * lasers * 2304e-9;
  const RayFan upper_fan{place, turned({cosine, -sine, 0}), turned({sine, cosine, 0}), turned_by};
  const RayFan base_fan{place_base, body.out(upper_fan.ahead), body.out(upper_fan.aside), turned_by};
  const RayFan world_fan{place_world, stand.turned(base_fan.ahead), stand.turned(base_fan.aside), turned_by};
  FanView view;
  const bool seen = scene.look(world_fan, base_fan, upper_fan, view);
  Beams own, in_upper, in_base, in_world;
  beams_of(fired, cosine, sine, own);
  turned_beams(own, {x_, y_, z_}, in_upper);
  swung_beams(in_upper, body, in_base);
  turned_beams(in_base, {stand.x(), stand.y(), stand.z()}, in_world);
  const ShotDraws::Firing drawn = draws_.next();
  for (std::size_t laser = 0; laser < lasers; ++laser) {
    const Ray upper{place, in_upper.of(laser)}, base{place_base, in_base.of(laser)}, world{place_world, in_world.of(laser)};
    const std::optional<SceneHit> hit = seen ? scene.meet(view, world, base, upper, range_most) : scene.meet(world, base, upper, range_most);
    const std::optional<double> range = hit ? std::optional<double>(hit->range) : std::nullopt;
    Returns back = received(range, drawn, laser);
    blow(range, air, back);
    if (air.covers(at) || drawn.lost(laser) < noise_.dropout_probability) continue;
    if (back.met) note(*hit, world, returns);
    put_return(records + record_bytes * laser, back.last);
    if (others != nullptr) put_return(others + record_bytes * laser, back.other);
  }
}

void SpinningLidar::step(double t, double dt, double swing_before, double swing_now, const SensorAir& air, const Scene& scene, const BaseFrame& stand,
                         std::vector<LidarPacket>& out, std::vector<MoverReturn>* returns) {
  const std::int64_t end = std::llround(t * 1e9), begin = end - std::llround(dt * 1e9);
  const auto time_ns = [](std::int64_t firing) { return (firing + 1) * firing_ns; };
  if (time_ns(next_) <= begin) next_ = begin / firing_ns;  // a caller that left a span of time out gets no firings of it
  while (time_ns(next_) <= begin) ++next_;
  const std::int64_t firings_a_packet = mount_.dual ? blocks : 2 * blocks;
  const std::size_t blocks_a_pair = mount_.dual ? 2 : 1;
  for (; time_ns(next_) <= end; ++next_) {
    const double f = static_cast<double>(time_ns(next_) - begin) / static_cast<double>(end - begin);
    const std::int64_t place = next_ % firings_a_packet;
    std::uint8_t* block = packet_.bytes.data() + block_bytes * blocks_a_pair * static_cast<std::size_t>(place / 2);
    std::uint8_t* other = mount_.dual ? block + block_bytes : nullptr;
    if (place % 2 == 0) {
      const unsigned at = static_cast<unsigned>(azimuth(next_) * 18000 / std::numbers::pi) % 36000;
      for (std::uint8_t* head : {block, other}) {
        if (head == nullptr) continue;
        put16(head, 0xEEFF);
        put16(head + 2, at);
      }
    }
    const std::size_t to = 4 + (place % 2) * lasers * record_bytes;
    fire(next_, swing_before + f * (swing_now - swing_before), air, scene, stand, block + to, other == nullptr ? nullptr : other + to, returns);
    if (place + 1 < firings_a_packet) continue;
    const auto stamp = static_cast<std::uint32_t>((time_ns(next_) / 1000) % hour_us);
    for (std::size_t i = 0; i < 4; ++i) packet_.bytes[1200 + i] = static_cast<std::uint8_t>(stamp >> (8 * i));
    packet_.bytes[1204] = mount_.dual ? dual : strongest;
    packet_.bytes[1205] = product;
    packet_.lidar = number_;
    out.push_back(packet_);
  }
}

}  // namespace berm::plant
