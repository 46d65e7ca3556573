#include "recognition/bed_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berm::app {
namespace {

constexpr double kTiltedAside = 0.15;  // m, by which faces move aside where a ray passes high over a bed that is tilted
constexpr float kAlong = 1e-12F;       // m: a ray whose ends differ by less goes along the faces of an axis

// Places of four rays by axis, in a bed's frame.
struct Places {
  Four u, v, w;
};

class FourPlacing {
 public:
  explicit FourPlacing(const BedPose& pose) {
    const Eigen::Matrix3d turn = pose.rotation().transpose();
    const Eigen::Vector3d shift = -(turn * pose.middle);
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 3; ++k) turn_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(k)] = four(turn(axis, k));
      shift_[static_cast<std::size_t>(axis)] = four(shift[axis]);
    }
  }
  [[nodiscard]] Places of(const std::array<Four, 3>& at) const { return {along(0, at), along(1, at), along(2, at)}; }

 private:
  [[nodiscard]] Four along(std::size_t axis, const std::array<Four, 3>& at) const {
    return turn_[axis][0] * at[0] + turn_[axis][1] * at[1] + turn_[axis][2] * at[2] + shift_[axis];
  }
  std::array<std::array<Four, 3>, 3> turn_;
  std::array<Four, 3> shift_;
};

// The rays' ways through a rectangle of faces in plan, as in bed_model.cpp.
struct Crossings {
  Four in_u, out_u, in_v, out_v;
  Crossings(const Places& a, Four one_by_u, Four one_by_v, double rear, double front, double side) {
    const Four r = (four(rear) - a.u) * one_by_u, f = (four(front) - a.u) * one_by_u, right = (four(-side) - a.v) * one_by_v, left = (four(side) - a.v) * one_by_v;
    in_u = least4(r, f), out_u = most4(r, f), in_v = least4(right, left), out_v = most4(right, left);
  }
  [[nodiscard]] Four in() const { return most4(in_u, in_v); }
  [[nodiscard]] Four out() const { return least4(out_u, out_v); }
};

Four one_by(Four d) { return 1.0F / choose4(magnitude4(d) < kAlong, four(static_cast<double>(kAlong)), d); }
Four fit4(Four off, double gate) { return 1.0F - off * off * four(1.0 / (gate * gate)); }

FourInt below_pipe4(const Places& a, const Places& d, double half_outer, Four slack) {
  const Four z = a.w + four(kPipeUpright), along = d.v * d.v + d.w * d.w, half = a.v * d.v + z * d.w;
  const Four root = half * half - along * (a.v * a.v + z * z - four(half_outer * half_outer)), beyond = along * (1.0F - slack) + half;
  return (root <= 0.0F) | ((beyond <= 0.0F) & (beyond * beyond >= root));
}

struct FourSums {
  Four score{}, end_face{}, side_face{};
  FourInt outer_face{}, inner_face{}, wall_top{}, inside{}, through{}, before{}, over{}, above_face{}, above_inner{}, level_inside{}, below_inside{}, above_inside{}, not_soil{};
};

