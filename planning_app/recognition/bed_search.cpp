#include "recognition/bed_search.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kRegionsMost = 8;
constexpr std::size_t kRefinedMost = 3;
constexpr std::size_t kCoarseRays = 700;  // that first decide between interpretations
constexpr double kLengthStep = 0.2;  // m
constexpr double kExtentSlack = 0.45;

struct Candidate {
  BedPose pose;
  double score = 0.0;
};

std::vector<Ray> rays_round(const FanSweep& sweep, const Vector2d& middle, double radius, double low, double high) {
  std::vector<Ray> out;
  for (std::size_t fan = 0; fan < sweep.heads.size(); ++fan) {
    const Eigen::Vector3d& head = sweep.heads[fan];
    const Vector2d to = middle - head.head<2>();
    for (const FanReturn& r : sweep.of(fan)) {
      const Eigen::Vector3d d = r.at - head;
      const double level = d.head<2>().norm(), along = d.head<2>().dot(to) / std::max(level, 1e-9);
      if (along <= 0.0 || to.squaredNorm() - along * along > radius * radius) continue;
      const double slope = d.z() / std::max(level, 1e-9), near = head.z() + slope * (along - radius), far = head.z() + slope * (along + radius);
      if (std::max(near, far) < low || std::min(near, far) > high) continue;
      out.push_back({head, r.at});
    }
  }
  return out;
}

void offer(std::vector<Candidate>& kept, const BedPose& pose, const std::vector<Ray>& rays) {
  kept.push_back({pose, weigh(pose, rays).score});
}

// All beds of which the region may be a face: outer or inner face of a side or of an end.
void interpret_region(const UprightRegion& region, const TruckRangeSet& ranges, const std::vector<Ray>& rays, std::vector<Candidate>& kept) {
  const SizeRange lengths = ranges.hull(&TruckRanges::inside_length), widths = ranges.hull(&TruckRanges::inside_width);
  const SizeRange thick = ranges.hull(&TruckRanges::wall_thickness);
  const double thickness = 0.5 * (thick[0] + thick[1]), width = 0.5 * (widths[0] + widths[1]);
  const Vector2d along(region.normal.y(), -region.normal.x());  // along x normal = up
  const Vector2d middle = 0.5 * (region.first + region.last);
  const double extent = (region.last - region.first).norm();
  for (const bool side : {true, false}) {
    const double most = (side ? lengths[1] : widths[1]) + 2 * thick[1] + kExtentSlack;
    if (extent > most) continue;
    for (const bool outer : {true, false}) {
      for (double length = lengths[0] + 0.05; length < lengths[1] + kLengthStep / 2; length += kLengthStep) {
        const double own = side ? length : width, across = side ? width : length;
        if (extent > own + 2 * thick[1] + kExtentSlack) continue;
        const double depth = outer ? -(across / 2 + thickness) : across / 2, reach = own / 2 + (outer ? thickness : 0.0) - extent / 2;
        for (const double slide : {-1.0, 0.0, 1.0}) {
          if (slide == 0.0 && std::abs(reach) > 0.6) continue;
          if (slide != 0.0 && std::abs(reach) < 0.08) continue;
          BedPose pose;
          pose.middle.head<2>() = middle + depth * region.normal + slide * reach * along;
          pose.middle.z() = region.high + 0.05;
          const Vector2d axis = side ? along : region.normal;
          pose.yaw = std::atan2(axis.y(), axis.x());
          pose.length = length;
          pose.width = width;
          pose.thickness = thickness;
          for (pose.open_end = -1; pose.open_end <= 1; ++pose.open_end) offer(kept, pose, rays);
        }
      }
    }
  }
}

// Moves each wall, the height and the angles while the evidence grows.
void refine(Candidate& c, const std::vector<Ray>& rays, const TruckRangeSet& ranges, double first_step, int halvings) {
  const SizeRange lengths = ranges.hull(&TruckRanges::inside_length), widths = ranges.hull(&TruckRanges::inside_width);
  constexpr double length_slack = 0.7, width_slack = 0.45;  // enough to tell a bed of another size
  c.score = weigh(c.pose, rays).score;
  double step = first_step;
  for (int halving = 0; halving < halvings; ++halving, step /= 2) {
    for (int round = 0; round < 4; ++round) {
      bool better = false;
      for (int which = 0; which < 8; ++which) {
        for (const double sense : {1.0, -1.0}) {
          BedPose p = c.pose;
          const double move = sense * step;
          const Vector2d u(std::cos(p.yaw), std::sin(p.yaw)), v(-u.y(), u.x());
          switch (which) {
            case 0: p.length += move, p.middle.head<2>() += 0.5 * move * u; break;
            case 1: p.length += move, p.middle.head<2>() -= 0.5 * move * u; break;
            case 2: p.width += move, p.middle.head<2>() += 0.5 * move * v; break;
            case 3: p.width += move, p.middle.head<2>() -= 0.5 * move * v; break;
            case 4: p.middle.z() += move; break;
            case 5: p.yaw += move / 2.5; break;
            case 6: p.pitch += move / 2.5; break;
            default: p.roll += move / 1.2; break;
          }
          if (p.length < lengths[0] - length_slack || p.length > lengths[1] + length_slack || p.width < widths[0] - width_slack ||
              p.width > widths[1] + width_slack) continue;
          if (std::max(std::abs(p.pitch), std::abs(p.roll)) > 0.09) continue;
          const double score = weigh(p, rays).score;
          if (score <= c.score + 1e-9) continue;
          c = {p, score};
          better = true;
          break;
        }
      }
      if (!better) break;
    }
  }
}

