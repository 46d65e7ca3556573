#include "recognition/level_planes.hpp"

#include <algorithm>
#include <cmath>

#include "recognition/depth_weights.hpp"

namespace berm::app {
namespace {

using Eigen::Vector3d;

constexpr double kFloorTilt = 0.05;                            // rad, of a floor from the plane of the tops
constexpr double kPlaceSlack = 0.15;                           // m, of a segment's ends: a load's toe, mud
constexpr double kSegmentsWithin = 0.8;                        // share of a region's segments that lie where the plane would
constexpr int kFloorReturns = 12;
constexpr double kFloorLeast = 0.6;                            // m, along and across
constexpr double kSteel = 0.005, kSoilRough = 0.014;           // m, root mean square off a plane, without the range's noise
constexpr double kFloorAbsent = 2.5, kCanopyAbsent = 6.0;      // what each match must be worth at least
constexpr double kFloorMost = 12.0;                            // rays
constexpr double kGroundUnsure = 0.3;                          // m: ruts
constexpr double kCanopyAcross = 0.09, kCanopyAtTop = 0.09;    // rise over run across; m, of its plane from the tops where it begins
constexpr double kCanopyLeast = 0.25, kCanopyWide = 0.7;       // m, along and across
constexpr double kCanopyUnseen = 0.25, kCanopyBegins = 0.25;   // m, of its length; from the front wall to its first returns: a cab stands farther off
constexpr double kSheetRough = 0.008, kSheetSpread = 1.25;     // m, as of steel; times that: a wall's top and a roof behind it are no sheet
constexpr double kRiseUnsure = 0.02;                            // rise over run
constexpr double kCanopyReturn = 0.5, kCanopyMost = 20.0;      // rays: of a flat return, as for a cab; of all

// A region in the bed's frame.
struct Placed {
  const LevelRegion* region = nullptr;
  Vector3d middle, normal;
};

struct Extent {
  double low = 1e9, high = -1e9;
  void add(double at) { low = std::min(low, at), high = std::max(high, at); }
  [[nodiscard]] double length() const { return high - low; }
};

// The share of the segments whose ends both lie within, and how far those reach.
struct Reach {
  double share = 0.0;
  Extent along, across;
};
Reach reach_within(const Placing& place, const LevelRegion& region, const SizeRange& u, const SizeRange& v) {
  const auto within = [&](const Vector3d& at) { return at.x() > u[0] && at.x() < u[1] && at.y() > v[0] && at.y() < v[1]; };
  Reach out;
  for (const LevelEnds& s : region.segments) {
    const Vector3d nearest = place.of(s.nearest), farthest = place.of(s.farthest);
    if (!within(nearest) || !within(farthest)) continue;
    out.share += 1.0 / static_cast<double>(region.segments.size());
    for (const Vector3d& at : {nearest, farthest}) out.along.add(at.x()), out.across.add(at.y());
  }
  return out;
}

// Of returns so far off their plane: how much likelier on steel than on soil.
double flatness_of(const LevelRegion& r) {
  const double steel = std::hypot(r.noise, kSteel), soil = std::hypot(r.noise, kSoilRough), off = r.spread * r.spread;
  return kIndependent * r.count * (std::log(soil / steel) - 0.5 * off * (1.0 / (steel * steel) - 1.0 / (soil * soil)));
}

class Tree {
 public:
  Tree(const BedPose& pose, const std::vector<LevelRegion>& regions, std::optional<double> ground, const TruckRangeSet& ranges) : pose_(pose), place_(pose), ranges_(ranges), ground_(ground) {
    const Eigen::Matrix3d turn = pose.rotation().transpose();
    const double reach = std::hypot(pose.length / 2 + 2.0, pose.width / 2 + 0.5);
    for (const LevelRegion& r : regions) {
      if ((r.middle - pose.middle).head<2>().norm() > reach) continue;
      const Placed p{&r, place_.of(r.middle), turn * r.normal};
      if (p.normal.z() > 0.5) placed_.push_back(p);
    }
  }

  LevelPlanes best() {
    const LevelPlanes none;
    LevelPlanes best = with_canopy(none);
    for (const Placed& p : placed_) {
      const std::optional<FloorPlane> floor = floor_of(p);
      if (!floor) continue;
      LevelPlanes so_far;
      so_far.floor = floor;
      so_far.worth = std::min(floor->flatness, kFloorMost) - kFloorAbsent;
      if (so_far.worth <= 0.0) continue;
      so_far = with_canopy(so_far);
      if (so_far.worth > best.worth) best = so_far;
    }
    best.tried = tried_;
    return best;
  }

