#include "recognition/bed_constraints.hpp"

#include <cmath>
#include <utility>

namespace berm::app {
namespace {

constexpr double kRangeDeviation = 0.03;  // m
constexpr double kFaceDeviation = 0.010;  // m, of a wall's face: mud
constexpr double kTopDeviation = 0.004;   // m, of a wall's top
constexpr double kMud = 0.010;            // m, its mean on the part of the faces that is seen
constexpr double kEdgeDeviation = 0.010;  // m, scale of the logistic function
constexpr double kOpenEndDeviation = 0.03;  // m, the same where a side ends without a wall across: between two scanlines
constexpr double kUprightSeen = 0.4;      // m below the top down to which a side is upright: below it may be a pipe
constexpr double kTopHigher = 0.35;       // m
constexpr double kNoTop = 0.08;           // m above the tops: a return there is none of them
constexpr double kEdgeReach = 0.45;       // m: rays that pass an edge on its wrong side farther away say nothing of it
constexpr double kCorner = 0.15;          // m
constexpr std::size_t kStatementsExpected = 1024;   // statements
constexpr double kEdgeKept = 0.2;         // m: nor do those on its right side, before a fit would come to them

class Collector {
 public:
  explicit Collector(const BedPose& pose) : pose_(pose), faces_(pose), place_(pose) { out.reserve(kStatementsExpected); }
  void take(const Ray& ray) {
    const Eigen::Vector3d &a = place_.head(ray), end = place_.end(ray), d = end - a;
    take({ray.head, ray.at, a, end, d, d.norm()});
  }
  std::vector<BedConstraint> out;

 private:
  struct LocalRay {
    const Eigen::Vector3f &head, &at;  // in the base frame
    const Eigen::Vector3d &a, &end, &d;  // the same in the bed frame; from one to the other
    const double range;
  };
  void on_plane(const LocalRay& ray, BedPlane plane, double offset, double deviation) {
    out.push_back({ray.head, ray.at, false, plane, {}, 1, offset, deviation});
  }
  // crossing: of ray and plane in the bed frame.
  void past(const LocalRay& ray, BedPlane plane, BedPlane bound, int sense, const Eigen::Vector3d& crossing) {
    const double limit = bound.axis == 2 ? 0.0 : pose_.face(bound.axis, bound.side, bound.outer);
    const double beyond = sense * (bound.side * crossing[bound.axis] - limit);
    if (beyond > kEdgeReach || beyond < -kEdgeKept) return;
    const bool of_open_end = bound.axis == 0 && bound.side == pose_.open_end;
    out.push_back({ray.head, ray.at, true, plane, bound, sense, 0.0, of_open_end ? kOpenEndDeviation : kEdgeDeviation});
  }
  [[nodiscard]] static double across(const LocalRay& ray, int axis) { return std::abs(ray.d[axis]) / ray.range; }
  void face_hit(const LocalRay& ray, int axis, int side, bool outer) {
    const double share = across(ray, axis), noise = kRangeDeviation * share;
    on_plane(ray, {axis, side, outer}, outer ? kMud : -kMud, std::sqrt(noise * noise + kFaceDeviation * kFaceDeviation));
    const double across_it = ray.end[1 - axis];
    out.back().in_corner = !outer && std::abs(across_it) > pose_.face(1 - axis, across_it > 0.0 ? 1 : -1, false) - kCorner;
  }
  [[nodiscard]] Eigen::Vector3d crossing(const LocalRay& ray, const BedPlane& plane) const {
    const double limit = plane.axis == 2 ? 0.0 : plane.side * pose_.face(plane.axis, plane.side, plane.outer);
    return ray.a + (limit - ray.a[plane.axis]) / ray.d[plane.axis] * ray.d;
  }

