// Scan blocks and machine states as a test draws them, in the contract's layout.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>

#include "contract/berm_contract.h"
#include "motion/angles.hpp"
#include "perception/machine_history.hpp"

namespace berm::app::drawn {

inline std::int32_t micro(double value) { return static_cast<std::int32_t>(std::lround(value * 1e6)); }

inline berm_decision state_at(std::int64_t time_us, const Joints& angle, const Joints& velocity = {}) {
  berm_decision d{};
  d.time_us = time_us;
  for (std::size_t j = 0; j < joints; ++j) {
    d.joint_angle_urad[j] = micro(angle[j]);
    d.joint_velocity_urad_s[j] = micro(velocity[j]);
  }
  return d;
}

// Consecutive samples, the first 54 degrees below the level ahead (108 where there are more than 60): 400 a turn, 12 kHz, the pan standing.
inline berm_scan_block block(std::uint8_t scanner, std::uint32_t scanline, int samples, std::uint32_t range_mm = 8000, double pan = 0.0) {
  berm_scan_block b{};
  b.scanner = scanner;
  b.scanline = scanline;
  b.count = static_cast<std::uint16_t>(samples);
  b.time_us = 2'000'000;
  b.sample_period_ns = 83333;
  b.first_index = samples > 60 ? 280 : 340;
  b.samples_per_revolution = 400;
  b.pan_start_urad = b.pan_end_urad = micro(pan);
  for (int i = 0; i < std::min(samples, BERM_SCAN_BLOCK_SAMPLES); ++i) {
    b.range_mm[i] = range_mm;
    b.echoes[i] = 1;
  }
  return b;
}

// A state segment with a machine that stands, or moves as told, from time 0 on.
struct Segment {
  using Motion = std::function<Joints(double time_s)>;
  explicit Segment(Motion motion = [](double) { return Joints{0.0, radians(70.0), radians(-60.0), radians(-60.0)}; })
      : at(std::make_unique<berm_state_segment>()), motion_(std::move(motion)) {
    std::memset(static_cast<void*>(at.get()), 0, sizeof *at);
  }

  // States every 10 ms, up to this time.
  void run_to(double time_s) {
    for (; next_us_ <= static_cast<std::int64_t>(std::lround(time_s * 1e6)); next_us_ += 10000) {
      const double t = static_cast<double>(next_us_) * 1e-6;
      const Joints now = motion_(t), later = motion_(t + 1e-4);
      Joints velocity{};
      for (std::size_t j = 0; j < joints; ++j) velocity[j] = (later[j] - now[j]) / 1e-4;
      at->decision[at->decision_head % BERM_DECISION_RING] = state_at(next_us_, now, velocity);
      ++at->decision_head;
    }
  }

  void publish(berm_scan_block b) {
    const std::uint32_t n = at->scan_head;
    b.sequence = 2 * n + 2;
    at->scan[n % BERM_SCAN_RING] = b;
    at->scan_head = n + 1;
  }

  std::unique_ptr<berm_state_segment> at;

private:
  Motion motion_;
  std::int64_t next_us_ = 0;
};

}  // namespace berm::app::drawn
