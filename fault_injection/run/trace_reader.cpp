#include "run/trace_reader.hpp"

#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "config/one_line.hpp"

namespace berm::run {

namespace {
constexpr double kTraceRounding_s = 1e-6;
const std::string kPlaceEnding = "_x_m";
}  // namespace

TraceReader::TraceReader(const std::string& path) : path_(path), file_(path) {
  std::string line, cell;
  if (!std::getline(file_, line)) throw std::runtime_error(path + ": cannot be read");
  for (std::istringstream header(line); std::getline(header, cell, ',');) {
    column_[cell] = names_.size();
    names_.push_back(cell);
  }
}

bool TraceReader::next(double from_s) {
  std::string line;
  while (std::getline(file_, line)) {
    if (std::strtod(line.c_str(), nullptr) < from_s - kTraceRounding_s) continue;
    row_.clear();
    const char* at = line.c_str();
    for (char* end = nullptr; row_.size() < names_.size(); at = *end == ',' ? end + 1 : end) {
      row_.push_back(std::strtod(at, &end));
      if (end == at) throw std::runtime_error(path_ + ": a row that is not of numbers: " + config::excerpt(line));
    }
    return true;
  }
  return false;
}

bool TraceReader::seek(double time_s) { return (!row_.empty() && this->time_s() > time_s - kTraceRounding_s) || next(time_s); }

double TraceReader::value(const std::string& column) const {
  const auto found = column_.find(column);
  if (found == column_.end() || found->second >= row_.size()) throw std::runtime_error(path_ + ": no column " + column);
  return row_[found->second];
}

std::vector<std::string> TraceReader::movers() const {
  std::vector<std::string> all;
  for (const auto& name : names_)
    if (name.ends_with(kPlaceEnding)) all.push_back(name.substr(0, name.size() - kPlaceEnding.size()));
  return all;
}

}  // namespace berm::run
