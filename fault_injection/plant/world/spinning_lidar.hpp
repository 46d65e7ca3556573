// A VLP-16 on the upper body: which lasers fire in a step, where they look, what comes back, and the sensor's native packets (single or dual return).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
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
  static constexpr std::size_t lasers_of_firing = ShotDraws::lasers;

  SpinningLidar(const ScannerConfig& noise, const LidarMount& mount, std::uint8_t number, std::uint64_t seed);
  // A span of time in which the sensor's place is told: the swing angle moves evenly from one end to the other.
  struct Span { double t, dt, swing_before, swing_now; bool operator==(const Span&) const = default; };
  // What the lasers of a firing meet; of one that looks where the sensor is blank whatever was there.
  struct Hits {
    static constexpr double nothing = -1.0;
    std::array<double, lasers_of_firing> range{};  // m, or nothing
    std::array<std::int32_t, lasers_of_firing> mover{};
    void set(std::size_t laser, const std::optional<SceneHit>& hit) {
      range[laser] = hit ? hit->range : nothing;
      mover[laser] = hit ? hit->mover : no_mover;
    }
    [[nodiscard]] std::optional<SceneHit> of(std::size_t laser) const {
      if (range[laser] == nothing) return std::nullopt;
      return SceneHit{range[laser], mover[laser]};
    }
  };

  // The firings in (t - dt, t], appended as packets when twelve blocks are full: of two firings each, or, dual return, each two of two.
  // air.covered: something lies on the window, and nothing comes back. air.stalled: it looks where it looked first, then where it would have turned to.
  // returns: takes what people and vehicles sent back, or null. foreseen: what its
  // firings meet, or none, and they are looked at here.
  void step(const Span& span, const SensorAir& air, const Scene& scene, const BaseFrame& stand, std::vector<LidarPacket>& out,
            std::vector<MoverReturn>* returns = nullptr, std::span<const Hits> foreseen = {});
  // Of the next step: what firing k of it meets in a scene; false when it has no more.
  bool foresee(const Span& span, std::size_t k, const Scene& scene, const BaseFrame& stand, Hits& hits) const;
  // Whether that firing may meet where two scenes differ.
  [[nodiscard]] bool may_meet(const Span& span, std::size_t k, const SceneDifference& difference, const BaseFrame& stand) const;
  void draw_anew(std::uint64_t seed) { draws_ = ShotDraws(seed, draws_more()), dust_random_ = Random(~seed); }
  static constexpr std::size_t firings_a_cycle = 182;  // at most, of 10 ms

 private:
  struct Returns {
    bool met = false;                // the last is of what was hit
    double last = 0.0, other = 0.0;  // m; 0: none. other: the strongest but the last, or the last again
  };
  [[nodiscard]] bool draws_more() const { return mount_.dual || mount_.outliers; }
  // What comes back of a laser's shot that met something, or nothing, with what was drawn for it.
  [[nodiscard]] Returns received(const std::optional<SceneHit>& hit, const ShotDraws::Firing& drawn, std::size_t laser) const;
  void blow(double met_at, const SensorAir& air, Returns& back);
  // Where a firing looks that the sensor's turn has come to, in the three frames of a scene.
  struct Aim;
  [[nodiscard]] Aim aim(double at, double swing, const BaseFrame& stand) const;
  [[nodiscard]] bool in_sector(double at) const;
  void look(const Aim& aim, const Scene& scene, const BaseFrame& stand, Hits& hits) const;
  // records: of the last returns; others: of the strongest, or null.
  void report(double at, double swing, const Hits& hits, const SensorAir& air, const BaseFrame& stand, std::uint8_t* records, std::uint8_t* others,
              std::vector<MoverReturn>* returns);
  [[nodiscard]] std::int64_t first_firing(std::int64_t begin_ns) const;
  [[nodiscard]] Vec3 turned(const Vec3& v) const;

  ScannerConfig noise_;
  LidarMount mount_;
  std::uint8_t number_;
  ShotDraws draws_;
  Random dust_random_;         // dust of the air draws from its own, so that it leaves all else as it was
  Vec3 x_, y_, z_;             // the sensor's axes in the upper body
  std::int64_t next_ = 0;      // number of the next firing
  std::optional<double> stalled_at_;  // where the head stands
  LidarPacket packet_{};
};

}  // namespace berm::plant
