#include "run/own_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace berm::run {

namespace {

// Half a body and a cell of the kernel's map: whoever comes is told of with his front, when his middle is not in the region yet.
constexpr double kSamePlace_m = 1.0;
// Times of plant and kernel are multiples of the cycle, in floating point.
constexpr double kRounding_s = 1e-6;

bool somebody_near(const std::vector<TraceRow>& rows, double from_s, const StopEvent& stop, double radius_m) {
  const auto near = [&](const std::array<double, 2>& at) {
    return std::hypot(at[0], at[1]) < radius_m || (stop.has_place && std::hypot(at[0] - stop.x_m, at[1] - stop.y_m) < kSamePlace_m);
  };
  return std::any_of(rows.begin(), rows.end(), [&](const TraceRow& row) {
    return row.time_s >= from_s && row.time_s <= stop.time_s && std::any_of(row.intruder.begin(), row.intruder.end(), near);
  });
}

}  // namespace

std::vector<Disturbance> disturbances_of(const nlohmann::json& truth, const RunOptions& options) {
  constexpr double kForGood = std::numeric_limits<double>::infinity();
  std::vector<Disturbance> all;
  if (options.fault) all.push_back({options.fault->at_s, kForGood});
  if (!truth.contains("disturbances")) return all;
  for (const auto& one : truth["disturbances"]) {
    const bool ends = one.contains("to_s") && one["to_s"].is_number();
    all.push_back({one.value("from_s", 0.0), ends ? one["to_s"].get<double>() : kForGood});
  }
  return all;
}

std::map<std::string, int> own_motion_stops(const std::vector<StopEvent>& stops, const std::vector<Disturbance>& disturbances,
                                            const std::vector<TraceRow>& rows, double radius_m, double memory_s) {
  std::map<std::string, int> own;
  for (const StopEvent& stop : stops) {
    const bool disturbed = std::any_of(disturbances.begin(), disturbances.end(),
                                       [&](const Disturbance& d) { return d.from_s - kRounding_s <= stop.time_s && stop.time_s <= d.to_s + memory_s + kRounding_s; });
    if (!disturbed && !somebody_near(rows, stop.time_s - memory_s, stop, radius_m)) ++own[stop.reason];
  }
  return own;
}

}  // namespace berm::run
