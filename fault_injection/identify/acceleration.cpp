#include "identify/acceleration.hpp"

#include <algorithm>

namespace berm::identify {

namespace {

constexpr double kCycle_s = 0.01;
constexpr std::size_t kEnd = 3;  // readings averaged at each end of a window in which the motion turns round

double line_slope(const double* v, std::size_t count) {
  const double middle = static_cast<double>(count - 1) / 2.0;
  double weight = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i) - middle;
    weight += x * x;
    sum += x * v[i];
  }
  return sum / weight / kCycle_s;
}

double turned_gain(const double* v, std::size_t count) {
  double begin = 0.0, end = 0.0;
  for (std::size_t i = 0; i < kEnd; ++i) {
    begin += v[i] / kEnd;
    end += v[count - 1 - i] / kEnd;
  }
  return (end - begin) / (kCycle_s * static_cast<double>(count - kEnd));
}

}  // namespace

std::vector<double> mean_speeds(const std::vector<const Speeds*>& runs) {
  if (runs.empty()) return {};
  std::size_t length = runs.front()->size();
  for (const Speeds* run : runs) length = std::min(length, run->size());
  std::vector<double> mean(length);
  for (std::size_t i = 0; i < length; ++i)
    for (const Speeds* run : runs) mean[i] += (*run)[i] / static_cast<double>(runs.size());
  return mean;
}

double steepest(const std::vector<double>& speeds, std::size_t window, double speed_error) {
  const std::size_t count = window + 1;
  double largest = 0.0;
  for (std::size_t begin = 0; begin + count <= speeds.size(); ++begin) {
    const double* v = &speeds[begin];
    if (v[count - 1] <= speed_error) continue;
    const bool turns = std::any_of(v, v + count, [&](double x) { return x < -speed_error; });
    largest = std::max(largest, turns ? turned_gain(v, count) : line_slope(v, count));
  }
  return largest;
}

}  // namespace berm::identify
