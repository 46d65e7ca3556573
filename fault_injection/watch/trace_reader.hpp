// A run's trace.csv, a row at a time.
#pragma once

#include <array>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "plant/world/world.hpp"

namespace berm::watch {

class TraceReader {
 public:
  // Throws std::runtime_error naming the file when it cannot be read.
  explicit TraceReader(const std::string& path);
  // Goes on to the first row at or after a time; false when there is none any more.
  bool seek(double time_s);
  double time_s() const { return value("time_s"); }
  plant::JointState joints() const;
  // Of a person, vehicle or truck.
  plant::MoverPose pose(const std::string& name) const;
  // Of all people, vehicles and trucks, in the order of the columns.
  std::vector<std::string> movers() const;
  // Throws std::runtime_error naming file and column when there is none of that name.
  double value(const std::string& column) const;

 private:
  std::string path_;
  std::ifstream file_;
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> column_;
  std::vector<double> row_;
};

}  // namespace berm::watch
