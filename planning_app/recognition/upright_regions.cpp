#include "recognition/upright_regions.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

using Eigen::Vector2d;

constexpr double kAcross = 0.11;        // m, of a return from its segment's mean distance
constexpr double kRiseLeast = 0.22;     // m between the ends of a segment
constexpr double kOffLine = 0.09;       // m, of a segment from its region in plan
constexpr std::size_t kFansApart = 3;
constexpr int kSegmentsLeast = 4;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void upright_segments(FanSweep& sweep, std::size_t fan, std::vector<UprightSegment>& out) {
  const std::span<const FanReturn> returns = sweep.of(fan);
  const Vector2d head = sweep.heads[fan].head<2>();
  for (std::size_t i = 0; i < returns.size();) {
    const auto in_plan = [&](std::size_t k) -> Vector2d { return returns[k].place.head<2>().cast<double>(); };
    const auto height = [&](std::size_t k) { return static_cast<double>(returns[k].place.z()); };
    Vector2d sum = in_plan(i);
    double mean = (sum - head).norm();
    int count = 1;
    std::size_t end = i + 1;
    double low = height(i), high = low;
    for (; end < returns.size(); ++end) {
      const Vector2d at = in_plan(end);
      const double distance = (at - head).norm(), z = height(end);
      if (std::abs(distance - mean) > kAcross || std::abs(z - height(end - 1)) > 0.5 || (at - sum / count).squaredNorm() > 0.25) break;
      mean += (distance - mean) / ++count;
      sum += at;
      low = std::min(low, z);
      high = std::max(high, z);
    }
    if (count >= 3 && high - low >= kRiseLeast) {
      out.push_back({fan, sum / count, low, high, count});
      for (std::size_t k = i; k < end; ++k) sweep.returns[sweep.begin[fan] + k].upright = true;
      i = end;
    } else {
      ++i;
    }
  }
}

std::vector<UprightSegment> upright_segments(FanSweep& sweep) {
  std::vector<UprightSegment> out;
  for (std::size_t fan = 0; fan + 1 < sweep.begin.size(); ++fan) upright_segments(sweep, fan, out);
  return out;
}

void RegionGrowth::Growing::add(const UprightSegment& s) {
  const double w = s.count;
  n += w;
  sum += w * s.at;
  xx += w * s.at.x() * s.at.x();
  xy += w * s.at.x() * s.at.y();
  yy += w * s.at.y() * s.at.y();
  members.push_back(s);
}

Vector2d RegionGrowth::Growing::normal() const {
  const Vector2d m = sum / n;
  const double angle = 0.5 * std::atan2(2.0 * (xy / n - m.x() * m.y()), xx / n - m.x() * m.x() - yy / n + m.y() * m.y());
  return {-std::sin(angle), std::cos(angle)};
}

bool RegionGrowth::Growing::takes(const UprightSegment& s) const {
  const UprightSegment& last = members.back();
  if (s.fan == last.fan) return false;
  if (std::min(s.high, last.high) - std::max(s.low, last.low) < 0.0) return false;
  const double step = (s.at - last.at).norm() / static_cast<double>(s.fan - last.fan);
  if (members.size() < 3) return step < 0.45;
  return step < 1.2 && std::abs(normal().dot(s.at - sum / n)) < kOffLine;
}

void RegionGrowth::take(const UprightSegment& s) {
  std::erase_if(open_, [&](std::size_t g) { return s.fan - growing_[g].members.back().fan > kFansApart; });
  std::size_t best = growing_.size();
  double nearest = 1e9;
  for (const std::size_t g : open_) {
    if (!growing_[g].takes(s)) continue;
    const double distance = (growing_[g].members.back().at - s.at).norm();
    if (distance < nearest) nearest = distance, best = g;
  }
  if (best == growing_.size()) {
    growing_.emplace_back();
    open_.push_back(best);
  }
  growing_[best].add(s);
}

bool RegionGrowth::pauses(std::size_t newest_fan, double length) const {
  return std::any_of(open_.begin(), open_.end(), [&](std::size_t g) {
    const std::vector<UprightSegment>& members = growing_[g].members;
    const std::size_t since = newest_fan - members.back().fan;
    return since > 0 && since <= kFansApart && static_cast<int>(members.size()) >= kSegmentsLeast && (members.back().at - members.front().at).norm() >= length;
  });
}

std::vector<UprightRegion> RegionGrowth::regions(const FanSweep& sweep) const {
  std::vector<UprightRegion> out;
  for (const Growing& g : growing_) {
    if (static_cast<int>(g.members.size()) < kSegmentsLeast) continue;
    UprightRegion r;
    const Vector2d mean = g.sum / g.n;
    r.normal = g.normal();
    const Vector2d head = sweep.heads[g.members.front().fan].head<2>();
    if (r.normal.dot(head - mean) < 0.0) r.normal = -r.normal;
    const Vector2d along(-r.normal.y(), r.normal.x());
    double least = 1e9, most = -1e9;
    std::vector<double> lows, highs;
    for (const UprightSegment& s : g.members) {
      least = std::min(least, along.dot(s.at - mean));
      most = std::max(most, along.dot(s.at - mean));
      lows.push_back(s.low);
      highs.push_back(s.high);
    }
    r.first = mean + least * along;
    r.last = mean + most * along;
    r.low = median(lows);
    r.high = median(highs);
    r.count = static_cast<int>(g.n);
    r.segments = g.members;
    if (most - least > 0.5) out.push_back(r);
  }
  std::sort(out.begin(), out.end(), [](const UprightRegion& a, const UprightRegion& b) { return a.count > b.count; });
  return out;
}

std::vector<UprightRegion> upright_regions(const FanSweep& sweep, const std::vector<UprightSegment>& segments) {
  RegionGrowth growth;
  for (const UprightSegment& s : segments) growth.take(s);
  return growth.regions(sweep);
}

}  // namespace berm::app
