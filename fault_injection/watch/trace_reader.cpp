#include "watch/trace_reader.hpp"

#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace berm::watch {

namespace {
constexpr double rounding_s = 1e-6;
constexpr std::array<const char*, 4> joint_names{"swing", "boom", "stick", "bucket"};
const std::string place_ending = "_x_m";
}  // namespace

TraceReader::TraceReader(const std::string& path) : path_(path), file_(path) {
  std::string line, cell;
  if (!std::getline(file_, line)) throw std::runtime_error(path + ": cannot be read");
  for (std::istringstream header(line); std::getline(header, cell, ',');) {
    column_[cell] = names_.size();
    names_.push_back(cell);
  }
}

bool TraceReader::seek(double time_s) {
  if (!row_.empty() && this->time_s() > time_s - rounding_s) return true;
  std::string line;
  while (std::getline(file_, line)) {
    if (std::strtod(line.c_str(), nullptr) < time_s - rounding_s) continue;
    row_.clear();
    const char* at = line.c_str();
    for (char* end = nullptr; row_.size() < names_.size(); at = *end == ',' ? end + 1 : end) {
      row_.push_back(std::strtod(at, &end));
      if (end == at) throw std::runtime_error(path_ + ": a row that is not of numbers: " + line.substr(0, 60));
    }
    return true;
  }
  return false;
}

double TraceReader::value(const std::string& column) const {
  const auto found = column_.find(column);
  if (found == column_.end() || found->second >= row_.size()) throw std::runtime_error(path_ + ": no column " + column);
  return row_[found->second];
}

plant::JointState TraceReader::joints() const {
  plant::JointState state;
  for (std::size_t j = 0; j < joint_names.size(); ++j) {
    state.angle[j] = value(std::string(joint_names[j]) + "_rad");
    state.velocity[j] = value(std::string(joint_names[j]) + "_rad_s");
  }
  return state;
}

plant::MoverPose TraceReader::pose(const std::string& name) const {
  return {name, value(name + "_x_m"), value(name + "_y_m"), value(name + "_z_m"), value(name + "_yaw_rad"), false};
}

std::vector<std::string> TraceReader::movers() const {
  std::vector<std::string> all;
  for (const auto& name : names_)
    if (name.ends_with(place_ending)) all.push_back(name.substr(0, name.size() - place_ending.size()));
  return all;
}

}  // namespace berm::watch
