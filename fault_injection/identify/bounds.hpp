// From measured stops to what the machine file may say: bounds, never estimates.
//
// A stop's time runs from the moment from which the joint obeys it. That moment is seen by a line through the falling speeds; for a joint and a
// manner of stopping the earliest seen in any run is taken for all, so that no part of a stop is left out, and the latest enters the command latency.
// What the table leaves to the latency the kernel adds as travel at the full speed before the stop: the two together cover the whole way.
//
//   angle = (largest reading after the stop - reading at that moment + 2 angle errors) (v / (held speed - speed error))^2, the square when above 1
//   time  = (bound of the standstill - that moment) v / (held speed - speed error), the ratio when above 1
//
// with v the column's speed; then the largest over all runs, the allowance on top, rounded up, never falling with speed or reach.
// Between two columns the kernel takes the angle on the chord. Stops from halfway between them are held against it, by the same bound and with the
// allowance; where one needs more, the upper column is raised by twice that.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "config/machine_file.hpp"
#include "identify/bench_run.hpp"

namespace berm::identify {

struct TableEntry {
  double angle = 0.0, time = 0.0;                    // bounds, rad and s
  double measured_angle = 0.0, measured_time = 0.0;  // largest measured at this column, without errors, scaling and allowance; 0 when runs is 0
  double slowest_speed = 0.0;                        // least held speed of its runs, rad/s
  int runs = 0;
  bool extrapolated = false;                         // from a lower speed, with its square
  double between_share = 0.0;                        // largest bound of a stop from halfway below, of the chord before it was raised; 0 without one
};

struct Bounds {
  // [joint][row][column]; empty for a joint that was not tested
  std::array<std::vector<std::vector<TableEntry>>, 4> table;
  std::array<std::optional<double>, 4> acceleration;  // rad/s2
  std::optional<double> command_latency;              // s
  double latest_obeyed = 0.0;                         // s after the command, of all stops in which it was seen; as measured
  std::array<std::array<double, kManners>, 4> earliest_obeyed{};  // s after the command
  double window_s = 0.0;                              // over which the acceleration is taken: the time for which the kernel lets it act
  std::array<double, 4> largest_acceleration{}, fastest_reading{};
};

// Throws std::runtime_error when the machine was faster than the machine file's velocity_max.
Bounds bounds_of(const config::MachineFile& machine, const std::vector<BenchRecord>& runs, const std::vector<std::size_t>& joints, double allowance);

// A stop's share of an entry: what was measured, and the bound for the column's speed, both without allowance.
struct StopBound { double measured_angle, measured_time, angle, time; };
StopBound stop_bound(const config::MachineFile& machine, const StopRecord& stop, double obeyed_after, double column_speed);

}  // namespace berm::identify
