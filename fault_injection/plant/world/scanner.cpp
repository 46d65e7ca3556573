#include "plant/world/scanner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace berm::plant {
namespace {

// A window that lets less through than this is reported as dirty, percent.
constexpr double dirty_window = 70;

// What is ranged this near to what the beam met came back from it, m: a pulse's half width and a little.
constexpr double of_target_m = 0.3;

// The beams beside one, by which the face that it met is known, rad; an edge passes for a face this steep at most.
constexpr double beside_rad = 0.002, steepest_cosine = 0.17;

int32_t micro(double value) { return static_cast<int32_t>(std::llround(value * 1e6)); }

}  // namespace

Scanner::Scanner(const ScannerConfig& config, const ScannerMount& mount, uint8_t number, uint64_t seed)
    : config_(config), head_{mount.position[0], mount.position[1], mount.position[2]}, number_(number), rate_(std::llround(config.sample_rate_hz)), random_(seed),
      dust_random_(~seed), wave_random_(wave_seed(seed)) {
  if (config.waveform_share > 0.0) receiver_.emplace(wave_.lidar(), config.ranging, config.range_min);
  for (int i = 0; i < config.samples_per_revolution; ++i) {
    const double e = 2 * std::numbers::pi * i / config.samples_per_revolution;
    cosine_.push_back(std::cos(e));
    sine_.push_back(std::sin(e));
  }
}

Vec3 Scanner::direction(int index, double pan) const {
  const double c = cosine_[static_cast<size_t>(index)];
  return {c * std::cos(pan), c * std::sin(pan), sine_[static_cast<size_t>(index)]};
}

uint16_t Scanner::raw(double range) const { return static_cast<uint16_t>(std::clamp<long long>(std::llround(range * 1000 / BERM_SCAN_RANGE_LSB_MM), 1, 65535)); }

Scanner::Shot Scanner::shot(const Stance& stance, const Ray& upper, double mirror) {
  const Ray base{stance.body.out(upper.origin), stance.body.out(upper.direction)};
  return {stance.stand.out(base), base, upper, mirror};
}