// Tries ends elsewhere: a cab in line with the bed, or a hidden end, is a maximum of its own.
void shift_ends(Candidate& c, const std::vector<Ray>& rays, const TruckRangeSet& ranges) {
  const SizeRange lengths = ranges.hull(&TruckRanges::inside_length);
  const BedPose start = c.pose;
  const Vector2d u(std::cos(start.yaw), std::sin(start.yaw));
  for (int open_end = -1; open_end <= 1; ++open_end)
    for (double front = -2.1; front < 2.2; front += 0.15)
      for (const double rear : {0.0, front}) {  // one end, or the bed as a whole
        for (const bool at_rear : {false, true}) {
          if (at_rear && rear != 0.0) continue;
          BedPose p = start;
          p.open_end = open_end;
          p.length += rear != 0.0 ? 0.0 : front;
          p.middle.head<2>() += (rear != 0.0 ? front : at_rear ? -0.5 * front : 0.5 * front) * u;
          if (p.length < lengths[0] - 0.3 || p.length > lengths[1] + 0.6) continue;
          const double score = weigh(p, rays).score;
          if (score > c.score) c = {p, score};
        }
      }
}

bool alike(const BedPose& a, const BedPose& b) {
  return a.open_end == b.open_end && (a.middle - b.middle).norm() < 0.25 && std::abs(std::remainder(a.yaw - b.yaw, 3.14159265)) < 0.1 &&
         std::abs(a.length - b.length) < 0.3;
}

}  // namespace

std::vector<Ray> rays_near(const FanSweep& sweep, const BedPose& pose, double below) {
  const double radius = std::hypot(pose.length / 2, pose.width / 2) + pose.thickness + 0.6;
  return rays_round(sweep, pose.middle.head<2>(), radius, pose.middle.z() - below, pose.middle.z() + 0.6);
}

std::vector<BedInterpretation> interpret(const FanSweep& sweep, const std::vector<UprightRegion>& regions, const TruckRangeSet& ranges) {
  std::vector<Candidate> refined;
  std::size_t used = 0;
  for (const UprightRegion& region : regions) {
    if (used++ >= kRegionsMost) break;
    const std::vector<Ray> all = rays_round(sweep, 0.5 * (region.first + region.last), 5.0, region.high - 1.1, region.high + 0.6);
    std::vector<Ray> some;
    const std::size_t stride = std::max<std::size_t>(2, all.size() / kCoarseRays);
    for (std::size_t i = 0; i < all.size(); i += stride) some.push_back(all[i]);
    std::vector<Candidate> kept;
    interpret_region(region, ranges, some, kept);
    std::sort(kept.begin(), kept.end(), [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    std::vector<Candidate> distinct;
    for (const Candidate& c : kept) {
      if (distinct.size() >= kRefinedMost) break;
      if (std::none_of(distinct.begin(), distinct.end(), [&](const Candidate& d) { return alike(c.pose, d.pose); })) distinct.push_back(c);
    }
    for (Candidate& c : distinct) {
      refine(c, some, ranges, 0.16, 3);
      refined.push_back(c);
    }
  }
  std::sort(refined.begin(), refined.end(), [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  std::vector<BedInterpretation> out;
  for (const Candidate& c : refined) {
    if (out.size() >= 2 * kInterpretations) break;
    if (std::any_of(out.begin(), out.end(), [&](const BedInterpretation& o) { return alike(c.pose, o.pose); })) continue;
    Candidate last = c;
    BedInterpretation i;
    i.rays = rays_near(sweep, c.pose);
    refine(last, i.rays, ranges, 0.1, 2);
    shift_ends(last, i.rays, ranges);
    i.rays = rays_near(sweep, last.pose);
    refine(last, i.rays, ranges, 0.1, 4);
    i.pose = last.pose;
    i.rays = rays_near(sweep, i.pose);
    i.evidence = weigh(i.pose, i.rays);
    out.push_back(std::move(i));
  }
  std::sort(out.begin(), out.end(), [](const BedInterpretation& a, const BedInterpretation& b) { return a.evidence.score > b.evidence.score; });
  if (out.size() > kInterpretations) out.resize(kInterpretations);
  return out;
}

}  // namespace berm::app
