#include "recognition/region_strips.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berm::app {
namespace {

using Eigen::Vector2d;

constexpr double kOneTop = 0.12;        // m, of a segment's top from that of its line
constexpr double kTopOverSegment = 0.03;  // m, of the wall over its highest return
constexpr std::size_t kTopLines = 2;
constexpr double kTiltMost = 0.07;      // rad
constexpr double kHeightSlack = 0.12;   // m; a bed may tilt where a region does not show it
constexpr double kExtentSlack = 0.25;   // m
constexpr double kInnerEnd = 1.0;       // m, of an end's inner face, to be tried as one
constexpr double kFromBehind = 0.9;     // cosine, of the way to the sensor from the normal of an end that is seen between the sides
constexpr double kEdgeUnseen = 0.1;     // m, from its last return to the side
constexpr double kParallel = 0.05;      // rad, of two sides
constexpr double kApartSlack = 0.10;    // m
constexpr double kRollMost = 0.09;      // rad
constexpr double kPairSlack = 0.06;     // m, of the height that two sides give
constexpr double kLongRegion = 1.5;     // m: its slope tells the bed's pitch
constexpr SizeRange kCabWidth{1.6, 2.8};  // m, of its front
constexpr std::array<double, 3> kOverCab{-0.2, 0.0, 0.2};  // m, of a bed's tops over its cab's front
constexpr double kAlongMost = 6.0;      // m between the middles of two regions of one bed

// Segments of a region whose tops lie on one line: height = z + slope * x, x along the region.
struct TopLine {
  double z = 0.0, slope = 0.0, first = 0.0, last = 0.0;
  std::size_t count = 0;
};

struct Top {
  double along, high;
};

TopLine line_through(const std::vector<Top>& tops) {
  TopLine line;
  double n = 0.0, x = 0.0, z = 0.0, xx = 0.0, xz = 0.0;
  line.first = 1e9, line.last = -1e9;
  for (const Top& t : tops) {
    n += 1.0, x += t.along, z += t.high, xx += t.along * t.along, xz += t.along * t.high;
    line.first = std::min(line.first, t.along), line.last = std::max(line.last, t.along);
  }
  const double spread = xx - x * x / n;
  if (line.last - line.first > 1.8 && tops.size() >= 6) line.slope = std::clamp((xz - x * z / n) / spread, -kTiltMost, kTiltMost);
  line.z = (z - line.slope * x) / n;
  line.count = tops.size();
  return line;
}

// A cab beside a bed, or a person before it, has a top of its own: the line that most segments share, then that of the rest.
std::vector<TopLine> top_lines(const UprightRegion& region, const Vector2d& along, const Vector2d& middle) {
  std::vector<Top> tops;
  for (const UprightSegment& s : region.segments) tops.push_back({along.dot(s.at - middle), s.high});
  std::vector<TopLine> out;
  while (out.size() < kTopLines && tops.size() >= 4) {
    const auto on_line = [](const Top& t, const Top& centre, double slope) { return std::abs(t.high - centre.high - slope * (t.along - centre.along)) < kOneTop; };
    std::ptrdiff_t most = 0;
    Top best_centre = tops.front();
    double best_slope = 0.0;
    for (const Top& centre : tops)
      for (const double slope : {-0.04, 0.0, 0.04}) {
        const auto own = std::count_if(tops.begin(), tops.end(), [&](const Top& t) { return on_line(t, centre, slope); });
        if (own > most) most = own, best_centre = centre, best_slope = slope;
      }
    std::vector<Top> best;
    std::copy_if(tops.begin(), tops.end(), std::back_inserter(best), [&](const Top& t) { return on_line(t, best_centre, best_slope); });
    if (best.size() < 4 || (!out.empty() && 5 * best.size() < out.front().count)) break;
    out.push_back(line_through(best));
    std::erase_if(tops, [&](const Top& t) {
      return std::any_of(best.begin(), best.end(), [&](const Top& b) { return b.along == t.along && b.high == t.high; });
    });
  }
  return out;
}

// Of a usual width and walls.
BedStrip usual_strip(const TruckRangeSet& ranges) {
  const SizeRange widths = ranges.hull(&TruckRanges::inside_width), thick = ranges.hull(&TruckRanges::wall_thickness);
  BedStrip strip;
  strip.width = 0.5 * (widths[0] + widths[1]);
  strip.thickness = 0.5 * (thick[0] + thick[1]);
  strip.slack = kHeightSlack;
  return strip;
}

}  // namespace

std::vector<BedStrip> strips_of(const UprightRegion& region, const TruckRangeSet& ranges) {
  const Vector2d along(region.normal.y(), -region.normal.x());  // along x normal = up
  const Vector2d middle = 0.5 * (region.first + region.last);
  BedStrip strip = usual_strip(ranges);
  const double outer = strip.width / 2 + strip.thickness;
  std::vector<BedStrip> out;
  for (const TopLine& top : top_lines(region, along, middle)) {
    const auto offer = [&](const Vector2d& axis, double x, double depth) {
      strip.middle.head<2>() = middle + x * along + depth * region.normal;
      strip.middle.z() = top.z + top.slope * x + kTopOverSegment;
      strip.yaw = std::atan2(axis.y(), axis.x());
      // The line's slope along the bed is its pitch (nose down positive), across it its roll.
      const double uphill = std::atan(top.slope);
      strip.pitch = axis == along ? -uphill : 0.0;
      strip.roll = axis == along ? 0.0 : -uphill;  // v is against `along`
      out.push_back(strip);
    };
    const double centre = 0.5 * (top.first + top.last), extent = top.last - top.first;
    offer(along, centre, -outer);
    offer(along, centre, strip.width / 2);
    if (extent > 2 * outer + kExtentSlack) continue;
    // As an end: the region shows all of it, or its left or right part.
    const double slack = outer - 0.5 * extent;
    offer(region.normal, centre, 0.0);
    if (slack < 0.25) continue;
    offer(region.normal, centre - slack, 0.0);
    offer(region.normal, centre + slack, 0.0);
  }
  return out;
}

