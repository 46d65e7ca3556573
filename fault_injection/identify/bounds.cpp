#include "identify/bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace berm::identify {

namespace {

constexpr double kDegree = 180.0 / std::numbers::pi;
constexpr std::size_t kColumns = 8;
constexpr double kCycle_s = 0.01;        // a command comes at any moment of the machine's cycle; in lockstep always at the same
constexpr double kSpeedMissed = 0.95;    // a held speed below this share of the column's was not that speed
constexpr long kLeastWindow = 5;         // cycles
// The grid of the file.
constexpr double kAngleGrid_deg = 0.01, kTimeGrid_s = 0.001, kLatencyGrid_s = 0.01, kAccelerationGrid = 0.01;

double rounded_up(double x, double grid) { return x <= 0.0 ? 0.0 : std::ceil(x / grid - 1e-6) * grid; }

double column_speed(const config::MachineFile& m, std::size_t joint, std::size_t column) {
  return m.joint[joint].velocity_max * static_cast<double>(column) / static_cast<double>(kColumns - 1);
}

using Row = std::vector<TableEntry>;

void take(TableEntry& entry, const StopBound& bound, const StopRecord& stop, double speed) {
  entry.slowest_speed = entry.runs == 0 ? stop.held_speed : std::min(entry.slowest_speed, stop.held_speed);
  ++entry.runs;
  entry.measured_angle = std::max(entry.measured_angle, bound.measured_angle);
  entry.measured_time = std::max(entry.measured_time, bound.measured_time);
  entry.angle = std::max(entry.angle, bound.angle);
  entry.time = std::max(entry.time, bound.time);
  entry.extrapolated = entry.extrapolated || stop.held_speed < kSpeedMissed * speed;
}

// Columns that no run was for: a lower one is covered by the next higher, a higher one goes on with the square of the speed.
void fill(Row& row) {
  std::size_t highest = 0;
  for (std::size_t k = 1; k < kColumns; ++k)
    if (row[k].runs > 0) highest = k;
  for (std::size_t k = highest; k-- > 1;) {
    if (row[k].runs > 0) continue;
    row[k].angle = row[k + 1].angle;
    row[k].time = row[k + 1].time;
    row[k].extrapolated = row[k + 1].extrapolated;
  }
  for (std::size_t k = highest + 1; k < kColumns; ++k) {
    const double ratio = static_cast<double>(k) / static_cast<double>(highest);
    row[k].angle = row[highest].angle * ratio * ratio;
    row[k].time = row[highest].time * ratio;
    row[k].extrapolated = true;
  }
}

void raise(TableEntry& entry, const TableEntry& least) {
  entry.angle = std::max(entry.angle, least.angle);
  entry.time = std::max(entry.time, least.time);
}

void make_monotone(std::vector<Row>& rows) {
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t k = 1; k < kColumns; ++k) {
      raise(rows[r][k], rows[r][k - 1]);
      if (r > 0) raise(rows[r][k], rows[r - 1][k]);
    }
  }
}

bool measured(const Row& row) {
  return std::any_of(row.begin(), row.end(), [](const TableEntry& e) { return e.runs > 0; });
}

// Largest bound of the stops from halfway below a column, with the allowance; 0 without one.
double needed_between(const config::MachineFile& m, const std::vector<BenchRecord>& runs, std::size_t joint, std::size_t row, std::size_t column,
                      const Bounds& bounds, double allowance) {
  double needed = 0.0;
  for (const BenchRecord& run : runs) {
    for (const StopRecord& stop : run.stops) {
      const StopPlan& plan = stop.plan;
      if (plan.joint != joint || !plan.between || plan.column != column || (joint == swing && plan.row != row)) continue;
      const double after = bounds.earliest_obeyed[joint][static_cast<std::size_t>(plan.manner)];
      needed = std::max(needed, (1.0 + allowance) * stop_bound(m, stop, after, plan.speed).angle);
    }
  }
  return needed;
}

// From the slowest column up: to raise one raises the chord above it too.
void raise_to_chords(const config::MachineFile& m, const std::vector<BenchRecord>& runs, std::size_t joint, const Bounds& bounds, double allowance,
                     std::vector<Row>& rows) {
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t k = 1; k < kColumns; ++k) {
      TableEntry& upper = rows[r][k];
      const double chord = 0.5 * (rows[r][k - 1].angle + upper.angle), needed = needed_between(m, runs, joint, r, k, bounds, allowance);
      if (chord > 0.0) upper.between_share = needed / chord;
      if (needed > chord) upper.angle = rounded_up((upper.angle + 2.0 * (needed - chord)) * kDegree, kAngleGrid_deg) / kDegree;
    }
  }
}

std::vector<Row> table_of(const config::MachineFile& m, const std::vector<BenchRecord>& runs, std::size_t joint, const Bounds& bounds, double allowance) {
  const std::size_t reaches = m.braking.reach.size();
  std::vector<Row> rows(reaches, Row(kColumns));
  for (const BenchRecord& run : runs) {
    for (const StopRecord& stop : run.stops) {
      if (stop.plan.joint != joint || stop.plan.between) continue;
      const double speed = column_speed(m, joint, stop.plan.column);
      const double after = bounds.earliest_obeyed[joint][static_cast<std::size_t>(stop.plan.manner)];
      const StopBound bound = stop_bound(m, stop, after, speed);
      for (std::size_t r = 0; r < reaches; ++r)
        if (joint != swing || r == stop.plan.row) take(rows[r][stop.plan.column], bound, stop, speed);
    }
  }
  for (Row& row : rows)
    if (measured(row)) fill(row);
  for (std::size_t r = reaches; r-- > 0;) {  // a reach that no pose has is covered by the next one
    if (!measured(rows[r]) && r + 1 < reaches) rows[r] = rows[r + 1];
  }
  for (std::size_t r = 1; r < reaches; ++r) {  // beyond the farthest pose there is none
    if (!measured(rows[r])) rows[r] = rows[r - 1];
  }
  for (Row& row : rows) {
    for (TableEntry& entry : row) {
      entry.angle = rounded_up(entry.angle * (1.0 + allowance) * kDegree, kAngleGrid_deg) / kDegree;
      entry.time = rounded_up(entry.time * (1.0 + allowance), kTimeGrid_s);
    }
  }
  make_monotone(rows);
  raise_to_chords(m, runs, joint, bounds, allowance, rows);
  make_monotone(rows);
  return rows;
}

