#include "recognition/bed_class.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "recognition/bed_ground.hpp"

namespace berm::app {
namespace {

constexpr double kLengthOpen = 0.12;  // m, of a length outside a class, at most: look-alikes are 0.3 m outside and more

SeenBed seen(const BedPose& p) { return {p.length, p.width, p.thickness, p.open_end != 0, 0.0}; }

}  // namespace

TruckRangeSet classes_of(const FittedBed& fit, const TruckRangeSet& ranges) {
  SeenBed bed = seen(fit.pose);
  if (fit.converged) bed.length_open = std::min(kLengthOpen, 2 * std::sqrt(fit.covariance(6, 6)));
  return ranges.taking_in(bed);
}

TruckRangeSet some_classes_of(const FittedBed& fit, const TruckRangeSet& ranges) {
  TruckRangeSet as_it_is = ranges.taking_in(seen(fit.pose));
  if (!as_it_is.classes.empty() || !fit.converged) return as_it_is;
  FittedBed known = fit;
  find_covariance(known, ranges.bed_sizes());
  return classes_of(known, ranges);
}

TruckRangeSet standing_on(const std::vector<double>& beside, const TruckRangeSet& classes) {
  TruckRangeSet out;
  out.slack = classes.slack;
  std::copy_if(classes.classes.begin(), classes.classes.end(), std::back_inserter(out.classes),
               [&](const TruckRanges& c) { return share_of_ground(beside, c.top_over_ground) >= kGroundLeast; });
  return out;
}

std::string refusal_of_height(const BedHeight& height, const TruckRangeSet& classes) {
  if (height.beyond <= kLikelyNone) return {};
  std::string allowed;
  for (const TruckRanges& c : classes.classes)
    allowed += fmt::format("{}{} {:.2f} to {:.2f} m{}", allowed.empty() ? "" : ", ", c.name, c.wall_height[0], c.wall_height[1], c.half_round ? " of a half pipe" : "");
  return fmt::format("its walls are {:.2f} m high (standard deviation {:.2f}){}, outside every class with its other sizes: {}", height.height, height.deviation,
                     height.half_pipe > 0.5 ? " and a half pipe's" : "", allowed);
}

const TruckRanges& class_told(const FittedBed& fit, const BedHeight& height, const TruckRangeSet& classes, bool canopy) {
  const BedPose& p = fit.pose;
  const auto outside = [&](const TruckRanges& c) {
    if (c.half_round != (height.half_pipe > 0.5)) return std::numeric_limits<double>::max();
    return (canopy && !c.canopy ? 1.0 : 0.0) + std::hypot(outside_by(p.length, c.inside_length), std::hypot(outside_by(p.width, c.inside_width), outside_by(p.thickness, c.wall_thickness), outside_by(height.height, c.wall_height)));
  };
  return *std::min_element(classes.classes.begin(), classes.classes.end(), [&](const TruckRanges& a, const TruckRanges& b) { return outside(a) < outside(b); });
}

}  // namespace berm::app
