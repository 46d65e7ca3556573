#include "io/sight_watch.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/scan_projection.hpp"

namespace berm::kernel {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint32_t kLidarStripMdeg = 360000 / SK_SIGHT_STRIPS;

// The farthest echo, and the nearest that does not lie on the window.
struct Echoes {
  std::int32_t last_mm = 0, other_mm = 0;
};

Echoes echoes_of(const berm_scan_packet& packet, int sample) {
  Echoes e;
  for (int k = 0; k < packet.echoes_per_sample; ++k) {
    const std::int32_t range_mm = packet.range[sample][k] * BERM_SCAN_RANGE_LSB_MM;
    e.last_mm = std::max(e.last_mm, range_mm);
    if (range_mm >= SK_SIGHT_NEAR_MM && (e.other_mm == 0 || range_mm < e.other_mm)) e.other_mm = range_mm;
  }
  return e;
}

void note_return(sk_eye& eye, std::int32_t other_mm, std::int32_t last_mm, std::int64_t now_us) {
  if (!sk_ray_blind(last_mm)) sk_eye_return(&eye, sk_ray_dusty(other_mm, last_mm), now_us);
}

}  // namespace

SightWatch::SightWatch(const berm_parameters& p) : parameters_(p), line_(p) {
  rules_ = {p.dust_slow_permille, p.dust_stop_permille, p.dust_dwell_us};
  begin();
  sk_dust_begin(&dust_state_);
  for (int s = 0; s < kScanners; ++s) head_[s] = Eigen::Vector3d(p.scanner[s].x_mm, p.scanner[s].y_mm, p.scanner[s].z_mm) * 1e-3;
  for (int i = 0; i < BERM_LIDARS; ++i) {
    mount_[i] = lidar_mount(p.lidar[i]);
    for (int degree = 0; degree < kDegrees; ++degree)
      for (int channel = 0; channel < kVlp16Channels; ++channel) kind_[i][degree][channel] = line_.of(mount_[i].place, beam(i, degree, channel));
    choose_steps(i);
  }
}

// A lidar whose lasers all look down has a thousand expected rays in a strip: judged by 40 that follow one another, a strip would be a degree wide.
void SightWatch::choose_steps(int lidar) {
  constexpr int kDegreesAStrip = kDegrees / SK_SIGHT_STRIPS;
  for (int strip = 0; strip < SK_SIGHT_STRIPS; ++strip) {
    std::uint32_t rays = 0;
    for (int degree = strip * kDegreesAStrip; degree < (strip + 1) * kDegreesAStrip; ++degree)
      for (const std::uint8_t kind : kind_[lidar][degree]) rays += kind != SightLine::kOpen ? 1000U / kVlp16FiringMdeg : 0U;
    step_[lidar][strip] = std::max(rays / kRaysATurn, 1U);
  }
}

void SightWatch::begin() {
  for (sk_eye& eye : eye_) sk_eye_begin(&eye);
}

// In the upper body's frame.
Eigen::Vector3d SightWatch::beam(int lidar, int degree, int channel) const {
  const double azimuth = (degree + 0.5) * kPi / 180.0;
  const Vlp16Elevation e = vlp16_elevation(static_cast<std::uint8_t>(channel));
  return mount_[lidar].turn * Eigen::Vector3d(e.cosine * std::cos(azimuth), -e.cosine * std::sin(azimuth), e.sine);
}

void SightWatch::take(const berm_scan_packet& packet, double swing_rad, std::int64_t now_us) {
  if (packet.scanner >= kScanners) return;
  sk_eye& eye = eye_[packet.scanner];
  const Eigen::Vector3d& head = head_[packet.scanner];
  const double swing_cosine = std::cos(swing_rad), swing_sine = std::sin(swing_rad);
  for (int i = 0; i < packet.count; ++i) {
    const Echoes echoes = echoes_of(packet, i);
    note_return(eye, echoes.other_mm, echoes.last_mm, now_us);
    const int index = packet.first_index + i;
    const double turned = static_cast<double>(index) / packet.samples_per_revolution, elevation = 2.0 * kPi * turned, sine = std::sin(elevation);
    if (sine > -SightLine::kDownSine) continue;
    const double level = std::cos(elevation), pan = sample_pan_rad(packet, i);
    const Eigen::Vector3d direction(level * std::cos(pan), level * std::sin(pan), sine);
    const SightLine::Kind kind = line_.of(head, direction);
    if (kind == SightLine::kOpen || (kind == SightLine::kOverTracks && line_.over_tracks(head, direction, swing_cosine, swing_sine))) continue;
    const int strip = std::min(index * kScannerStrips / packet.samples_per_revolution, kScannerStrips - 1);
    sk_eye_ray(&eye, strip, sk_ray_blind(echoes.last_mm), parameters_.sight_blind_permille);
  }
}

void SightWatch::fired(int lidar, const Vlp16Firing& firing, const Swung& swung) {
  const int degree = static_cast<int>(firing.azimuth_mdeg / 1000) % kDegrees;
  const auto strip = static_cast<std::int32_t>(firing.azimuth_mdeg / kLidarStripMdeg) % SK_SIGHT_STRIPS;
  if (firings_[lidar]++ % step_[lidar][strip] != 0) return;
  for (int channel = 0; channel < kVlp16Channels; ++channel) {
    const std::uint8_t kind = kind_[lidar][degree][channel];
    if (kind == SightLine::kOpen) continue;
    if (kind == SightLine::kOverTracks && line_.over_tracks(mount_[lidar].place, beam(lidar, degree, channel), swung.cosine, swung.sine)) continue;
    sk_eye_ray(&eye_[kScanners + lidar], strip, sk_ray_blind(firing.last_mm[channel]), parameters_.sight_blind_permille);
  }
}

void SightWatch::take(int lidar, const std::uint8_t* bytes, double swing_rad, std::int64_t now_us) {
  if (lidar < 0 || lidar >= BERM_LIDARS) return;
  const bool dual = vlp16_is_dual(bytes);
  const Swung swung{std::cos(swing_rad), std::sin(swing_rad)};
  for (int k = 0; k < vlp16_firings(bytes); ++k) {
    const Vlp16Firing firing = vlp16_firing(bytes, k);
    fired(lidar, firing, swung);
    if (!dual || k % kDustStep != 0) continue;  // of single return nothing tells of dust
    sk_eye& eye = eye_[kScanners + lidar];
    for (int channel = 0; channel < kVlp16Channels; ++channel) note_return(eye, firing.other_mm[channel], firing.last_mm[channel], now_us);
  }
}

void SightWatch::step(std::int64_t now_us) {
  blocked_eyes_ = 0;
  for (int k = 0; k < kEyes; ++k)
    if (sk_eye_blocked(&eye_[k])) blocked_eyes_ |= 1U << k;
  dust_ = sk_sight_verdict(&dust_state_, eye_, kEyes, rules_, now_us);
}

}  // namespace berm::kernel
