#include "truck_world/sweep.hpp"

#include <algorithm>
#include <cmath>

namespace berm::truck_world {
namespace {

double wrapped(double angle) { return std::remainder(angle, 2 * pi); }

Vector3d turned(const Vector3d& v, double yaw) {
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

struct MirrorTable {
  std::array<double, samples_per_scanline> cosine, sine;
  MirrorTable() {
    for (std::size_t i = 0; i < cosine.size(); ++i) {
      const double angle = 2 * pi * static_cast<double>(i) / samples_per_scanline;
      cosine[i] = std::cos(angle);
      sine[i] = std::sin(angle);
    }
  }
};

}  // namespace

double Sweep::duration() const {
  return sensor == Sensor::lidar ? lidar_column_s * (samples / lidar_lasers) : samples / sample_rate_hz;
}

Vector3d Sweep::head_at(double seconds) const { return turned(head, swing_begin + swing_rate * seconds); }

SampleRay Sweep::ray(int sample) const {
  if (sensor == Sensor::lidar) {
    const int column = sample / lidar_lasers, laser = sample % lidar_lasers;
    const double time = lidar_column_s * column, azimuth = 2 * pi * time / lidar_turn_s, elevation = (2.0 * laser - 15.0) * pi / 180.0;
    const double tilt = head.y() > 0.0 ? -lidar_tilt : lidar_tilt;  // the outer side down
    const Vector3d own(std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const Vector3d upper(own.x(), std::cos(tilt) * own.y() - std::sin(tilt) * own.z(), std::sin(tilt) * own.y() + std::cos(tilt) * own.z());
    return {head_at(time), turned(upper, swing_begin + swing_rate * time), static_cast<std::uint32_t>(column), time_begin + time};
  }
  static const MirrorTable mirror;
  const int line = sample / samples_per_scanline;
  const auto index = static_cast<std::size_t>(sample % samples_per_scanline);
  const double time = sample / sample_rate_hz, azimuth = swing_begin + pan_begin + (swing_rate + pan_rate) * time, c = mirror.cosine[index];
  return {head_at(time), {c * std::cos(azimuth), c * std::sin(azimuth), mirror.sine[index]}, static_cast<std::uint32_t>(line), time_begin + time};
}

double Sweep::time_over(const Vector3d& point) const {
  const double rate = swing_rate + pan_rate, middle = duration() / 2;
  double time = middle;
  for (int i = 0; i < 6; ++i) {  // the head moves little while the fan comes over: converges at once
    const Vector3d from = head_at(time);
    const double azimuth = std::atan2(point.y() - from.y(), point.x() - from.x());
    time = middle + wrapped(azimuth - (swing_begin + pan_begin + rate * middle)) / rate;
  }
  return time;
}

Vector3d Sweep::head_seeing(const Vector3d& point) const {
  return head_at(sensor == Sensor::lidar ? duration() / 2 : std::clamp(time_over(point), 0.0, duration()));
}

bool Sweep::passes(const Vector3d& point, double margin) const {
  if (sensor == Sensor::lidar) return true;
  const double time = time_over(point), least = margin / std::abs(swing_rate + pan_rate);
  return time >= least && time <= duration() - least;
}

Sweep draw_sweep(bool lidar, int samples, const Vector2d& place, double swinging_share, Random& random) {
  Sweep s;
  const double side = place.y() >= 0.0 ? 1.0 : -1.0;
  s.samples = samples;
  s.time_begin = std::floor(random.uniform(1.0, 1000.0) * 1000.0) / 1000.0;
  const bool swings = chance(random, swinging_share);
  const double sense_of_swing = chance(random, 0.5) ? 1.0 : -1.0;
  double rate = swings ? random.uniform(0.1, 0.35) * sense_of_swing : 0.0;
  const double jitter = random.uniform(-0.1, 0.1);
  const bool outwards = chance(random, 0.5);
  if (lidar) {
    s.sensor = Sensor::lidar;
    s.head = {0.90, side * 1.00, 3.70};
    s.samples = samples / lidar_lasers * lidar_lasers;
    s.swing_rate = rate;
    s.swing_begin = -rate * s.duration() / 2;
    return s;
  }
  s.sensor = side > 0.0 ? Sensor::left_scanner : Sensor::right_scanner;
  s.head = {1.30, side * 1.35, 3.30};
  const double towards = side * std::atan2(place.y() - s.head.y(), place.x() - s.head.x()) + jitter;  // mirrored to the left
  const double middle = std::clamp(towards, pan_low + sector / 2, pan_high - sector / 2), low = middle - sector / 2, high = middle + sector / 2;
  const double time = s.duration();
  // Swung through 0 in the middle of the sweep, and no faster than the head can make up for.
  const auto fits = [&](double omega) {
    const double first = (outwards ? low : high) + omega * time / 2, last = (outwards ? high : low) - omega * time / 2;
    return std::min(first, last) >= pan_low && std::max(first, last) <= pan_high && std::abs((last - first) / time) < 120.0 * pi / 180.0;
  };
  while (rate != 0.0 && !fits(rate)) rate = std::abs(rate) < 0.02 ? 0.0 : rate / 2;
  const double sense = outwards ? 1.0 : -1.0;
  s.swing_rate = side * rate + 0.0;  // never a negative zero
  s.swing_begin = 0.0 - s.swing_rate * time / 2;
  s.pan_begin = side * (outwards ? low : high) - s.swing_begin;
  s.pan_rate = side * sense * sector / time - s.swing_rate;
  return s;
}

void take_sweep(const Sweep& sweep, const RangeNoise& noise, const Mesh& mesh, const BoundingTree& tree, Random& random,
                std::vector<app::ScanPoint>& cloud, std::vector<PointTruth>& truth) {
  for (int sample = 0; sample < sweep.samples; ++sample) {
    const double normal = random.normal(), what = random.uniform(), where = random.uniform();
    const SampleRay ray = sweep.ray(sample);
    const std::optional<Hit> hit = tree.first(ray.origin, ray.direction, range_max);
    const bool outlier = what < noise.outlier_share;
    if (!outlier && (!hit || hit->range < range_min || what < noise.outlier_share + noise.dropout_share)) continue;
    double range = 0.0;
    if (outlier) {
      range = range_min + where * std::max(0.0, (hit ? hit->range : range_max) - range_min);
    } else {
      range = std::max(range_min, hit->range + noise.stddev * normal);
    }
    const Surface surface = hit ? mesh[hit->triangle].surface : Surface::ground;
    const Vector3d at = ray.origin + range * ray.direction;
    if (at.head<2>().norm() < own_radius || (!outlier && surface == Surface::own_arm)) continue;
    cloud.push_back({static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(at.z()), ray.scanline, ray.time_s});
    truth.push_back({static_cast<std::uint32_t>(sample), surface, outlier});
  }
}

}  // namespace berm::truck_world
