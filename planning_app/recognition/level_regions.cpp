#include "recognition/level_regions.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLevelOff = 0.05;                          // m, of a return from its segment's line
constexpr double kLevelSlope = 0.3;                         // rise over run of a segment: a floor on sloping ground, a sheet that rises over a cab
constexpr double kLevelGap = 0.85;                          // m between a segment's returns: rays that graze
constexpr double kOffRegion = 0.06, kOffYoung = 0.15;        // m, of a segment from its region's plane; of a region of one or two
constexpr float kSegmentsApart = 1.2F;                     // m, in plan, between a region's newest segment and the next
constexpr std::size_t kLevelFansApart = 3, kYoung = 3, kLevelSegmentsLeast = 3;
constexpr int kLevelReturnsLeast = 8;
constexpr double kFlatter = 0.01;                           // m2: a region of few fans does not tilt across them
constexpr double kFlat = 1e-6;                               // m2: the same of one that is whole
constexpr double kSteepestRegion = 0.8;                     // rise over run
constexpr double kOfBed = 5.7, kSamePlace = 0.8;             // m: half of the longest bed, a canopy, and that
constexpr double kRangeNoise = 0.03;                        // m

// Rise with x and y of the plane of least squares through the mean.
Vector2d rises(const PlaneSums& s, double flatter) {
  const Vector3d mean = s.first / s.n;
  Matrix2d around = s.second.topLeftCorner<2, 2>() - s.n * mean.head<2>() * mean.head<2>().transpose();
  around.diagonal().array() += flatter;
  return around.inverse() * (s.second.block<2, 1>(0, 2) - s.n * mean.z() * mean.head<2>());
}

}  // namespace

void PlaneSums::add(const Vector3d& at) {
  n += 1.0;
  first += at;
  second += at * at.transpose();
}

void PlaneSums::add(const PlaneSums& more) {
  n += more.n;
  first += more.first;
  second += more.second;
}

void level_segments(const FanSweep& sweep, std::size_t fan, const LevelPlace& place, std::vector<LevelSegment>& out) {
  const std::span<const FanReturn> returns = sweep.of(fan);
  const Eigen::Vector2f middle = place.middle.cast<float>(), head = sweep.heads[fan].head<2>().cast<float>();
  const auto square = static_cast<float>(place.radius * place.radius);
  const auto may_be = [&](std::size_t k) { return !returns[k].upright && (returns[k].place.head<2>() - middle).squaredNorm() < square; };
  const auto distance_of = [&](std::size_t k) { return static_cast<double>((returns[k].place.head<2>() - head).norm()); };
  for (std::size_t i = 0; i < returns.size();) {
    if (!may_be(i)) {
      ++i;
      continue;
    }
    // The line's sums, of distance and height from the first return.
    const double start_distance = distance_of(i), start_height = static_cast<double>(returns[i].place.z());
    double d1 = 0.0, z1 = 0.0, dd = 0.0, dz = 0.0, count = 1.0, before = 0.0;
    std::size_t end = i + 1;
    for (; end < returns.size() && may_be(end); ++end) {
      const double d = distance_of(end) - start_distance, z = static_cast<double>(returns[end].place.z()) - start_height;
      if (std::abs(d - before) > kLevelGap) break;
      const double along = dd - d1 * d1 / count, slope = count < 2.0 ? 0.0 : std::clamp((dz - d1 * z1 / count) / (along + kFlatter), -kLevelSlope, kLevelSlope);
      const double expected = (z1 + slope * (count * d - d1)) / count;
      if (std::abs(z - expected) > kLevelOff + (count < 2.0 ? kLevelSlope * std::abs(d) : 0.0)) break;
      d1 += d, z1 += z, dd += d * d, dz += d * z, count += 1.0, before = d;
    }
    if (end - i >= 2) {
      const bool outwards = before > 0.0;
      LevelSegment s{{fan, returns[outwards ? i : end - 1].place, returns[outwards ? end - 1 : i].place}, {}};
      for (std::size_t k = i; k < end; ++k) s.sums.add(returns[k].at());
      out.push_back(s);
    }
    i = end;
  }
}