// The faster the joint, the sharper the moment is seen: where there are fast stops, slow ones are not asked.
void find_obeyed(const config::MachineFile& m, const std::vector<BenchRecord>& runs, Bounds& bounds, bool& any) {
  std::array<std::array<bool, kManners>, 4> seen{};
  std::array<double, 4> fastest{};
  for (const BenchRecord& run : runs)
    for (const StopRecord& stop : run.stops)
      if (stop.obeyed_s) fastest[stop.plan.joint] = std::max(fastest[stop.plan.joint], stop.held_speed);
  for (const BenchRecord& run : runs) {
    for (const StopRecord& stop : run.stops) {
      if (!stop.obeyed_s || stop.held_speed < std::min(0.5 * m.joint[stop.plan.joint].velocity_max, 0.9 * fastest[stop.plan.joint])) continue;
      const double after = *stop.obeyed_s - stop.sent_s;
      const auto manner = static_cast<std::size_t>(stop.plan.manner);
      double& earliest = bounds.earliest_obeyed[stop.plan.joint][manner];
      earliest = seen[stop.plan.joint][manner] ? std::min(earliest, after) : after;
      seen[stop.plan.joint][manner] = true;
      bounds.latest_obeyed = std::max(bounds.latest_obeyed, after);
      any = true;
    }
  }
}

// Of the speeds of all runs of each test.
double largest_acceleration(const config::MachineFile& m, const std::vector<BenchRecord>& runs, std::size_t joint, std::size_t window) {
  std::map<std::array<long, 5>, std::vector<const Speeds*>> tests;
  for (const BenchRecord& run : runs) {
    for (const StopRecord& s : run.stops)
      if (s.plan.joint == joint)
        tests[{0, s.loaded, static_cast<long>(s.plan.station), static_cast<long>(s.plan.column), s.plan.direction > 0.0}].push_back(&s.approach);
    for (const ReversalRecord& r : run.reversals)
      if (r.joint == joint) tests[{1, r.loaded, 0, r.sevenths, 0}].push_back(&r.speeds);
  }
  double largest = 0.0;
  for (const auto& [test, speeds] : tests) largest = std::max(largest, steepest(mean_speeds(speeds), window, m.joint[joint].velocity_error));
  return largest;
}

}  // namespace

StopBound stop_bound(const config::MachineFile& machine, const StopRecord& stop, double obeyed_after, double speed) {
  const auto& joint = machine.joint[stop.plan.joint];
  const double obeyed = stop.sent_s + obeyed_after;
  StopBound bound{};
  bound.measured_angle = std::max(0.0, stop.farthest_angle - angle_at(stop, obeyed));
  bound.measured_time = std::max(0.0, stop.rest_s - obeyed);
  const double least_speed = std::max(stop.held_speed - joint.velocity_error, 0.25 * stop.held_speed);
  const double ratio = std::max(1.0, speed / least_speed);
  bound.angle = (bound.measured_angle + 2.0 * joint.angle_error) * ratio * ratio;
  bound.time = bound.measured_time * ratio;
  return bound;
}

Bounds bounds_of(const config::MachineFile& machine, const std::vector<BenchRecord>& runs, const std::vector<std::size_t>& joints, double allowance) {
  Bounds bounds;
  bool any = false;
  find_obeyed(machine, runs, bounds, any);
  if (any) bounds.command_latency = rounded_up(bounds.latest_obeyed * (1.0 + allowance) + kCycle_s, kLatencyGrid_s);
  const double command = bounds.command_latency && joints.size() == 4 ? *bounds.command_latency : machine.command_latency;
  const auto window = static_cast<std::size_t>(std::max(kLeastWindow, std::lround((machine.state_latency + machine.kernel.cycle + command) / kCycle_s)));
  bounds.window_s = static_cast<double>(window) * kCycle_s;
  for (const BenchRecord& run : runs)
    for (std::size_t j = 0; j < 4; ++j) bounds.fastest_reading[j] = std::max(bounds.fastest_reading[j], run.fastest_reading[j]);
  for (const std::size_t j : joints) {
    const auto& joint = machine.joint[j];
    if (bounds.fastest_reading[j] > joint.velocity_max + joint.velocity_error)
      throw std::runtime_error(fmt::format("{}: moved at {:.2f} deg/s, faster than velocity_max_deg_s of the machine file ({:.2f}) and its error bound allow",
                                           config::kJointNames[j],
                                           bounds.fastest_reading[j] * kDegree, joint.velocity_max * kDegree));
    bounds.largest_acceleration[j] = largest_acceleration(machine, runs, j, window);
    bounds.acceleration[j] = rounded_up(bounds.largest_acceleration[j] * (1.0 + allowance), kAccelerationGrid);
    bounds.table[j] = table_of(machine, runs, j, bounds, allowance);
  }
  return bounds;
}

}  // namespace berm::identify
