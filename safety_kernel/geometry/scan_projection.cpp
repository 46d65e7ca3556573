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
};

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
  Neighbour before[neighbour_samples] = {}; // the two samples before, as they came, nearest first
  int dropped = 0;
  for (int i = 0; i < count; ++i) {
    const uint32_t here = range_mm[i];
    const Neighbour previous = before[0].range_mm != 0 ? before[0] : before[1];
    Neighbour next{};
    for (int j = i + 1; j <= i + neighbour_samples && j < count && next.range_mm == 0; ++j) next = {range_mm[j], own[j] != 0};
    before[1] = before[0];
    before[0] = {here, own[i] != 0};
    if (here == 0) continue;
    // Supported by a neighbour that agrees, or by lying between two: ground that recedes, however steeply. The own machine supports nothing.
    const bool agrees = previous.supports(here, threshold_mm) || next.supports(here, threshold_mm);
    const bool two = previous.range_mm != 0 && next.range_mm != 0 && !previous.own && !next.own;
    const bool between = two && here >= std::min(previous.range_mm, next.range_mm) && here <= std::max(previous.range_mm, next.range_mm);
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