// Of all rays what they meet of the bed, and what that weighs: BedFaces::meet without branches. counted: how many of each as well.
template <bool counted>
[[gnu::always_inline]] inline BedEvidence weigh_all(const BedPose& pose, const PackedRays& rays) {
  const FourPlacing place(pose);
  const double half_length = pose.length / 2, half_width = pose.width / 2, side = pose.face(1, 1, true);
  const double rear = -pose.face(0, -1, true), front = pose.face(0, 1, true);
  const Four open = four(pose.open_end), gate = four(kRangeGate), half_u = four(half_length), half_v = four(half_width);
  const FourInt any_open = open != 0.0F, wall_at_front = open != 1.0F, wall_at_rear = open != -1.0F;
  FourSums sums;
  for (const PackedRays::FourRays& r : rays.fours()) {
    const Places a = place.of(r.head), end = place.of(r.at), d{end.u - a.u, end.v - a.v, end.w - a.w};
    const Four one_by_u = one_by(d.u), one_by_v = one_by(d.v);
    const Crossings outer(a, one_by_u, one_by_v, rear, front, side);
    const Four in = outer.in(), out = outer.out(), entry_w = a.w + in * d.w, entry_v = a.v + in * d.v;
    const FourInt comes = (in < out) & (in > 0.0F) & (entry_w >= four(-kWallSeen));
    if (!any4(comes)) continue;
    const FourInt by_side = outer.in_v > outer.in_u, to_open = open * d.u > 0.0F, low = comes & (entry_w < 0.0F), high = comes & ~low;
    const Four off_entry = (1.0F - in) * r.range;
    FourInt within{}, judged = comes, passed{};  // passed: through a face from outside, or through a top
    Four score{};

    // Comes to a face below the tops.
    if (any4(low)) {
      const FourInt hidden = low & (off_entry < -gate), open_in = low & ~hidden & any_open & ~to_open & ~by_side & (magnitude4(entry_v) < half_v);
      const FourInt at_face = low & ~hidden & ~open_in, on_outer = at_face & (off_entry <= gate);
      FourInt below_side{}, through_face = at_face & ~on_outer;
      if (const FourInt side_passed = through_face & by_side; any4(side_passed)) {
        below_side = side_passed & below_pipe4(a, d, side, gate / r.range);
        through_face &= ~below_side;
      }
      const Four fits = fit4(off_entry, kRangeGate);
      sums.end_face += where4(on_outer & ~by_side, fits);
      sums.side_face += where4(on_outer & by_side, fits);
      score -= where4(through_face, four(kThrough));
      within = open_in, judged &= ~on_outer & ~below_side, passed = through_face;
      if constexpr (counted) sums.before -= hidden, sums.outer_face -= on_outer, sums.through -= through_face;
    }

    // Or above them, and down through their plane.
    if (any4(high)) {
      const FourInt above = high & (entry_w > 0.1F) & (magnitude4(off_entry) < gate), reaches = high & ~above & (off_entry >= -gate);
      const Four to_rim = -a.w / choose4(d.w < 0.0F, d.w, four(-1.0)), rim_u = a.u + to_rim * d.u, rim_v = a.v + to_rim * d.v;
      const FourInt down = reaches & (d.w < 0.0F) & (to_rim < out), over_opening = (magnitude4(rim_u) < half_u) & (magnitude4(rim_v) < half_v);
      const Four off_rim = (1.0F - to_rim) * r.range;
      const FourInt rim_in = down & over_opening & (off_rim >= -0.1F);
      const FourInt at_top = down & ~over_opening & (off_rim >= four(-kTopGate)), on_top = at_top & (off_rim <= four(kTopGate)), through_top = at_top & ~on_top;
      score -= where4(above, four(kAbove));
      score += where4(on_top, four(kTop) * fit4(off_rim, kTopGate));
      score -= where4(through_top, four(0.5 * kThrough));
      within |= rim_in, passed |= through_top;
      if constexpr (counted) {
        const FourInt not_down = reaches & ~down, before = (d.w < 0.0F) & (out > 1.0F);
        sums.above_face -= above, sums.wall_top -= on_top, sums.through -= through_top;
        sums.before -= (high & ~above & ~reaches) | (not_down & before) | (down & ~rim_in & ~at_top);
        sums.over -= not_down & ~before;
      }
    }

    // From within: stopped by load or floor, by the face that it comes to, or not at all.
    if (any4(within)) {
      const Crossings inner(a, one_by_u, one_by_v, -half_length, half_length, half_width);
      const Four off = (1.0F - inner.out()) * r.range;
      const FourInt leaves_open = to_open & ~(inner.out_v < inner.out_u), far_enough = off <= gate, stopped = within & ((off < -gate) | (leaves_open & far_enough));
      const FourInt on_inner = within & ~stopped & ~leaves_open & far_enough, passes = within & ~leaves_open & ~far_enough, too_deep = stopped & (end.w < four(-kDeepest));
      score += where4(stopped, choose4(too_deep, four(-kThrough), four(kInside)));
      score += where4(on_inner, four(kInside) + four(1.0 - kInside) * fit4(off, kRangeGate));
      score -= where4(passes, four(kThrough));
      if constexpr (counted) sums.inside -= stopped & ~too_deep, sums.inner_face -= on_inner, sums.through -= too_deep | passes, sums.over -= within & leaves_open & ~far_enough;
    }

    // The return's own place: in the plane of a far wall's inner face, but above its top, where no heap comes so high; too steep for soil; level with the tops.
    const Four from_end = magnitude4(end.u), from_side = magnitude4(end.v), to_wall = least4(half_u - from_end, half_v - from_side);
    const FourInt amid = judged & (to_wall >= four(kLevelMargin));
    if (any4(judged & (r.upright | (end.w > four(-kLevelWithin))))) {
      const Four on_near = four(kInnerGate);
      const FourInt at_ends = (from_side < half_v) & ((wall_at_front & (a.u < half_u) & (magnitude4(end.u - half_u) < on_near)) |
                                                      (wall_at_rear & (a.u > -half_u) & (magnitude4(end.u + half_u) < on_near)));
      const FourInt at_sides = (from_end < half_u) & (((a.v < half_v) & (magnitude4(end.v - half_v) < on_near)) | ((a.v > -half_v) & (magnitude4(end.v + half_v) < on_near)));
      const FourInt above_inner = judged & (end.w >= four(kAboveInner)) & (end.w <= four(kAboveInnerMost)) & (at_ends | at_sides);
      const FourInt steep = (r.upright & (to_wall > four(kUprightMargin))) | (to_wall < (end.w - four(kHeapOver)) * four(1.0 / kHeapSlope));
      const FourInt not_soil = judged & ~passed & steep & (to_wall >= 0.0F) & (end.w > four(-kDeepest)) & (end.w < four(kUprightAbove));
      const FourInt level = amid & (magnitude4(end.w) < four(kLevelWithin));
      score -= where4(above_inner, four(kAbove)) + where4(not_soil, four(kUpright)) + where4(level, four(kLevel));
      if constexpr (counted) sums.above_inner -= above_inner, sums.not_soil -= not_soil, sums.level_inside -= level;
    }
    if constexpr (counted) sums.below_inside -= amid & (end.w < four(-kLevelWithin)), sums.above_inside -= amid & (end.w > four(kLevelWithin));
    sums.score += score;
  }
  BedEvidence e;
  const auto sum = [](Four lanes) { return static_cast<double>(sum4(lanes)); };
  e.score = sum(sums.score) + saturated(sum(sums.end_face)) + saturated(sum(sums.side_face));
  if (pose.open_end != 0) e.score -= kOpenEnd;
  if constexpr (counted) {
    e.outer_face = sum4(sums.outer_face), e.inner_face = sum4(sums.inner_face), e.wall_top = sum4(sums.wall_top), e.inside = sum4(sums.inside);
    e.through = sum4(sums.through), e.before = sum4(sums.before), e.over = sum4(sums.over), e.above_face = sum4(sums.above_face);
    e.above_inner = sum4(sums.above_inner), e.level_inside = sum4(sums.level_inside), e.below_inside = sum4(sums.below_inside);
    e.above_inside = sum4(sums.above_inside), e.not_soil = sum4(sums.not_soil);
  }
  return e;
}

