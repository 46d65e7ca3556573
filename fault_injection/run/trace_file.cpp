#include "run/trace_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace berm::run {

namespace {

constexpr const char* kJointColumns[] = {"swing_rad", "boom_rad", "stick_rad", "bucket_rad"};
constexpr double kRounding_s = 1e-6;

std::size_t column_of(const std::vector<std::string>& names, const std::string& name, const std::string& path) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) throw std::runtime_error(path + ": " + name + ": no such column");
  return static_cast<std::size_t>(at - names.begin());
}

}  // namespace

std::vector<TraceRow> read_trace(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error(path + ": cannot be read");
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  const std::size_t time = column_of(names, "time_s", path);
  std::array<std::size_t, 4> joint{};
  for (std::size_t j = 0; j < joint.size(); ++j) joint[j] = column_of(names, kJointColumns[j], path);
  std::vector<std::size_t> intruders;
  for (std::size_t i = 0; i + 1 < names.size(); ++i)
    if (names[i].ends_with("_x_m") && !names[i].starts_with("truck")) intruders.push_back(i);
  std::vector<TraceRow> rows;
  std::vector<double> value;
  while (std::getline(file, line)) {
    value.clear();
    const char* at = line.c_str();
    for (char* end = nullptr; *at != '\0'; at = *end == ',' ? end + 1 : end) {
      value.push_back(std::strtod(at, &end));
      if (end == at) throw std::runtime_error(path + ": row " + std::to_string(rows.size() + 1) + ": no number");
    }
    if (value.size() != names.size()) throw std::runtime_error(path + ": row " + std::to_string(rows.size() + 1) + ": not as many values as columns");
    TraceRow row{value[time], {}, {}};
    for (std::size_t j = 0; j < joint.size(); ++j) row.angle[j] = value[joint[j]];
    for (const std::size_t i : intruders) row.intruder.push_back({value[i], value[i + 1]});
    rows.push_back(std::move(row));
  }
  return rows;
}

const TraceRow& row_at(const std::vector<TraceRow>& rows, double time_s) {
  const auto at = std::lower_bound(rows.begin(), rows.end(), time_s - kRounding_s, [](const TraceRow& row, double t) { return row.time_s < t; });
  return at == rows.end() ? rows.back() : *at;
}

}  // namespace berm::run