std::vector<BedStrip> strips_within(const UprightRegion& region, const TruckRangeSet& ranges, const Vector2d& sensor) {
  const Vector2d along(region.normal.y(), -region.normal.x()), middle = 0.5 * (region.first + region.last);
  if (region.normal.dot((sensor - middle).normalized()) < kFromBehind) return {};
  BedStrip strip = usual_strip(ranges);
  strip.width = ranges.hull(&TruckRanges::inside_width)[1];
  strip.yaw = std::atan2(region.normal.y(), region.normal.x());
  std::vector<BedStrip> out;
  for (const TopLine& top : top_lines(region, along, middle)) {
    const double centre = 0.5 * (top.first + top.last), extent = top.last - top.first, aside = 0.5 * (strip.width - extent) - kEdgeUnseen;
    if (extent < kInnerEnd || extent > strip.width) continue;
    strip.roll = -std::atan(top.slope);  // v is against `along`
    for (const double x : {centre, centre - aside, centre + aside}) {
      if (x != centre && aside < kEdgeUnseen) continue;
      strip.middle << middle + x * along, top.z + top.slope * x + kTopOverSegment;
      out.push_back(strip);
    }
  }
  return out;
}

std::vector<BedStrip> strips_behind(const UprightRegion& region, const TruckRangeSet& ranges) {
  if (const double wide = (region.last - region.first).norm(); wide < kCabWidth[0] || wide > kCabWidth[1]) return {};
  const Vector2d along(region.normal.y(), -region.normal.x()), middle = 0.5 * (region.first + region.last);
  const std::vector<TopLine> tops = top_lines(region, along, middle);
  if (tops.empty()) return {};
  BedStrip strip = usual_strip(ranges);
  strip.from_cab = true;
  strip.yaw = std::atan2(region.normal.y(), region.normal.x());
  std::vector<BedStrip> out;
  for (const double over : kOverCab) {
    strip.middle << middle, tops.front().z + over;
    out.push_back(strip);
  }
  return out;
}

std::vector<BedStrip> strips_of(const UprightRegion& a, const UprightRegion& b, const TruckRangeSet& ranges) {
  const double facing = a.normal.dot(b.normal);
  if (std::abs(facing) < std::cos(kParallel)) return {};
  const SizeRange widths = ranges.hull(&TruckRanges::inside_width), thick = ranges.hull(&TruckRanges::wall_thickness);
  const double thickness = 0.5 * (thick[0] + thick[1]), of_faces = facing > 0.0 ? thickness : 0.0;
  const UprightRegion& longer = (a.last - a.first).norm() >= (b.last - b.first).norm() ? a : b;
  const Vector2d along(longer.normal.y(), -longer.normal.x()), across(-along.y(), along.x());  // across: to the left of `along`, that is v
  const Vector2d middle_a = 0.5 * (a.first + a.last), middle_b = 0.5 * (b.first + b.last), between = middle_b - middle_a;
  const double apart = std::abs(across.dot(between)), width = apart - of_faces;
  if (width < widths[0] - kApartSlack || width > widths[1] + kApartSlack || std::abs(along.dot(between)) > kAlongMost) return {};
  // Two inner faces look at each other; of an outer and an inner one the nearer is the outer.
  if (facing < 0.0 && a.normal.dot(between) < 0.0) return {};
  const double side_of_b = across.dot(between) > 0.0 ? 1.0 : -1.0;
  const bool a_is_outer = facing > 0.0 && a.normal.dot(between) < 0.0, b_is_outer = facing > 0.0 && !a_is_outer;
  BedStrip strip;
  strip.width = std::clamp(width, widths[0], widths[1]);
  strip.thickness = thickness;
  strip.slack = kPairSlack;
  strip.yaw = std::atan2(along.y(), along.x());
  // Half-way between the inner faces, at the middle of both regions.
  const double inner_a = a_is_outer ? thickness : 0.0, inner_b = b_is_outer ? thickness : 0.0;
  const Vector2d centre = 0.5 * (middle_a + middle_b) + 0.5 * side_of_b * (inner_a - inner_b) * across;
  std::vector<BedStrip> out;
  for (const TopLine& top_a : top_lines(a, along, centre))
    for (const TopLine& top_b : top_lines(b, along, centre)) {
      const TopLine& longest = top_a.last - top_a.first >= top_b.last - top_b.first ? top_a : top_b;
      const double slope = longest.last - longest.first > kLongRegion ? longest.slope : 0.0;
      const auto high_at_centre = [&](const TopLine& t) {  // by its middle, where its own slope says nothing yet
        const double at = 0.5 * (t.first + t.last);
        return t.z + t.slope * at - slope * at;
      };
      const double high_a = high_at_centre(top_a), high_b = high_at_centre(top_b), rise = side_of_b * (high_b - high_a) / apart;  // to the left
      // Of one side only a lower part may be in sight: then the other tells the height.
      const bool both = std::abs(rise) <= kRollMost;
      strip.middle = {centre.x(), centre.y(), (both ? 0.5 * (high_a + high_b) : std::max(high_a, high_b)) + kTopOverSegment};
      strip.slack = both ? kPairSlack : kHeightSlack;
      strip.pitch = -std::atan(slope);
      strip.roll = both ? std::atan(rise) : 0.0;
      out.push_back(strip);
    }
  return out;
}

}  // namespace berm::app
