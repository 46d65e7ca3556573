// The two panning scanners: which samples fall into a step, where they look, what comes back, and the packets that carry it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "plant/machine/implement_shape.hpp"
#include "plant/process/world_config.hpp"
#include "plant/world/base_pose.hpp"
#include "plant/world/echo_receiver.hpp"
#include "plant/world/random.hpp"
#include "plant/world/return_waveform.hpp"
#include "plant/world/scene.hpp"
#include "plant/world/sensor_air.hpp"
#include "plant/world/world.hpp"
#include "scan/scan_packet.h"

namespace berm::plant {

// One end of a step: what a sample's place in time interpolates between.
struct ScanPose { double swing = 0, pan = 0; };

class Scanner {
 public:
  Scanner(const ScannerConfig& config, const ScannerMount& mount, uint8_t number, uint64_t seed);
  // The samples in (t - dt, t]. Sample n is taken at (n + 1) / rate, counted from the start in whole nanoseconds, so nothing drifts.
  // Packets do not span scanlines or calls. returns: takes what people and vehicles sent back, or null.
  void step(double t, double dt, const ScanPose& before, const ScanPose& now, const Scene& scene, std::vector<berm_scan_packet>& out,
            const BaseFrame& stand = BaseFrame(), std::vector<MoverReturn>* returns = nullptr, const SensorAir& air = {});

  // Direction of a sample in the upper body's frame.
  [[nodiscard]] Vec3 direction(int index, double pan) const;
  void draw_anew(uint64_t seed) { random_ = Random(seed), dust_random_ = Random(~seed), wave_random_ = Random(wave_seed(seed)); }

 private:
  struct Sample { uint16_t echo[BERM_SCAN_ECHOES] = {0, 0, 0}; };
  [[nodiscard]] int64_t time_ns(int64_t sample) const { return (sample + 1) * 1'000'000'000 / rate_; }
  // How the upper body stands at a sample.
  struct Stance {
    const BaseFrame& stand;
    PlanarFrame body;
  };
  struct Shot { Ray world, base, upper; double mirror; };
  [[nodiscard]] static Shot shot(const Stance& stance, const Ray& upper, double mirror);
  Sample measure(const Shot& shot, const Stance& stance, const Scene& scene, const SensorAir& air, std::vector<MoverReturn>* returns);
  // Echoes of the sampled return; noise: of the range, m.
  Sample listen(const Shot& shot, const std::optional<SceneHit>& hit, const Stance& stance, const Scene& scene, const SensorAir& air, double noise,
                uint64_t seed, std::vector<MoverReturn>* returns);
  // Cosine between the beam and the normal of what it met, by two beams beside it.
  [[nodiscard]] double cos_incidence(const Shot& shot, double range, const Stance& stance, const Scene& scene) const;
  [[nodiscard]] static uint64_t wave_seed(uint64_t seed) { return seed ^ 0x5741564546524D53u; }
  [[nodiscard]] uint16_t raw(double range) const;

  ScannerConfig config_;
  Vec3 head_;
  uint8_t number_;
  int64_t rate_;
  int64_t next_ = 0;        // number of the next sample
  uint32_t sequence_ = 0;
  Random random_, dust_random_, wave_random_;  // dust of the air and waveforms draw from their own, so that they leave all else as it was
  ReturnWaveform wave_;
  std::optional<EchoReceiver> receiver_;        // when there are samples with a waveform
  std::vector<double> cosine_, sine_;  // of the mirror's angle
};

}  // namespace berm::plant
