#include "recognition/bed_refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "recognition/bed_fit.hpp"

namespace berm::app {
namespace {

using Eigen::Vector2d;

constexpr double kEndsMost = 0.2;   // m
constexpr double kRefinedTiltMost = 0.09;  // rad
constexpr double kLevelTilt = 0.025, kLevelStep = 0.03;  // rad; m
constexpr int kLevelSteps = 3;
constexpr double kWidthSlack = 0.08;  // m
constexpr int kRounds = 4;          // with one step
constexpr int kMoves = 13;
constexpr double kLeastGain = 1e-3;  // rays: less is rounding
constexpr double kNear = 0.25;      // m: more than any corner goes by one move
constexpr double kSightMost = 6.0;   // of the sight of a sensor that stands low
constexpr double kHalfLength = 2.5, kHalfWidth = 1.2;  // m: a turn that moves an end, a side, by a step

// sight: from the bed towards the sensor along u and v, m for each m that it stands over the tops.
BedPose moved(const BedPose& from, int which, double by, const Vector2d& sight) {
  BedPose p = from;
  const Vector2d u(std::cos(p.yaw), std::sin(p.yaw)), v(-u.y(), u.x());
  switch (which) {
    case 0: p.middle.z() += by; break;
    // One end's or one side's top, the other's where it is: what hides the one shows the other.
    case 1: p.middle.z() += 0.5 * by, p.pitch -= 0.5 * by / kHalfLength; break;
    case 2: p.middle.z() += 0.5 * by, p.pitch += 0.5 * by / kHalfLength; break;
    case 3: p.middle.z() += 0.5 * by, p.roll += 0.5 * by / kHalfWidth; break;
    case 4: p.middle.z() += 0.5 * by, p.roll -= 0.5 * by / kHalfWidth; break;
    case 5: p.yaw += by / kHalfLength; break;
    case 6: p.width += by, p.middle.head<2>() += 0.5 * by * v; break;
    case 7: p.width += by, p.middle.head<2>() -= 0.5 * by * v; break;
    case 8: p.length += by, p.middle.head<2>() += 0.5 * by * u; break;
    case 9: p.length += by, p.middle.head<2>() -= 0.5 * by * u; break;
    // A higher top along the rays that pass the near end's wall, the near side's, or both: their inner edges come towards the sensor, and the far walls stay.
    default: {
      p.middle.z() += 0.5 * by;
      const double end = which == 10 ? 0.0 : 0.5 * by * sight.x(), side = which == 11 ? 0.0 : 0.5 * by * sight.y();
      p.length += std::copysign(end, by), p.width += std::copysign(side, by);
      p.middle.head<2>() += 0.5 * end * u + 0.5 * side * v;
    }
  }
  return p;
}

Vector2d sight_of(const BedPose& pose, const PackedRays& rays) {
  if (rays.eights().empty()) return Vector2d::Zero();
  const Eights<3>& head = rays.eights()[rays.eights().size() / 2].head;
  const Eigen::Vector3d sensor = pose.rotation().transpose() * (Eigen::Vector3f(head[0][0], head[1][0], head[2][0]).cast<double>() - pose.middle);
  const Vector2d level = sensor.head<2>() / std::max(sensor.z(), 0.1);
  return level * std::min(1.0, kSightMost / std::max(level.norm(), 1e-9));
}

std::array<double, 2> ends_along(const BedPose& p, const Vector2d& origin) {
  const double middle = Vector2d(std::cos(p.yaw), std::sin(p.yaw)).dot(p.middle.head<2>() - origin);
  return {middle - p.length / 2, middle + p.length / 2};
}

// The most by which a corner of the opening lies elsewhere.
double most_apart(const std::array<Eigen::Vector3d, 4>& one, const BedPose& b) {
  const std::array<Eigen::Vector3d, 4> other = opening_corners(b);
  double most = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) most = std::max(most, (one[k] - other[k]).norm());
  return most;
}

}  // namespace

BedPose refined(const BedPose& start, const PackedRays& rays, const SizeRange& widths, double first_step, int halvings) {
  const Vector2d origin = start.middle.head<2>();
  const std::array<double, 2> ends = ends_along(start, origin);
  BedPose best = start;
  PackedRays near = rays.meeting(best, kNear);
  std::array<Eigen::Vector3d, 4> near_of = opening_corners(best);
  double score = score_of(best, near), step = first_step;
  const Vector2d sight = sight_of(start, rays);
  for (int halving = 0; halving < halvings; ++halving, step /= 2) {
    int idle = 0;  // moves since one was kept: after all of them none is left to try
    for (int k = 0; k < kRounds * kMoves && idle < kMoves; ++k, ++idle)
      for (const double sense : {1.0, -1.0}) {
        const BedPose p = moved(best, k % kMoves, sense * step, sight);
        const std::array<double, 2> now = ends_along(p, origin);
        if (std::max(std::abs(now[0] - ends[0]), std::abs(now[1] - ends[1])) > kEndsMost) continue;
        if (std::max(std::abs(p.pitch), std::abs(p.roll)) > kRefinedTiltMost) continue;
        if (p.width < widths[0] - kWidthSlack || p.width > widths[1] + kWidthSlack) continue;
        if (most_apart(near_of, p) > kNear) near = rays.meeting(best, kNear), near_of = opening_corners(best);
        const double here = score_of(p, near);
        if (here <= score + kLeastGain) continue;
        best = p, score = here;
        idle = -1;
        break;
      }
  }
  return best;
}

BedPose levelled(const BedPose& start, const PackedRays& all_rays) {
  BedPose best = start;
  const PackedRays rays = all_rays.meeting(start, kNear);
  double score = score_of(best, rays);
  const auto offer = [&](double pitch, double roll, int step) {
    BedPose p = start;
    p.pitch += pitch, p.roll += roll, p.middle.z() += kLevelStep * step;
    const double here = score_of(p, rays);
    if (here <= score) return false;
    best = p, score = here;
    return true;
  };
  // The height first, then tilts at the heights next to it: half as many as all of both.
  int height = 0;
  for (int step = -kLevelSteps; step <= kLevelSteps; ++step)
    if (offer(0.0, 0.0, step)) height = step;
  for (const double pitch : {-kLevelTilt, 0.0, kLevelTilt})
    for (const double roll : {-kLevelTilt, 0.0, kLevelTilt})
      for (int step = height - 1; step <= height + 1; ++step)
        if (pitch != 0.0 || roll != 0.0) offer(pitch, roll, step);
  return best;
}

}  // namespace berm::app