// Which of the rays may meet the bed.
class Meets {
 public:
  Meets(const BedPose& pose, double moved) : place_(pose), u_(pose.length / 2 + pose.thickness + moved + kTiltedAside), v_(pose.width / 2 + pose.thickness + moved + kTiltedAside), lowest_(four(-kWallSeen - moved)) {}
  [[nodiscard]] FourInt operator()(const PackedRays::FourRays& r) const {
    const Places a = place_.of(r.head), end = place_.of(r.at);
    const Four fall = end.w - a.w;
    const Crossings crossing(a, one_by(end.u - a.u), one_by(end.v - a.v), -u_, u_, v_);
    const Four from = most4(crossing.in(), Four{}), to = crossing.out(), highest = a.w + choose4(fall < 0.0F, from, to) * fall;
    return (from < to) & (highest >= lowest_);
  }

 private:
  FourPlacing place_;
  double u_, v_;
  Four lowest_;
};

// Packs rays one after the other.
class Packer {
 public:
  explicit Packer(std::vector<PackedRays::FourRays>& out) : out_(out) {}
  void take(const float (&numbers)[7], std::int32_t upright) {
    if (lane_ == 0) out_.push_back(kNothing);
    PackedRays::FourRays& last = out_.back();
    for (std::size_t k = 0; k < 3; ++k) last.head[k][lane_] = numbers[k], last.at[k][lane_] = numbers[3 + k];
    last.range[lane_] = numbers[6];
    last.upright[lane_] = upright;
    lane_ = (lane_ + 1) % 4;
  }

 private:
  // A ray of no length, so far off that it meets no bed.
  static constexpr Four kFar{1e6F, 1e6F, 1e6F, 1e6F}, kOne{1.0F, 1.0F, 1.0F, 1.0F};
  static constexpr PackedRays::FourRays kNothing{{kFar, kFar, kFar}, {kFar, kFar, kFar}, kOne, {}};
  std::vector<PackedRays::FourRays>& out_;
  int lane_ = 0;
};

}  // namespace

PackedRays::PackedRays(const std::vector<Ray>& rays) {
  fours_.reserve(rays.size() / 4 + 1);
  Packer packer(fours_);
  for (const Ray& ray : rays) {
    const auto of = [](double x) { return static_cast<float>(x); };
    packer.take({of(ray.head.x()), of(ray.head.y()), of(ray.head.z()), of(ray.at.x()), of(ray.at.y()), of(ray.at.z()), of((ray.at - ray.head).norm())}, ray.upright ? -1 : 0);
  }
}

BERM_APP_LANES PackedRays PackedRays::meeting(const BedPose& pose, double moved) const {
  PackedRays out;
  out.fours_.reserve(fours_.size());
  const Meets meets(pose, moved);
  Packer packer(out.fours_);
  for (const FourRays& r : fours_) {
    const FourInt kept = meets(r);
    for (int k = 0; k < 4; ++k)
      if (kept[k] != 0) packer.take({r.head[0][k], r.head[1][k], r.head[2][k], r.at[0][k], r.at[1][k], r.at[2][k], r.range[k]}, r.upright[k]);
  }
  return out;
}

BERM_APP_LANES BedEvidence weigh(const BedPose& pose, const PackedRays& rays) { return weigh_all<true>(pose, rays); }
BERM_APP_LANES double score_of(const BedPose& pose, const PackedRays& rays) { return weigh_all<false>(pose, rays).score; }
BedEvidence weigh(const BedPose& pose, const std::vector<Ray>& rays) { return weigh(pose, PackedRays(rays)); }

}  // namespace berm::app
