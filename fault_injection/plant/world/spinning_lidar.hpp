// A VLP-16 on the upper body: which lasers fire in a step, where they look, what comes back, and the sensor's native packets (single or dual return).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "plant/machine/implement_shape.hpp"
#include "plant/process/world_config.hpp"
#include "plant/world/base_pose.hpp"
#include "plant/world/random.hpp"
#include "plant/world/scene.hpp"
#include "plant/world/sensor_air.hpp"
#include "plant/world/shot_draws.hpp"

namespace berm::plant {

constexpr std::size_t lidar_packet_bytes = 1206;
struct LidarPacket {
  std::uint8_t lidar;
  std::array<std::uint8_t, lidar_packet_bytes> bytes;
};

class SpinningLidar {
 public:
  SpinningLidar(const ScannerConfig& noise, const LidarMount& mount, std::uint8_t number, std::uint64_t seed);
  // The firings in (t - dt, t], appended as packets when twelve blocks are full: of two firings each, or, dual return, each two of two.
  // air.covered: something lies on the window, and nothing comes back. returns: takes what people and vehicles sent back, or null.
  void step(double t, double dt, double swing_before, double swing_now, const SensorAir& air, const Scene& scene, const BaseFrame& stand,
            std::vector<LidarPacket>& out, std::vector<MoverReturn>* returns = nullptr);
  void draw_anew(std::uint64_t seed) { draws_ = ShotDraws(seed, draws_more()), dust_random_ = Random(~seed); }
  static constexpr std::size_t firings_a_cycle = 182;  // at most, of 10 ms
  // Draws for so many of the next firings, in time that is to spare; what comes of it is the same.
  void draw_ahead(std::size_t firings) { draws_.ahead(firings); }

 private:
  struct Returns {
    bool met = false;                // the last is of what was hit
    double last = 0.0, other = 0.0;  // m; 0: none. other: the strongest but the last, or the last again
  };
  [[nodiscard]] bool draws_more() const { return mount_.dual || mount_.outliers; }
  // What comes back of a laser's shot that something did, or nothing (hit), with what was drawn for it.
  [[nodiscard]] Returns received(const std::optional<double>& hit, const ShotDraws::Firing& drawn, std::size_t laser) const;
  // records: of the last returns; others: of the strongest, or null.
  void blow(const std::optional<double>& hit, const SensorAir& air, Returns& back);
  void fire(std::int64_t firing, double swing, const SensorAir& air, const Scene& scene, const BaseFrame& stand, std::uint8_t* records, std::uint8_t* others,
            std::vector<MoverReturn>* returns);
  [[nodiscard]] Vec3 turned(const Vec3& v) const;

  ScannerConfig noise_;
  LidarMount mount_;
  std::uint8_t number_;
  ShotDraws draws_;
  Random dust_random_;         // dust of the air draws from its own, so that it leaves all else as it was
  Vec3 x_, y_, z_;             // the sensor's axes in the upper body
  std::int64_t next_ = 0;      // number of the next firing
  LidarPacket packet_{};
};

}  // namespace berm::plant
