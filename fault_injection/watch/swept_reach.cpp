#include "watch/swept_reach.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace berm::watch {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double same_rad = 0.002;  // an interval that is narrower is taken by its middle alone

// The turn of the interval that is nearest to a bearing, whole turns aside.
double nearest_swing(double low, double high, double bearing) {
  const double middle = 0.5 * (low + high);
  const double off = std::remainder(bearing - middle, 2.0 * pi);
  return std::clamp(middle + off, low, high);
}

std::vector<double> stations(double low, double high) {
  if (high - low < same_rad) return {0.5 * (low + high)};
  return {low, 0.5 * (low + high), high};
}

bool may_meet(const plant::oracle::Body& a, const plant::oracle::Body& b) { return (a.middle - b.middle).norm() <= a.reach + b.reach; }

}  // namespace

double SweptReach::distance(const std::array<double, 4>& joints, const plant::oracle::Body& body) const {
  double least = 1e9;
  const auto machine = oracle_.machine(joints);
  for (std::size_t i = 0; i < implements_; ++i) {
    if ((machine[i].middle - body.middle).norm() - machine[i].reach - body.reach >= least) continue;
    const auto found = plant::oracle::distance(machine[i], body);
    least = std::min(least, found.meet() ? 0.0 : found.upper);
  }
  return least;
}

bool SweptReach::meets(const std::array<double, 4>& joints, const plant::oracle::Body& body) const {
  const auto machine = oracle_.machine(joints);
  for (std::size_t i = 0; i < implements_; ++i)
    if (may_meet(machine[i], body) && plant::oracle::distance(machine[i], body).meet()) return true;
  return false;
}

bool SweptReach::holds(const ReachBox& box, const plant::oracle::Body& body) const {
  std::vector<double> swings{nearest_swing(box.low[0], box.high[0], std::atan2(body.middle.y(), body.middle.x()))};
  for (const auto& corner : body.corner) swings.push_back(nearest_swing(box.low[0], box.high[0], std::atan2(corner.y(), corner.x())));
  for (const double boom : stations(box.low[1], box.high[1]))
    for (const double stick : stations(box.low[2], box.high[2]))
      for (const double bucket : stations(box.low[3], box.high[3]))
        for (const double swing : swings)
          if (meets({swing, boom, stick, bucket}, body)) return true;
  return false;
}

}  // namespace berm::watch
