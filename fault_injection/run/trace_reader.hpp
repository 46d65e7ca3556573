// A run's trace.csv, a row at a time. SI units, radians; columns as in scenarios/FORMAT.md.
#pragma once

#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace berm::run {

// Of a mover's name: trucks have the names that nobody else may have.
inline bool is_truck(const std::string& mover) { return mover.starts_with("truck"); }

class TraceReader {
 public:
  // Throws std::runtime_error naming the file when it cannot be read.
  explicit TraceReader(const std::string& path);
  // The next row at or after a time; false when there is none any more. Throws std::runtime_error when it has not a number for every column.
  bool next(double from_s = -std::numeric_limits<double>::infinity());
  // The row that stands, when it is at or after the time already, or the next that is.
  bool seek(double time_s);
  double time_s() const { return value("time_s"); }
  // Of all people, vehicles and trucks, in the order of the columns.
  std::vector<std::string> movers() const;
  bool has(const std::string& column) const { return column_.contains(column); }
  // Throws std::runtime_error naming file and column when there is none of that name.
  double value(const std::string& column) const;

 private:
  std::string path_;
  std::ifstream file_;
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> column_;
  std::vector<double> row_;
};

}  // namespace berm::run