  void take(const LocalRay& ray) {
    const RayMeeting m = faces_.meet(ray.a, ray.end);
    const BedPlane rim{2, 1, false};
    switch (m.what) {
      case Meeting::outer_face: {
        const BedPlane face{m.axis, m.side, true};
        if (m.axis == 0 || m.entry.z() > -kUprightSeen) face_hit(ray, m.axis, m.side, true);
        past(ray, face, rim, 1, m.entry);
        for (const int side : {-1, 1}) past(ray, face, {1 - m.axis, side, true}, 1, m.entry);
        break;
      }
      case Meeting::through_face: {
        const BedPlane face{m.axis, m.side, true};
        // Above the wall or beside it: by the nearer way.
        double best = -m.entry.z();
        BedPlane bound = rim;
        for (const int side : {-1, 1}) {
          const double to = pose_.face(1 - m.axis, side, true) - side * m.entry[1 - m.axis];
          if (to < best) best = to, bound = {1 - m.axis, side, true};
        }
        past(ray, face, bound, -1, m.entry);
        break;
      }
      case Meeting::wall_top: {
        const double share = across(ray, 2), noise = kRangeDeviation * share;
        if (std::abs(m.off * share) > 3 * noise + 0.02) break;
        on_plane(ray, rim, 0.0, std::sqrt(noise * noise + kTopDeviation * kTopDeviation));
        if (m.axis < 0) break;
        past(ray, rim, {m.axis, m.side, false}, -1, m.rim);
        past(ray, rim, {m.axis, m.side, true}, 1, m.rim);
        break;
      }
      case Meeting::through_top:
        inside_of(ray, m.rim);
        break;
      case Meeting::inside:
      case Meeting::inner_face:
      case Meeting::through_inner:
        if (!m.by_open_end) inside_of(ray, m.rim);
        if (m.what == Meeting::inner_face && m.end.z() < -0.03 && (m.axis == 0 || m.end.z() > -kUprightSeen)) face_hit(ray, m.axis, m.side, false);
        break;
      case Meeting::over:
        if (m.entry.z() >= 0.0) over_wall(ray, m);
        break;
      case Meeting::above_face:
      case Meeting::before:
      case Meeting::below_side:
      case Meeting::none: break;
    }
    if (m.what == Meeting::none || m.by_open_end) beside(ray);
    if (pose_.open_end != 0) at_open_end(ray);
    const bool no_top = m.what == Meeting::wall_top && m.end.z() > kNoTop;
    if (m.what == Meeting::above_face || m.what == Meeting::before || no_top) above_tops(ray);
  }

  // Returns in the plane of a wall that is seen, a little above where its top is thought to be: the top is higher.
  void above_tops(const LocalRay& ray) {
    const Eigen::Vector3d &a = ray.a, &end = ray.end;
    for (int axis = 0; axis < 2; ++axis)
      for (const int side : {-1, 1}) {
        if (axis == 0 && side == pose_.open_end) continue;
        const BedPlane plane{axis, side, side * a[axis] > pose_.face(axis, side, true)};
        if (std::abs(end[axis] - side * pose_.face(axis, side, plane.outer)) > kRangeGate) continue;
        const Eigen::Vector3d at = crossing(ray, plane);
        if (at.z() < 0.0 || at.z() > kTopHigher || (at - end).norm() > kRangeGate) continue;
        if (at[1 - axis] > pose_.face(1 - axis, 1, true) || at[1 - axis] < -pose_.face(1 - axis, -1, true)) continue;
        past(ray, plane, {2, 1, false}, 1, at);
      }
  }

  // The return lies below the plane of the tops: the ray passed within the inner edges. Above it, it is a top that the pose does not have there yet.
  void inside_of(const LocalRay& ray, const Eigen::Vector3d& at_rim) {
    const Eigen::Vector3d& end = ray.end;
    const BedPlane rim{2, 1, false};
    const double noise = kRangeDeviation * across(ray, 2);
    if (end.z() > -std::max(0.035, 2.5 * noise)) {
      const bool far_beyond = (end - at_rim).norm() > 0.2;
      if (far_beyond || std::abs(end.z()) > 2.5 * noise) return;
      for (int axis = 0; axis < 2; ++axis)
        for (const int side : {-1, 1})
          if (std::abs(side * at_rim[axis] - pose_.face(axis, side, false)) < 0.06 && !(axis == 0 && side == pose_.open_end))
            past(ray, rim, {axis, side, false}, -1, at_rim);
      return;
    }
    for (int axis = 0; axis < 2; ++axis)
      for (const int side : {-1, 1})
        if (!(axis == 0 && side == pose_.open_end)) past(ray, rim, {axis, side, false}, 1, at_rim);
  }

