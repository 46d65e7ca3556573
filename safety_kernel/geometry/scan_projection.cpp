#include "geometry/scan_projection.hpp"

#include <algorithm>
#include <cmath>

namespace berm::kernel {
namespace {

constexpr double two_pi = 6.283185307179586;
constexpr double metres_per_mm = 1e-3;
constexpr double rad_per_urad = 1e-6;
constexpr int neighbour_samples = 2;

struct Neighbour {
  uint32_t range_mm = 0; // 0 where nothing came back
  bool own = false;

  bool supports(uint32_t range, uint32_t threshold) const noexcept {
    return range_mm != 0 && !own && (range > range_mm ? range - range_mm : range_mm - range) <= threshold;
  }
  bool seen() const noexcept { return range_mm != 0 && !own; }
  bool lies_between(const Neighbour& a, const Neighbour& b) const noexcept {
    return a.seen() && b.seen() && range_mm >= std::min(a.range_mm, b.range_mm) && range_mm <= std::max(a.range_mm, b.range_mm);
  }
};

// What encloses here on one side: near, or, where that stands out before or behind both here and beyond, the nearest returns to it, beyond.
Neighbour enclosing(const Neighbour& near, const Neighbour& beyond, const Neighbour& here, uint32_t threshold) noexcept {
  if (!near.seen() || !beyond.seen() || !here.seen()) return near;
  const int64_t low = std::min(beyond.range_mm, here.range_mm), high = std::max(beyond.range_mm, here.range_mm), range = near.range_mm;
  return range + threshold < low || range > high + threshold ? beyond : near;
}

} // namespace

void last_echoes(const berm_scan_packet& packet, uint32_t (&range_mm)[BERM_SCAN_PACKET_SAMPLES], uint8_t (&echoes)[BERM_SCAN_PACKET_SAMPLES]) noexcept {
  const int count = std::min<int>(packet.count, BERM_SCAN_PACKET_SAMPLES);
  const int per_sample = std::min<int>(packet.echoes_per_sample, BERM_SCAN_ECHOES);
  for (int i = 0; i < BERM_SCAN_PACKET_SAMPLES; ++i) {
    range_mm[i] = 0;
    echoes[i] = 0;
    if (i >= count) continue;
    for (int e = 0; e < per_sample; ++e) {
      if (packet.range[i][e] == 0) continue;
      range_mm[i] = static_cast<uint32_t>(packet.range[i][e]) * BERM_SCAN_RANGE_LSB_MM;
      ++echoes[i];
    }
  }
}

int filter_spurious(uint32_t* range_mm, const uint8_t* own, int count, uint32_t threshold_mm) noexcept {
  static_assert(filter_reach == 2 * neighbour_samples);
  Neighbour before[filter_reach] = {}; // the samples before, as they came, nearest first
  int dropped = 0;
  for (int i = 0; i < count; ++i) {
    const auto after = [&](int from) { // the nearest return after from, as they came
      for (int j = from + 1; j <= from + neighbour_samples && j < count; ++j)
        if (range_mm[j] != 0) return j;
      return count;
    };
    const auto at = [&](int j) { return j < count ? Neighbour{range_mm[j], own[j] != 0} : Neighbour{}; };
    const Neighbour here = at(i);
    const int last = before[0].range_mm != 0 ? 0 : 1;
    const Neighbour previous = before[last], ahead = before[before[last + 1].range_mm != 0 ? last + 1 : last + 2];
    const int next_at = after(i);
    const Neighbour next = at(next_at), beyond = next_at < count ? at(after(next_at)) : Neighbour{};
    std::copy_backward(before, before + filter_reach - 1, before + filter_reach);
    before[0] = here;
    if (here.range_mm == 0) continue;
    // Supported by a neighbour that agrees, or by lying between two: ground that recedes, however steeply. The own machine supports nothing, and
    // what stands out itself encloses nothing: of two spurious returns in a row one lies between the other and the ground.
    const bool agrees = previous.supports(here.range_mm, threshold_mm) || next.supports(here.range_mm, threshold_mm);
    const bool between = here.lies_between(previous, next) &&
                         here.lies_between(enclosing(previous, ahead, here, threshold_mm), enclosing(next, beyond, here, threshold_mm));
    if (agrees || between) continue;
    range_mm[i] = 0;
    ++dropped;
  }
  return dropped;
}

int64_t sample_time_us(const berm_scan_packet& packet, int sample) noexcept {
  return static_cast<int64_t>(packet.time_us) + static_cast<int64_t>(sample) * static_cast<int64_t>(packet.sample_period_ns) / 1000;
}

double sample_pan_rad(const berm_scan_packet& packet, int sample) noexcept {
  const double start = packet.pan_start_urad * rad_per_urad, end = packet.pan_end_urad * rad_per_urad;
  return packet.count > 1 ? start + (end - start) * sample / (packet.count - 1) : start;
}

ScanProjection::ScanProjection(const berm_parameters& parameters) noexcept
    : range_min_mm_(static_cast<uint32_t>(std::max(0, parameters.range_min_mm))),
      range_max_mm_(static_cast<uint32_t>(std::max(0, parameters.range_max_mm))) {
  for (int i = 0; i < BERM_SCANNER_MOUNTS; ++i) {
    const berm_scanner_mount& mount = parameters.scanner[i];
    head_[i] = Eigen::Vector3d(mount.x_mm, mount.y_mm, mount.z_mm) * metres_per_mm;
  }
}

bool ScanProjection::in_upper_body(const berm_scan_packet& packet, int sample, uint32_t range_mm, Eigen::Vector3d& point) const noexcept {
  if (packet.scanner >= BERM_SCANNER_MOUNTS || sample < 0 || sample >= packet.count || packet.samples_per_revolution == 0) return false;
  if (range_mm == 0 || range_mm < range_min_mm_ || range_mm > range_max_mm_) return false;
  const double elevation = two_pi * (packet.first_index + sample) / packet.samples_per_revolution;
  const double pan = sample_pan_rad(packet, sample);
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(pan), std::cos(elevation) * std::sin(pan), std::sin(elevation));
  point = head_[packet.scanner] + range_mm * metres_per_mm * direction;
  return true;
}

bool ScanProjection::in_base(const Eigen::Vector3d& upper_body, double swing_rad, sk_point& point) noexcept {
  const double c = std::cos(swing_rad), s = std::sin(swing_rad);
  const double x_mm = 1e3 * (upper_body.x() * c - upper_body.y() * s);
  const double y_mm = 1e3 * (upper_body.x() * s + upper_body.y() * c);
  const double z_mm = 1e3 * upper_body.z();
  if (!(std::fabs(x_mm) <= SK_COORD_MAX_MM && std::fabs(y_mm) <= SK_COORD_MAX_MM) || std::isnan(z_mm)) return false;
  constexpr double height_max_mm = SK_HEIGHT_MAX_MM;
  point.x_mm = static_cast<int32_t>(std::lround(x_mm));
  point.y_mm = static_cast<int32_t>(std::lround(y_mm));
  point.z_mm = static_cast<int32_t>(std::ceil(std::clamp(z_mm, -height_max_mm, height_max_mm)));
  return true;
}

} // namespace berm::kernel
