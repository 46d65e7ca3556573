// A sweep over an open box and a cab on level ground, cast from the planes themselves: what the recogniser should find, without any code of its own.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "points/point_cloud.hpp"

namespace berm::app {

struct DrawnBed {
  double x = 1.0, y = 8.5, yaw = 0.3;                        // of the middle
  double length = 5.0, width = 2.4, top = 1.6, floor = 0.2;  // inside; heights
  double thickness = 0.1, ground = -1.2;
  bool carrier = false;                                      // below the bed, flush with its walls' outer faces, down to the ground
  bool lid = false, cab = true, rear_wall = true;            // the cab stands 0.3 m beyond the end at +x of the bed
  double canopy = 0.0, canopy_rise = 0.2;                    // length of a sheet from the top of the wall at +x, and how much its front is higher; the cab is lower than it
  bool block = false;                                        // another, higher one beyond the end at -x
  double load = -1e9;                                        // height of a level load, where that is over the floor
  double swing_rate = 0.0;                                   // rad/s, of the sensor about z
  double swings_from = 0.0, swings_until = 3.0;              // s; it stands before and after

  // rad, from the viewpoint, which is where it stands 1.5 s after the sweep's beginning.
  [[nodiscard]] double turned(double time) const { return swing_rate * (std::clamp(time, swings_from, swings_until) - 1.5); }
};

constexpr std::array<double, 3> drawn_viewpoint{1.30, 1.35, 3.30};
constexpr double drawn_range_error = 0.01;  // m, alternating

// 90 scanlines of 400 samples over 90 degrees, as the panning scanner measures them.
inline std::vector<ScanPoint> sweep_of(const DrawnBed& bed) {
  constexpr double pi = std::numbers::pi;
  const double cy = std::cos(bed.yaw), sy = std::sin(bed.yaw);
  std::vector<ScanPoint> points;
  for (int sample = 0; sample < 36000; ++sample) {
    const int line = sample / 400;
    const double time = sample / 12000.0, turn = bed.turned(time), elevation = 2 * pi * (sample % 400) / 400;
    const double pan = pi / 4 + pi / 2 * line / 90.0, c = std::cos(turn), s = std::sin(turn);
    const double head[3] = {c * drawn_viewpoint[0] - s * drawn_viewpoint[1], s * drawn_viewpoint[0] + c * drawn_viewpoint[1], drawn_viewpoint[2]};
    const double d[3] = {std::cos(elevation) * std::cos(pan), std::cos(elevation) * std::sin(pan), std::sin(elevation)};
    // In the bed's frame, heights as they are.
    const double a[3] = {cy * (head[0] - bed.x) + sy * (head[1] - bed.y), -sy * (head[0] - bed.x) + cy * (head[1] - bed.y), head[2]};
    const double w[3] = {cy * d[0] + sy * d[1], -sy * d[0] + cy * d[1], d[2]};
    double range = 25.0;
    const auto box = [&](double x0, double x1, double y0, double y1, double z0, double z1) {
      double in = 0.0, out = 1e9;
      const double low[3] = {x0, y0, z0}, high[3] = {x1, y1, z1};
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(w[axis]) < 1e-12) {
          if (a[axis] < low[axis] || a[axis] > high[axis]) return;
          continue;
        }
        const double p = (low[axis] - a[axis]) / w[axis], q = (high[axis] - a[axis]) / w[axis];
        in = std::max(in, std::min(p, q));
        out = std::min(out, std::max(p, q));
      }
      if (in < out && in > 0.0) range = std::min(range, in);
    };
    const double x = bed.length / 2, y = bed.width / 2, t = bed.thickness;
    const double rear = bed.rear_wall ? -x - t : -x;
    if (bed.load > bed.floor) box(-x, x, -y, y, bed.floor, bed.load);
    box(rear, x + t, y, y + t, bed.floor, bed.top);
    box(rear, x + t, -y - t, -y, bed.floor, bed.top);
    box(x, x + t, -y - t, y + t, bed.floor, bed.top);
    if (bed.rear_wall) box(-x - t, -x, -y - t, y + t, bed.floor, bed.top);
    if (bed.cab) box(x + t + 0.3, x + t + 2.1, -1.2, 1.2, bed.ground + 0.8, bed.top + (bed.canopy > 0.0 ? -0.1 : 0.3));
    if (bed.block) box(-x - t - 2.1, -x - t - 0.3, -1.2, 1.2, bed.ground, bed.top + 0.4);
    box(-x, x, -y, y, bed.floor - 0.1, bed.floor);
    if (bed.canopy > 0.0) {
      const double rise = bed.canopy_rise / bed.canopy, begin = x + t, way = (bed.top + rise * (a[0] - begin) - a[2]) / (w[2] - rise * w[0]);
      const double u = a[0] + way * w[0], v = a[1] + way * w[1];
      if (way > 0.0 && u > begin && u < begin + bed.canopy && std::abs(v) < y + t) range = std::min(range, way);
    }
    if (bed.carrier) box(-x - t, x + t, -y - t, y + t, bed.ground, bed.floor - 0.1);
    if (bed.lid) box(-x, x, -y, y, bed.top - 0.02, bed.top);
    box(-60.0, 60.0, -60.0, 60.0, bed.ground - 1.0, bed.ground);
    if (range >= 25.0) continue;
    range += sample % 2 == 0 ? drawn_range_error : -drawn_range_error;
    const auto at = [&](int axis) { return static_cast<float>(head[axis] + range * d[axis]); };
    points.push_back({at(0), at(1), at(2), static_cast<std::uint32_t>(line), time});
  }
  return points;
}

}  // namespace berm::app