 private:
  // Between the sides and ends, parallel to the tops, as deep as a floor and as high over the ground.
  std::optional<FloorPlane> floor_of(const Placed& p) {
    ++tried_;
    const double depth = -p.middle.z();
    if (p.region->count < kFloorReturns || depth < kShallowest || depth > kDeepestSeen) return std::nullopt;
    if (std::hypot(p.normal.x(), p.normal.y()) > kFloorTilt) return std::nullopt;
    if (ground_) {
      const SizeRange top = ranges_.hull(&TruckRanges::top_over_ground), high = ranges_.hull(&TruckRanges::wall_height);
      if (outside_by(*ground_ - depth, {top[0] - high[1], top[1] - high[0]}) > kGroundUnsure) return std::nullopt;
    }
    const double x = pose_.length / 2 + kPlaceSlack, y = pose_.width / 2 + kPlaceSlack;
    const Reach reach = reach_within(place_, *p.region, {-x, x}, {-y, y});
    if (reach.share < kSegmentsWithin || reach.along.length() < kFloorLeast || reach.across.length() < kFloorLeast) return std::nullopt;
    return FloorPlane{depth, flatness_of(*p.region), p.region->count, p.region->spread, p.region->noise};
  }

  // Beyond an end that has its wall, from the wall's top, no wider than the bed, and level across.
  std::optional<CanopyPlane> canopy_of(const Placed& p, const LevelPlanes& so_far) {
    ++tried_;
    const int end = p.middle.x() > 0.0 ? 1 : -1;
    const auto length = ranges_.canopy_hull(&TruckRanges::canopy_length), up = ranges_.canopy_hull(&TruckRanges::canopy_rise);
    if (end == pose_.open_end || !length) return std::nullopt;
    if (std::abs(p.normal.y() / p.normal.z()) > kCanopyAcross) return std::nullopt;
    const double face = pose_.face(0, end, true), rise = -end * p.normal.x() / p.normal.z();
    const double at_wall = p.middle.z() - rise * (end * p.middle.x() - face);
    if (std::abs(at_wall) > kCanopyAtTop) return std::nullopt;
    if (so_far.floor && so_far.floor->depth < kShallowest - at_wall) return std::nullopt;
    if (p.region->spread > kSheetSpread * std::hypot(p.region->noise, kSheetRough)) return std::nullopt;
    if (outside_by(rise, {(*up)[0] / (*length)[1], (*up)[1] / (*length)[0]}) > kRiseUnsure) return std::nullopt;
    const double near = face - kPlaceSlack, far = face + (*length)[1] + kPlaceSlack, y = pose_.face(1, 1, true) + kPlaceSlack;
    const Reach reach = reach_within(place_, *p.region, end > 0 ? SizeRange{near, far} : SizeRange{-far, -near}, {-y, y});
    if (reach.share < kSegmentsWithin || reach.along.length() < kCanopyLeast || reach.across.length() < kCanopyWide) return std::nullopt;
    const double begins = (end > 0 ? reach.along.low : -reach.along.high) - face, ends = (end > 0 ? reach.along.high : -reach.along.low) - face;
    if (begins > kCanopyBegins || ends < (*length)[0] - kCanopyUnseen) return std::nullopt;
    return CanopyPlane{end, ends, rise, p.region->count, p.region->spread, p.region->noise};
  }

  LevelPlanes with_canopy(const LevelPlanes& so_far) {
    LevelPlanes best = so_far;
    for (const Placed& p : placed_) {
      const std::optional<CanopyPlane> canopy = canopy_of(p, so_far);
      if (!canopy) continue;
      const double worth = so_far.worth + std::min(kCanopyReturn * canopy->count, kCanopyMost) - kCanopyAbsent;
      if (worth > best.worth) best.canopy = canopy, best.worth = worth;
    }
    return best;
  }

  const BedPose& pose_;
  Placing place_;
  const TruckRangeSet& ranges_;
  std::optional<double> ground_;
  std::vector<Placed> placed_;
  int tried_ = 0;
};

}  // namespace

LevelPlanes match_level_planes(const BedPose& pose, const std::vector<LevelRegion>& regions, const TruckRangeSet& ranges, std::optional<double> ground) {
  return Tree(pose, regions, ground, ranges).best();
}

}  // namespace berm::app
