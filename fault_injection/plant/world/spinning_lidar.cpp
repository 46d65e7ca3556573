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
constexpr std::size_t lasers = SpinningLidar::lasers_of_firing;
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

std::int64_t time_ns(std::int64_t firing) { return (firing + 1) * firing_ns; }

struct Nanoseconds {
  std::int64_t begin, end;
  explicit Nanoseconds(const SpinningLidar::Span& span)
      : begin(std::llround(span.t * 1e9) - std::llround(span.dt * 1e9)), end(std::llround(span.t * 1e9)) {}
};

double swing_at(const SpinningLidar::Span& span, const Nanoseconds& ns, std::int64_t firing) {
  const double f = static_cast<double>(time_ns(firing) - ns.begin) / static_cast<double>(ns.end - ns.begin);
  return span.swing_before + f * (span.swing_now - span.swing_before);
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
SpinningLidar::Returns SpinningLidar::received(const std::optional<SceneHit>& hit, const ShotDraws::Firing& drawn, std::size_t laser) const {
  Returns back;
  const bool hits = hit && hit->range >= range_least;
  back.met = hits;
  if (hits) back.last = back.other = std::max(range_least, drawn.noisy(hit->range, noise_.range_stddev, range_lsb, laser));
  if (!draws_more()) return back;
  const double outlier = mount_.outliers ? noise_.outlier_probability : 0.0, what = drawn.what(laser);
  const auto between = [&] { return range_least + drawn.where(laser) * std::max(0.0, (hit ? hit->range : range_most) - range_least); };
  if (what < outlier) {
    back.last = back.other = between();
    back.met = false;
  } else if (hits && mount_.dual && what < outlier + noise_.dust_probability) {
    back.other = std::min(between(), back.last);
  }
  return back;
}

// Dust in the air, over what came back: a nearer return beside it, which single return does not tell of, or the dust's alone.
void SpinningLidar::blow(double met_at, const SensorAir& air, Returns& back) {
  if (!air.dusty()) return;
  const double haze = dust_random_.uniform(), at = dust_random_.uniform();
  if (!back.met) return;
  const double in_haze = range_least + at * std::max(0.0, met_at - range_least);
  if (haze < air.lost) {
    back.last = back.other = in_haze;
    back.met = false;
  } else if (mount_.dual && haze < air.lost + air.dust) {
    back.other = std::min(in_haze, back.last);
  }
}

struct SpinningLidar::Aim {
  double cosine, sine;  // of the sensor's turn
  PlanarFrame body;
  RayFan upper, base, world;

  // The lasers' directions in the three frames.
  struct Directions { Beams upper, base, world; };
  [[nodiscard]] Directions directions(const Axes& sensor, const BaseFrame& stand) const {
    Beams own;
    Directions d;
    beams_of(fired, cosine, sine, own);
    turned_beams(own, sensor, d.upper);
    swung_beams(d.upper, body, d.base);
    turned_beams(d.base, {stand.x(), stand.y(), stand.z()}, d.world);
    return d;
  }
};

bool SpinningLidar::in_sector(double at) const { return std::min(at, 2 * std::numbers::pi - at) <= mount_.sector_deg / 180.0 * std::numbers::pi; }

SpinningLidar::Aim SpinningLidar::aim(double at, double swing, const BaseFrame& stand) const {
  Aim a;
  a.body = PlanarFrame(0, 0, 0, swing);
  a.cosine = std::cos(at), a.sine = std::sin(at);
  const Vec3 place{mount_.position[0], mount_.position[1], mount_.position[2]}, place_base = a.body.out(place);
  // The firing's lasers are upright over one another but for the turn meanwhile, and no steeper than 15 degrees.
  const double turned_by = turns_per_s * 2 * std::numbers::pi * lasers * 2304e-9;
  a.upper = {place, turned({a.cosine, -a.sine, 0}), turned({a.sine, a.cosine, 0}), turned_by};
  a.base = {place_base, a.body.out(a.upper.ahead), a.body.out(a.upper.aside), turned_by};
  a.world = {stand.out(place_base), stand.turned(a.base.ahead), stand.turned(a.base.aside), turned_by};
  return a;
}

void SpinningLidar::look(const Aim& aim, const Scene& scene, const BaseFrame& stand, Hits& hits) const {
  FanView view;
  const bool seen = scene.look(aim.world, aim.base, aim.upper, view);
  const Aim::Directions to = aim.directions({x_, y_, z_}, stand);
  const bool sky_above = seen && view.bare() && scene.over_ground(aim.world.origin);
  for (std::size_t laser = 0; laser < lasers; ++laser) {
    if (sky_above && to.world.z[laser] >= 0) {
      hits.set(laser, std::nullopt);
      continue;
    }
    const Ray upper{aim.upper.origin, to.upper.of(laser)}, base{aim.base.origin, to.base.of(laser)}, world{aim.world.origin, to.world.of(laser)};
    hits.set(laser, seen ? scene.meet(view, world, base, upper, range_most) : scene.meet(world, base, upper, range_most));
  }
}

void SpinningLidar::report(double at, double swing, const Hits& hits, const SensorAir& air, const BaseFrame& stand, std::uint8_t* records,
                           std::uint8_t* others, std::vector<MoverReturn>* returns) {
  const ShotDraws::Firing drawn = draws_.next();
  for (std::size_t laser = 0; laser < lasers; ++laser) {
    const std::optional<SceneHit> hit = hits.of(laser);
    Returns back = received(hit, drawn, laser);
    blow(hit ? hit->range : 0.0, air, back);
    if (air.covers(at) || drawn.lost(laser) < noise_.dropout_probability) continue;
    if (back.met && hit->mover != no_mover) {
      const Aim to = aim(at, swing, stand);
      note(*hit, {to.world.origin, to.directions({x_, y_, z_}, stand).world.of(laser)}, returns);
    }
    put_return(records + record_bytes * laser, back.last);
    if (others != nullptr) put_return(others + record_bytes * laser, back.other);
  }
}

// A caller that left a span of time out gets no firings of it.
std::int64_t SpinningLidar::first_firing(std::int64_t begin_ns) const {
  std::int64_t firing = next_;
  if (time_ns(firing) <= begin_ns) firing = begin_ns / firing_ns;
  while (time_ns(firing) <= begin_ns) ++firing;
  return firing;
}

bool SpinningLidar::foresee(const Span& span, std::size_t k, const Scene& scene, const BaseFrame& stand, Hits& hits) const {
  const Nanoseconds ns(span);
  const std::int64_t firing = first_firing(ns.begin) + static_cast<std::int64_t>(k);
  if (time_ns(firing) > ns.end) return false;
  const double at = azimuth(firing);
  if (in_sector(at)) look(aim(at, swing_at(span, ns, firing), stand), scene, stand, hits);
  return true;
}

bool SpinningLidar::may_meet(const Span& span, std::size_t k, const SceneDifference& difference, const BaseFrame& stand) const {
  if (difference.none()) return false;
  const Nanoseconds ns(span);
  const std::int64_t firing = first_firing(ns.begin) + static_cast<std::int64_t>(k);
  const Aim to = aim(azimuth(firing), swing_at(span, ns, firing), stand);
  return difference.may_be_met(to.world, to.upper);
}

void SpinningLidar::step(const Span& span, const SensorAir& air, const Scene& scene, const BaseFrame& stand, std::vector<LidarPacket>& out,
                         std::vector<MoverReturn>* returns, std::span<const Hits> foreseen) {
  const Nanoseconds ns(span);
  const std::int64_t firings_a_packet = mount_.dual ? blocks : 2 * blocks;
  const std::size_t blocks_a_pair = mount_.dual ? 2 : 1;
  next_ = first_firing(ns.begin);
  Hits anew;
  if (!air.stalled) stalled_at_.reset();
  else if (!stalled_at_) stalled_at_ = azimuth(next_);
  for (std::size_t k = 0; time_ns(next_) <= ns.end; ++next_, ++k) {
    const double at = stalled_at_.value_or(azimuth(next_)), swing = swing_at(span, ns, next_);
    const std::int64_t place = next_ % firings_a_packet;
    std::uint8_t* block = packet_.bytes.data() + block_bytes * blocks_a_pair * static_cast<std::size_t>(place / 2);
    std::uint8_t* other = mount_.dual ? block + block_bytes : nullptr;
    if (place % 2 == 0) {
      const unsigned told = static_cast<unsigned>(at * 18000 / std::numbers::pi) % 36000;
      for (std::uint8_t* head : {block, other}) {
        if (head == nullptr) continue;
        put16(head, 0xEEFF);
        put16(head + 2, told);
      }
    }
    const std::size_t record = 4 + (place % 2) * lasers * record_bytes;
    for (std::uint8_t* records : {block, other})
      if (records != nullptr) std::fill_n(records + record, record_bytes * lasers, std::uint8_t{0});
    if (in_sector(at)) {
      const bool known = k < foreseen.size() && !stalled_at_;  // foreseen is where it would look if it turned
      if (!known) look(aim(at, swing, stand), scene, stand, anew);
      report(at, swing, known ? foreseen[k] : anew, air, stand, block + record, other == nullptr ? nullptr : other + record, returns);
    }
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
