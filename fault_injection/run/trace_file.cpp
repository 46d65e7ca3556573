#include "run/trace_file.hpp"

#include <algorithm>

#include "run/trace_reader.hpp"

namespace berm::run {

namespace {

constexpr std::array<const char*, 4> kJointColumns{"swing_rad", "boom_rad", "stick_rad", "bucket_rad"};
constexpr double kRounding_s = 1e-6;

}  // namespace

std::vector<TraceRow> read_trace(const std::string& path) {
  TraceReader trace(path);
  std::vector<std::string> intruders = trace.movers();
  std::erase_if(intruders, is_truck);
  const bool trams = trace.has("base_x");
  std::vector<TraceRow> rows;
  while (trace.next()) {
    TraceRow row{trace.time_s(), {}, {}};
    for (std::size_t j = 0; j < row.angle.size(); ++j) row.angle[j] = trace.value(kJointColumns[j]);
    const double base_x = trams ? trace.value("base_x") : 0.0, base_y = trams ? trace.value("base_y") : 0.0;
    for (const std::string& name : intruders) row.intruder.push_back({trace.value(name + "_x_m") - base_x, trace.value(name + "_y_m") - base_y});
    rows.push_back(std::move(row));
  }
  return rows;
}

const TraceRow& row_at(const std::vector<TraceRow>& rows, double time_s) {
  const auto at = std::lower_bound(rows.begin(), rows.end(), time_s - kRounding_s, [](const TraceRow& row, double t) { return row.time_s < t; });
  return at == rows.end() ? rows.back() : *at;
}

}  // namespace berm::run
