// The plant's trace.csv, for what is computed of a run after its end. SI units, radians; columns as in scenarios/FORMAT.md.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace berm::run {

struct TraceRow {
  double time_s;
  std::array<double, 4> angle;                 // swing, boom, stick, bucket
  std::vector<std::array<double, 2>> intruder; // x, y of each person and vehicle, from the swing axis
};

// Throws std::runtime_error with one line when the file is missing or has not the columns.
std::vector<TraceRow> read_trace(const std::string& path);

// The row at a time: the first not before it, or the last. rows: not empty.
const TraceRow& row_at(const std::vector<TraceRow>& rows, double time_s);

}  // namespace berm::run