  // Rays that go from within or from behind towards a side near the end where no wall stands. One that goes to that end meets the inner face before it, or
  // passes; one that comes in over it is stopped by the inner face or by the side's thickness at the end, and so by all that lies before the outer face.
  void at_open_end(const LocalRay& ray) {
    const Eigen::Vector3d &a = ray.a, &end = ray.end;
    for (const int s : {-1, 1}) {
      const BedPlane inner{1, s, false}, outer{1, s, true};
      const double limit = pose_.width / 2;
      if (s * a.y() > limit || s * end.y() < limit - kRangeGate) continue;
      const Eigen::Vector3d at = crossing(ray, inner);
      if (at.z() > -0.05 || at.z() < -kWallSeen) continue;
      const bool stopped = (end - at).norm() <= kRangeGate;
      const BedPlane& plane = goes_to_open_end(ray) ? inner : outer;
      if (stopped || s * end.y() > limit + pose_.thickness + kRangeGate) past(ray, plane, {0, pose_.open_end, false}, stopped ? 1 : -1, crossing(ray, plane));
    }
  }
  [[nodiscard]] bool goes_to_open_end(const LocalRay& ray) const { return ray.d.x() * pose_.open_end > 0.0; }

  void over_wall(const LocalRay& ray, const RayMeeting& m) {
    if (m.axis < 0 || (m.axis == 0 && m.side == pose_.open_end)) return;
    const Eigen::Vector3d at_rim = crossing(ray, {2, 1, false});
    if (m.side * m.end[m.axis] > pose_.face(m.axis, m.side, true) + 0.15) past(ray, {2, 1, false}, {m.axis, m.side, true}, -1, at_rim);
  }

  // Rays that pass a wall's end.
  void beside(const LocalRay& ray) {
    const Eigen::Vector3d &a = ray.a, &end = ray.end;
    for (int axis = 0; axis < 2; ++axis) {
      const int side = a[axis] > 0.0 ? 1 : -1;
      if (axis == 0 && side == pose_.open_end) continue;
      const double limit = pose_.face(axis, side, true);
      if (side * a[axis] < limit || side * end[axis] > limit - kRangeGate) continue;  // not from outside to well behind it
      for (const int end_side : {-1, 1}) {
        // What comes in over an open end would have been stopped by the side's thickness there.
        const bool thickness = axis == 1 && end_side == pose_.open_end && !goes_to_open_end(ray);
        const BedPlane plane{axis, side, !thickness};
        const Eigen::Vector3d at = crossing(ray, plane);
        if (at.z() > -0.05 || at.z() < -kWallSeen) continue;
        if (end_side * at[1 - axis] > pose_.face(1 - axis, end_side, true)) past(ray, plane, {1 - axis, end_side, true}, -1, at);
      }
    }
  }

  const BedPose& pose_;
  const BedFaces faces_;
  RayPlacing place_;
};

// Which of eight rays may make a statement. The others make none, and most of a fit's rays are such: they pass the bed, or meet it far from every edge. All
// limits are wider than those above, by more than single precision may be off.
class alignas(32) Speaks {
 public:
  explicit Speaks(const BedPose& pose)
      : place_(pose), half_u_(pose.length / 2), half_v_(pose.width / 2), rear_(-pose.face(0, -1, true)), front_(pose.face(0, 1, true)), side_(pose.face(1, 1, true)),
        beyond_(eight(pose.thickness + kEdgeKept + kUnsure)), at_wall_(eight(pose.thickness + kRangeGate + kUnsure)), open_(pose.open_end) {}

