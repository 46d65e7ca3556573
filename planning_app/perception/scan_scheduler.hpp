// Points both scanners so that the ground under the coming motion has been seen, densely and lately enough, before the machine gets there.
//
// Each scanner sweeps a sector back and forth; the sector follows the work phase. The rate is held so that pan and swing together turn the
// scanline by no more than azimuth_rate in the base frame: at 30 scanlines a second that is the spacing of the lines on the ground.
#pragma once

#include <array>
#include <cstdint>

#include "motion/machine_model.hpp"

namespace berm::app {

struct PanRequest { double goal = 0.0, rate = 0.0; };        // rad relative to the upper body, rad/s
struct PanSector { double low = 0.0, high = 0.0; };          // rad, relative to the upper body

class ScanScheduler {
public:
  static constexpr double azimuth_rate = radians(38.0);

  explicit ScanScheduler(const MachineModel& machine);

  // Both scanners sweep their whole range once, and count again from now.
  void begin_full_sweep();
  // Both have seen their whole range since begin_full_sweep.
  bool full_sweep_done() const;

  // phase: BERM_PHASE_*, the one the motion is about to enter where that is known (LIFT before a dig ends); bearings of dig and truck; measured pans, swing angle and speed.
  std::array<PanRequest, 2> step(std::uint16_t phase, double dig_bearing, double truck_bearing, double swing_angle, double swing_speed,
                                 const std::array<double, 2>& pan);

  PanSector sector(std::size_t scanner, std::uint16_t phase, double dig_bearing, double truck_bearing, double swing_angle) const;

private:
  struct Head { bool up = true; bool low_seen = false, high_seen = false; };

  MachineModel machine_;
  std::array<Head, 2> head_;
  bool far_seen_ = false;  // during this swing to the truck the leading scanner has seen the ground beyond the truck
};

}  // namespace berm::app