double Scanner::cos_incidence(const Shot& at, double range, const Stance& stance, const Scene& scene) const {
  const Vec3& d = at.upper.direction;
  const Vec3 across = std::abs(d.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 aside = unit(cross(d, across)), upwards = cross(aside, d);
  std::array<Vec3, 2> face;  // from the hit to those beside it
  size_t k = 0;
  for (const Vec3& to : {aside, upwards}) {
    const Shot beside = shot(stance, {at.upper.origin, unit(d + beside_rad * to)}, at.mirror);
    const std::optional<double> met = scene.cast(beside.world, beside.base, beside.upper, config_.range_max);
    if (!met) return steepest_cosine;
    face[k++] = beside.upper.at(*met) - at.upper.at(range);
  }
  return std::clamp(std::abs(dot(unit(cross(face[0], face[1])), d)), steepest_cosine, 1.0);
}

Scanner::Sample Scanner::listen(const Shot& at, const std::optional<SceneHit>& hit, const Stance& stance, const Scene& scene, const SensorAir& air,
                                double noise, uint64_t seed, std::vector<MoverReturn>* returns) {
  PulsePath path;
  path.window_percent = config_.window_percent;
  const double reach = hit ? hit->range : config_.range_max;
  for (const DustCloud& c : air.clouds)
    if (const auto span = c.box.cross(at.world, reach)) path.clouds.push_back({(*span)[0], (*span)[1], c.extinction});
  if (hit) path.target = HardTarget{hit->range, config_.reflectivity, cos_incidence(at, hit->range, stance, scene)};
  wave_.sample(path, seed);
  const Echoes echoes = receiver_->receive(wave_);
  Sample s;
  int k = 0;
  for (; k < echoes.count; ++k) s.echo[k] = raw(std::max(config_.range_min, echoes.range[static_cast<size_t>(k)] + noise));
  // More than one echo is the packet's only sign of dust: a single pulse that is too long is told twice.
  if (echoes.dust && k == 1) s.echo[k++] = s.echo[0];
  if (hit && k > 0 && std::abs(echoes.range[static_cast<size_t>(echoes.count - 1)] - hit->range) < of_target_m) note(*hit, at.world, returns);
  return s;
}

Scanner::Sample Scanner::measure(const Shot& shot, const Stance& stance, const Scene& scene, const SensorAir& air, std::vector<MoverReturn>* returns) {
  Sample s;
  // The draws do not depend on what is hit, so that one changed object does not change every later sample's noise.
  const double noise = random_.normal(), what = random_.uniform(), where = random_.uniform(), film = random_.uniform();
  const std::optional<SceneHit> hit = scene.meet(shot.world, shot.base, shot.upper, config_.range_max);
  int echoes = 0;
  const auto add = [&](double range) {  // nearest first; never more than three
    int k = echoes++;
    const uint16_t r = raw(range);
    for (; k > 0 && s.echo[k - 1] > r; --k) s.echo[k] = s.echo[k - 1];
    s.echo[k] = r;
  };
  const double haze = air.dusty() ? dust_random_.uniform() : 1.0, haze_at = air.dusty() ? dust_random_.uniform() : 0.0;
  const bool waveform = receiver_ && wave_random_.uniform() < config_.waveform_share;
  const auto wave_noise = waveform ? static_cast<uint64_t>(wave_random_.uniform() * 0x1p53) : 0u;
  if (air.covers(shot.mirror)) {
    add(config_.range_min);
    return s;
  }
  if (waveform) return listen(shot, hit, stance, scene, air, config_.range_stddev * noise, wave_noise, returns);
  // Part of the light comes back from a dirty window; the last echo is still the target.
  if (film * 200 < 100 - config_.window_percent) add(config_.range_min);
  double rate = config_.outlier_probability;
  const double reach = hit ? hit->range : config_.range_max;
  const double between = config_.range_min + where * std::max(0.0, reach - config_.range_min);
  const double in_haze = config_.range_min + haze_at * std::max(0.0, reach - config_.range_min);
  if (what < rate) {
    add(between);
  } else if (what < (rate += config_.dropout_probability) || !hit || hit->range < config_.range_min) {
    // no return
  } else if (haze < air.lost) {
    add(in_haze);
  } else {
    if (what < rate + config_.dust_probability) add(between);
    const double range = std::max(config_.range_min, hit->range + config_.range_stddev * noise);
    if (what >= rate + config_.dust_probability && haze < air.lost + air.dust) add(std::min(in_haze, range));
    add(range);
    note(*hit, shot.world, returns);
  }
  return s;
}

void Scanner::step(double t, double dt, const ScanPose& before, const ScanPose& now, const Scene& scene, std::vector<berm_scan_packet>& out,
                   const BaseFrame& stand, std::vector<MoverReturn>* returns, const SensorAir& air) {
  const int64_t end = std::llround(t * 1e9), begin = end - std::llround(dt * 1e9);
  const auto fraction = [&](int64_t sample) {
    return std::clamp(static_cast<double>(time_ns(sample) - begin) / static_cast<double>(end - begin), 0.0, 1.0);
  };
  const auto pan_at = [&](double f) { return before.pan + f * (now.pan - before.pan); };
  const int turn = config_.samples_per_revolution;
  // A caller that left a span of time out gets no samples of it, but the mirror went on turning.
  if (time_ns(next_) <= begin) next_ = begin * rate_ / 1'000'000'000;
  while (time_ns(next_) <= begin) ++next_;
  while (time_ns(next_) <= end) {
    const int index = static_cast<int>(next_ % turn);
    int64_t last = next_;  // of this packet
    while (last + 1 - next_ < BERM_SCAN_PACKET_SAMPLES && (last + 1) % turn != 0 && time_ns(last + 1) <= end) ++last;
    berm_scan_packet& p = out.emplace_back();
    p = berm_scan_packet{};
    p.scanner = number_;
    p.flags = static_cast<uint16_t>((index == 0 ? BERM_SCAN_FLAG_FIRST : 0) | ((last + 1) % turn == 0 ? BERM_SCAN_FLAG_LAST : 0) |
                                    (config_.window_percent < dirty_window ? BERM_SCAN_FLAG_WINDOW_DIRTY : 0));
    p.sequence = sequence_++;
    p.scanline = static_cast<uint32_t>(next_ / turn);
    p.time_us = static_cast<uint64_t>(time_ns(next_) / 1000);
    p.sample_period_ns = static_cast<uint32_t>(1'000'000'000 / rate_);
    p.pan_start_urad = micro(pan_at(fraction(next_)));
    p.pan_end_urad = micro(pan_at(fraction(last)));
    p.first_index = static_cast<uint16_t>(index);
    p.samples_per_revolution = static_cast<uint16_t>(turn);
    p.count = static_cast<uint16_t>(last + 1 - next_);
    p.window_percent = static_cast<uint8_t>(std::clamp(std::lround(config_.window_percent), 0L, 100L));
    int most = 1;
    for (int i = 0; i < p.count; ++i) {
      const double f = fraction(next_ + i);
      const Ray upper{head_, direction(index + i, pan_at(f))};
      const Stance stance{stand, PlanarFrame(0, 0, 0, before.swing + f * (now.swing - before.swing))};
      const Sample s = measure(shot(stance, upper, 2 * std::numbers::pi * (index + i) / turn), stance, scene, air, returns);
      for (int k = 0; k < BERM_SCAN_ECHOES; ++k) {
        p.range[i][k] = s.echo[k];
        if (s.echo[k] != 0) most = std::max(most, k + 1);
      }
    }
    p.echoes_per_sample = static_cast<uint8_t>(most);
    next_ = last + 1;
  }
}

}  // namespace berm::plant