  [[nodiscard, gnu::always_inline]] EightInt operator()(const PackedRays::EightRays& r) const {
    const Places a = place_.of(r.head), end = place_.of(r.at), d{end.u - a.u, end.v - a.v, end.w - a.w};
    const Eight one_by_u = one_by8(d.u), one_by_v = one_by8(d.v), unsure = eight(kUnsure), unsure_share = eight(kUnsureShare);
    const Eight gate = eight(kRangeGate + kUnsure), half_u = eight(half_u_), half_v = eight(half_v_);
    const Crossings outer(a, one_by_u, one_by_v, rear_, front_, side_), inner(a, one_by_u, one_by_v, -half_u_, half_u_, half_v_);
    // At the wall that is seen: beside an end of it.
    const auto seen = [&](Eight t) {
      const Eight w = a.w + t * d.w;
      return (w > eight(-kWallSeen - kUnsure)) & (w < eight(kUnsure - 0.05));
    };
    const auto off_u = [&](Eight t) { return magnitude8(a.u + t * d.u) - half_u; };
    const auto off_v = [&](Eight t) { return magnitude8(a.v + t * d.v) - half_v; };
    const auto near_end = [&](Eight off) { return (off > -unsure) & (off < beyond_); };
    EightInt speaks = (seen(outer.in_u) & near_end(off_v(outer.in_u))) | (seen(outer.in_v) & near_end(off_u(outer.in_v)));
    if (open_ != 0) {
      speaks |= seen(inner.in_v) & near_end(off_u(inner.in_v));
      const Eight reach = eight(kEdgeReach + kUnsure);
      speaks |= seen(inner.out_v) & ((magnitude8(off_u(inner.out_v)) < reach) | (magnitude8(off_u(outer.out_v)) < reach));
    }
    const Eight in = outer.in(), entry_w = a.w + in * d.w;
    const EightInt comes = (in < outer.out() + unsure_share) & (in > -unsure_share) & (entry_w > eight(-kWallSeen - kUnsure));
    if (any8(comes)) {
      const EightInt low = (entry_w < unsure) & ((1.0F - in) * r.range > -gate);
      // Over the walls: where it goes through the plane of their tops near one of them.
      const EightInt level = d.w > eight(-kLevel);
      const Eight to_rim = -a.w / choose8(level, eight(1.0), d.w), rim_u = off_u(to_rim), rim_v = off_v(to_rim), within = eight(-kEdgeKept - kUnsure);
      const EightInt by_rim = (entry_w > -unsure) & (level | ((rim_u > within) & (rim_u < beyond_)) | ((rim_v > within) & (rim_v < beyond_)));
      const EightInt on_inner = (magnitude8(1.0F - inner.out()) * r.range < gate) & (end.w < unsure) &
                                ((inner.out_u < inner.out_v + unsure_share) | (end.w > eight(-kUprightSeen - kUnsure)));
      const EightInt over_wall = (end.w > -gate) & (end.w < eight(kTopHigher) + gate) & ((magnitude8(magnitude8(end.u) - half_u) < at_wall_) | (magnitude8(magnitude8(end.v) - half_v) < at_wall_));
      speaks |= comes & (low | by_rim | on_inner | over_wall);
    }
    return speaks & (r.head[0] != PackedRays::kFar);
  }

 private:
  static constexpr double kUnsure = 0.01, kUnsureShare = 2e-3;  // m; of a ray
  static constexpr double kLevel = 0.02;                        // m by which a ray falls: where a more level one goes through a plane is too unsure
  EightPlacing place_;
  double half_u_, half_v_, rear_, front_, side_;
  Eight beyond_, at_wall_;
  int open_;
};

BERM_APP_LANES std::size_t find_speaking(const BedPose& pose, const PackedRays& rays, std::vector<std::uint32_t>& out) {
  out.resize(rays.eights().size() * kLanes);
  const Speaks speaks(pose);
  std::size_t found = 0;
  std::uint32_t first = 0;
  for (const PackedRays::EightRays& r : rays.eights()) {
    if (const EightInt kept = speaks(r); any8(kept))
      for (int k = 0; k < static_cast<int>(kLanes); ++k) out[found] = first + static_cast<std::uint32_t>(k), found += kept[k] != 0 ? 1 : 0;
    first += kLanes;
  }
  return found;
}

}  // namespace

std::vector<BedConstraint> constraints(const BedPose& pose, const std::vector<Ray>& rays) {
  Collector collector(pose);
  for (const Ray& ray : rays) collector.take(ray);
  return std::move(collector.out);
}

FitRays::FitRays(const BedPose& start, const std::vector<Ray>& rays, const PackedRays& packed, double within, double below) {
  const std::vector<std::uint32_t> near = numbers_meeting(start, packed, within, below);
  rays_.reserve(near.size());
  packed_.reserve(near.size());
  for (const std::uint32_t k : near) {
    rays_.push_back(rays[k]);
    packed_.take(packed, k);
  }
}

std::vector<BedConstraint> FitRays::constraints(const BedPose& pose) {
  Collector collector(pose);
  const std::size_t count = find_speaking(pose, packed_, speaking_);
  for (std::size_t i = 0; i < count; ++i) collector.take(rays_[speaking_[i]]);
  return std::move(collector.out);
}

}  // namespace berm::app
