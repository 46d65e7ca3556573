// One sweep of a sensor over the loading place: where each sample looks from and to, and the cloud that comes back. Base frame, metres, radians.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "points/point_cloud.hpp"
#include "truck_world/bounding_tree.hpp"
#include "truck_world/random_streams.hpp"

namespace berm::truck_world {

enum class Sensor { left_scanner, right_scanner, lidar };
constexpr std::array<std::string_view, 3> sensor_names{"left_scanner", "right_scanner", "lidar"};
constexpr std::string_view name_of(Sensor sensor) { return sensor_names[static_cast<std::size_t>(sensor)]; }

// The scanners of interface_spec/config/machines/zx200.toml, and a VLP-16 on a mast over the cab roof, tilted to the side.
constexpr double sample_rate_hz = 12000.0;           // of a panning scanner (stentz-1999, section 2)
constexpr int samples_per_scanline = 400;            // a full turn of the mirror
constexpr double sector = 1.5707963267948966;        // swept by the head
constexpr double pan_low = -0.7853981633974483, pan_high = 2.268928027592629;  // of the left head; the right one's are the mirror image
constexpr int lidar_lasers = 16;
constexpr double lidar_column_s = 55.296e-6, lidar_turn_s = 0.1;
constexpr double lidar_tilt = 0.3490658503988659;
constexpr double range_min = 0.5, range_max = 60.0;  // m
// Returns nearer the swing axis are of the machine itself, and the kernel publishes none of them.
constexpr double own_radius = 3.2;                   // m

struct SampleRay {
  Vector3d origin, direction;
  std::uint32_t scanline;  // a turn of the mirror, or a firing of all the lidar's lasers
  double time_s;
};

struct Sweep {
  Sensor sensor = Sensor::left_scanner;
  int samples = 36000;
  Vector3d head = Vector3d::Zero();             // in the upper body's frame
  double swing_begin = 0.0, swing_rate = 0.0;   // rad, rad/s; known, as the kernel knows it
  double pan_begin = 0.0, pan_rate = 0.0;       // of the head in the upper body; panning scanners
  double time_begin = 0.0;                      // s

  [[nodiscard]] double duration() const;
  [[nodiscard]] SampleRay ray(int sample) const;
  [[nodiscard]] Vector3d head_at(double seconds) const;  // from the sweep's begin
  // Where the sensor is when its fan passes the point; the lidar in the middle of the sweep.
  [[nodiscard]] Vector3d head_seeing(const Vector3d& point) const;
  // Whether the fan passes over the point, by the margin (rad) or more from the sector's ends. The lidar sees all round.
  [[nodiscard]] bool passes(const Vector3d& point, double margin) const;

 private:
  [[nodiscard]] double time_over(const Vector3d& point) const;
};

// A sweep whose sector has the place near its middle, as far as the head can turn. The machine stands at swing 0, or swings through it.
Sweep draw_sweep(bool lidar, int samples, const Vector2d& place, double swinging_share, Random& random);

struct RangeNoise {
  double stddev = 0.03;         // m
  double outlier_share = 0.005; // of the samples: a range anywhere before what is hit
  double dropout_share = 0.005; // of the samples: nothing comes back
};

// What a point of the cloud is of.
struct PointTruth {
  std::uint32_t sample = 0;  // of the sweep
  Surface surface = Surface::ground;
  bool outlier = false;      // surface then says nothing
};

// The points that the kernel would publish, and beside each its truth. The draws of noise do not depend on what is hit.
void take_sweep(const Sweep& sweep, const RangeNoise& noise, const Mesh& mesh, const BoundingTree& tree, Random& random,
                std::vector<app::ScanPoint>& cloud, std::vector<PointTruth>& truth);

}  // namespace berm::truck_world