void LevelGrowth::Growing::add(const LevelSegment& s, const Vector3d& head) {
  sums.add(s.sums);
  const Vector3d way = (s.sums.first / s.sums.n - head).normalized();
  towards += s.sums.n * way * way.transpose();
  const Vector3d mean = sums.first / sums.n;
  const Vector2d rise = rises(sums, kFlatter);
  plane = {mean.z() - rise.dot(mean.head<2>()), rise.x(), rise.y()};
  members.push_back(s.ends);
}

double LevelGrowth::Growing::off(const LevelEnds& s) const {
  const auto of = [&](const Eigen::Vector3f& at) { return std::abs(plane[0] + plane[1] * static_cast<double>(at.x()) + plane[2] * static_cast<double>(at.y()) - static_cast<double>(at.z())); };
  return std::max(of(s.nearest), of(s.farthest));
}

void LevelGrowth::take(const LevelSegment& s, const Vector3d& head) {
  const LevelEnds& ends = s.ends;
  std::erase_if(open_, [&](std::size_t g) { return ends.fan - growing_[g].members.back().fan > kLevelFansApart; });
  std::size_t best = growing_.size();
  double least = 1e9;
  const Eigen::Vector2f across = (ends.farthest - ends.nearest).head<2>();
  const float length = across.norm();
  const Eigen::Vector2f along = across / length;
  for (const std::size_t g : open_) {
    const LevelEnds& last = growing_[g].members.back();
    if (last.fan == ends.fan) continue;
    const double off = growing_[g].off(ends);
    if (off >= std::min(least, growing_[g].members.size() < kYoung ? kOffYoung : kOffRegion)) continue;
    // In plan the segments lie side by side, or nearly.
    const float from = along.dot((last.nearest - ends.nearest).head<2>()), to = along.dot((last.farthest - ends.nearest).head<2>());
    if (std::min(from, to) > length + kSegmentsApart || std::max(from, to) < -kSegmentsApart) continue;
    least = off, best = g;
  }
  if (best == growing_.size()) {
    growing_.emplace_back();
    open_.push_back(best);
  }
  growing_[best].add(s, head);
}

std::vector<LevelRegion> LevelGrowth::regions() const {
  std::vector<LevelRegion> out;
  for (const Growing& g : growing_) {
    if (g.members.size() < kLevelSegmentsLeast || g.sums.n < kLevelReturnsLeast) continue;
    const Vector2d rise = rises(g.sums, kFlat);
    if (rise.norm() > kSteepestRegion) continue;
    LevelRegion r;
    r.middle = g.sums.first / g.sums.n;
    r.normal = Vector3d(-rise.x(), -rise.y(), 1.0).normalized();
    r.count = static_cast<int>(g.sums.n);
    const double off = r.normal.dot((g.sums.second - g.sums.n * r.middle * r.middle.transpose()) * r.normal);
    r.spread = std::sqrt(std::max(0.0, off) / std::max(1.0, g.sums.n - 3.0));
    r.noise = kRangeNoise * std::sqrt(r.normal.dot(g.towards * r.normal) / g.sums.n);
    r.segments = g.members;
    out.push_back(std::move(r));
  }
  std::sort(out.begin(), out.end(), [](const LevelRegion& a, const LevelRegion& b) { return a.count > b.count; });
  return out;
}

std::vector<LevelRegion> level_regions(const FanSweep& sweep, const LevelPlace& place) {
  LevelGrowth growth;
  std::vector<LevelSegment> segments;
  for (std::size_t fan = 0; fan < sweep.heads.size(); ++fan) {
    segments.clear();
    level_segments(sweep, fan, place, segments);
    for (const LevelSegment& s : segments) growth.take(s, sweep.heads[fan]);
  }
  return growth.regions();
}

const std::vector<LevelRegion>& LevelRegionsOfBeds::about(const Vector3d& middle) {
  if (place_.radius > 0.0 && (middle.head<2>() - place_.middle).norm() < kSamePlace) return regions_;
  place_ = {middle.head<2>(), kOfBed};
  return regions_ = level_regions(sweep_, place_);
}

}  // namespace berm::app
