// Faults and latching stops of one cycle: what the stop logic is told beyond the motion check.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "core/stop_logic.h"
#include "io/frame_intake.hpp"
#include "io/lidar_intake.hpp"
#include "io/scan_health.hpp"
#include "io/sight_watch.hpp"

namespace berm::kernel {

// How long ago the app last said something usable.
struct AppPulse {
  bool heard = false;             // since start
  std::int64_t last_accept_us = 0;
  bool holds(std::int64_t now_us, std::int32_t hold_us) const { return heard && now_us - last_accept_us >= hold_us; }
};

// Standstill: measured speeds under the limit for long enough. Without fresh frames: the braking table's time for the last known speeds has
// passed, with all latencies, under zero commands.
class StandstillWatch {
 public:
  bool check(const std::int32_t (&velocity_urad_s)[4], bool fresh, const berm_parameters& parameters, std::int64_t now_us);
  bool moving() const { return moving_; }  // in the newest check

 private:
  bool moving_ = true;
  std::int64_t moved_us_ = -1;
  std::int64_t stands_us_ = -1;  // at the latest, from the last fresh frames
};

// The panning scanners, and the lidars on the upper body.
struct RangeSensors {
  const ScanHealth& scans;
  const LidarIntake& lidars;
  const SightWatch& sight;
  bool all_heard() const { return scans.both_heard() && lidars.all_heard(); }
  bool silent(std::int64_t now_us, std::int32_t limit_us) const { return scans.silent(now_us, limit_us) || lidars.silent(now_us, limit_us); }
};

// Everything the motion needs was heard and is alive.
bool inputs_ready(const FrameIntake& frames, const RangeSensors& sensors, const berm_parameters& parameters, std::int64_t now_us);

// Fills fault_reason, fault_category_0, latch_reason, latch_category_0.
void supervise(const FrameIntake& frames, const RangeSensors& sensors, const AppPulse& app, bool clock_fault, const berm_parameters& parameters,
               sk_stop_input& in);

}  // namespace berm::kernel
