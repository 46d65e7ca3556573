#include "plant/world/scanner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berm::plant {
namespace {

// A window that lets less through than this is reported as dirty, percent.
constexpr double dirty_window = 70;

int32_t micro(double value) { return static_cast<int32_t>(std::llround(value * 1e6)); }

}  // namespace

Scanner::Scanner(const ScannerConfig& config, const ScannerMount& mount, uint8_t number, uint64_t seed)
    : config_(config), head_{mount.position[0], mount.position[1], mount.position[2]}, number_(number), rate_(std::llround(config.sample_rate_hz)), random_(seed),
      dust_random_(~seed) {
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

Scanner::Sample Scanner::measure(const Shot& shot, const Scene& scene, const SensorAir& air, std::vector<MoverReturn>* returns) {
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
  if (air.covers(shot.mirror)) {
    add(config_.range_min);
    return s;
  }
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
      const PlanarFrame body(0, 0, 0, before.swing + f * (now.swing - before.swing));
      const Ray base{body.out(upper.origin), body.out(upper.direction)};
      const Sample s = measure({stand.out(base), base, upper, 2 * std::numbers::pi * (index + i) / turn}, scene, air, returns);
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
