// The recorder: a read-only peer of the kernel. Drains every decision from the state segment, counts stops and faults, and keeps
// snapshots (map, slices) for the picture. It can neither delay nor change the kernel.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "contract/berm_contract.h"

namespace berm::run {

struct MapSnapshot {
  double cell_m = 0.0;
  double origin_m = 0.0;  // x and y of the low corner
  std::vector<std::int32_t> height_mm;  // [iy * BERM_MAP_CELLS + ix]
  std::vector<std::uint8_t> status;     // BERM_CELL_*
};

struct SliceSnapshot {
  std::vector<berm_slice> slices;
  double swing_speed_rad_s = 0.0;
  double time_s = 0.0;
};

// The machine left RUN: when, why, and the cell that blocked (for reasons that have one).
struct StopEvent { double time_s; std::string reason; bool has_place; double x_m, y_m, height_m; };

struct BucketPoint { double time_s; std::array<double, 4> angle_rad; std::uint8_t kernel_state; };

class Recorder {
 public:
  Recorder() = default;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  ~Recorder();

  // Connects to the kernel's socket and maps the state segment read-only; throws std::runtime_error with the kernel's reason.
  void connect(const std::string& socket_path);
  // Waits for the kernel's next cycle, at most this long, and takes all new decisions.
  void poll(double seconds);

  const berm_state_segment* segment() const { return segment_; }
  MapSnapshot map() const;
  // The swept volume at the moment of the fastest swing so far.
  const SliceSnapshot& fastest_swing() const { return fastest_; }
  const std::vector<BucketPoint>& path() const { return path_; }
  // Of the newest decision. In real time the kernel's clock began before the run: times then count from the first decision.
  double time_s() const { return seconds(last_); }
  void count_from_first_decision() { from_first_ = true; }
  const berm_decision& last() const { return last_; }
  std::uint64_t decisions() const { return decisions_; }
  std::uint64_t lost() const { return lost_; }
  const std::map<std::string, int>& stops() const { return stops_; }   // RUN left, by reason
  const std::vector<StopEvent>& stop_events() const { return stop_events_; }
  int faults() const { return faults_; }                               // FAULT entered
  std::string first_fault() const { return first_fault_; }

 private:
  double seconds(const berm_decision& d) const { return static_cast<double>(d.time_us - origin_us_) * 1e-6; }
  void take(const berm_decision& d);
  void snapshot_slices(double speed);

  int socket_ = -1;
  const berm_state_segment* segment_ = nullptr;
  std::uint32_t next_ = 0;
  std::uint64_t decisions_ = 0;
  std::uint64_t lost_ = 0;
  bool from_first_ = false;
  std::int64_t origin_us_ = 0;
  berm_decision last_{};
  std::map<std::string, int> stops_;
  std::vector<StopEvent> stop_events_;
  int faults_ = 0;
  std::string first_fault_;
  SliceSnapshot fastest_;
  std::vector<BucketPoint> path_;
};

}  // namespace berm::run
