#include "recognition/bed_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berm::app {
namespace {

constexpr double kTiltedHigher = 2.0;  // times as much as a corner the plane of the tops may rise beside a bed that is moved and tilted
constexpr double kTiltedAside = 0.15;  // m, by which faces move aside where a ray passes high over a bed that is tilted

BERM_APP_INLINE Eight fit8(Eight off, double gate) { return 1.0F - off * off * eight(1.0 / (gate * gate)); }

BERM_APP_INLINE EightInt below_pipe8(const Places& a, const Places& d, double half_outer, Eight slack) {
  const Eight z = a.w + eight(kPipeUpright), along = d.v * d.v + d.w * d.w, half = a.v * d.v + z * d.w;
  const Eight root = half * half - along * (a.v * a.v + z * z - eight(half_outer * half_outer)), beyond = along * (1.0F - slack) + half;
  return (root <= 0.0F) | ((beyond <= 0.0F) & (beyond * beyond >= root));
}

struct alignas(32) EightSums {
  Eight score{}, end_face{}, side_face{};
  EightInt outer_face{}, inner_face{}, wall_top{}, inside{}, through{}, before{}, over{}, above_face{}, above_inner{}, level_inside{}, below_inside{}, above_inside{}, not_soil{};
};

// Of all rays what they meet of the bed, and what that weighs: BedFaces::meet without branches. counted: how many of each as well.
template <bool counted>
[[gnu::always_inline]] inline BedEvidence weigh_all(const BedPose& pose, const PackedRays& rays) {
  const EightPlacing place(pose);
  const double half_length = pose.length / 2, half_width = pose.width / 2, side = pose.face(1, 1, true);
  const double rear = -pose.face(0, -1, true), front = pose.face(0, 1, true);
  const Eight open = eight(pose.open_end), gate = eight(kRangeGate), half_u = eight(half_length), half_v = eight(half_width);
  const EightInt any_open = open != 0.0F, wall_at_front = open != 1.0F, wall_at_rear = open != -1.0F;
  EightSums sums;
  for (const PackedRays::EightRays& r : rays.eights()) {
    const Places a = place.of(r.head), end = place.of(r.at), d{end.u - a.u, end.v - a.v, end.w - a.w};
    const Eight one_by_u = one_by8(d.u), one_by_v = one_by8(d.v);
    const Crossings outer(a, one_by_u, one_by_v, rear, front, side);
    const Eight in = outer.in(), out = outer.out(), entry_w = a.w + in * d.w, entry_v = a.v + in * d.v;
    const EightInt comes = (in < out) & (in > 0.0F) & (entry_w >= eight(-kWallSeen));
    if (!any8(comes)) continue;
    const EightInt by_side = outer.in_v > outer.in_u, to_open = open * d.u > 0.0F, low = comes & (entry_w < 0.0F), high = comes & ~low;
    const Eight off_entry = (1.0F - in) * r.range;
    EightInt within{}, judged = comes, passed{};  // passed: through a face from outside, or through a top
    Eight score{};

    // Comes to a face below the tops.
    if (any8(low)) {
      const EightInt hidden = low & (off_entry < -gate), open_in = low & ~hidden & any_open & ~to_open & ~by_side & (magnitude8(entry_v) < half_v);
      const EightInt at_face = low & ~hidden & ~open_in, on_outer = at_face & (off_entry <= gate);
      EightInt below_side{}, through_face = at_face & ~on_outer;
      if (const EightInt side_passed = through_face & by_side; any8(side_passed)) {
        below_side = side_passed & below_pipe8(a, d, side, gate / r.range);
        through_face &= ~below_side;
      }
      const Eight fits = fit8(off_entry, kRangeGate);
      sums.end_face += where8(on_outer & ~by_side, fits);
      sums.side_face += where8(on_outer & by_side, fits);
      score -= where8(through_face, eight(kThrough));
      within = open_in, judged &= ~on_outer & ~below_side, passed = through_face;
      if constexpr (counted) sums.before -= hidden, sums.outer_face -= on_outer, sums.through -= through_face;
    }

    // Or above them, and down through their plane.
    if (any8(high)) {
      const EightInt above = high & (entry_w > 0.1F) & (magnitude8(off_entry) < gate), reaches = high & ~above & (off_entry >= -gate);
      const Eight to_rim = -a.w / choose8(d.w < 0.0F, d.w, eight(-1.0)), rim_u = a.u + to_rim * d.u, rim_v = a.v + to_rim * d.v;
      const EightInt down = reaches & (d.w < 0.0F) & (to_rim < out), over_opening = (magnitude8(rim_u) < half_u) & (magnitude8(rim_v) < half_v);
      const Eight off_rim = (1.0F - to_rim) * r.range;
      const EightInt rim_in = down & over_opening & (off_rim >= -0.1F);
      const EightInt at_top = down & ~over_opening & (off_rim >= eight(-kTopGate)), on_top = at_top & (off_rim <= eight(kTopGate)), through_top = at_top & ~on_top;
      score -= where8(above, eight(kAbove));
      score += where8(on_top, eight(kTop) * fit8(off_rim, kTopGate));
      score -= where8(through_top, eight(0.5 * kThrough));
      within |= rim_in, passed |= through_top;
      if constexpr (counted) {
        const EightInt not_down = reaches & ~down, before = (d.w < 0.0F) & (out > 1.0F);
        sums.above_face -= above, sums.wall_top -= on_top, sums.through -= through_top;
        sums.before -= (high & ~above & ~reaches) | (not_down & before) | (down & ~rim_in & ~at_top);
        sums.over -= not_down & ~before;
      }
    }

    // From within: stopped by load or floor, by the face that it comes to, or not at all.
    if (any8(within)) {
      const Crossings inner(a, one_by_u, one_by_v, -half_length, half_length, half_width);
      const Eight off = (1.0F - inner.out()) * r.range;
      const EightInt leaves_open = to_open & ~(inner.out_v < inner.out_u), far_enough = off <= gate, stopped = within & ((off < -gate) | (leaves_open & far_enough));
      const EightInt on_inner = within & ~stopped & ~leaves_open & far_enough, passes = within & ~leaves_open & ~far_enough, too_deep = stopped & (end.w < eight(-kDeepest));
      score += where8(stopped, choose8(too_deep, eight(-kThrough), eight(kInside)));
      score += where8(on_inner, eight(kInside) + eight(1.0 - kInside) * fit8(off, kRangeGate));
      score -= where8(passes, eight(kThrough));
      if constexpr (counted) sums.inside -= stopped & ~too_deep, sums.inner_face -= on_inner, sums.through -= too_deep | passes, sums.over -= within & leaves_open & ~far_enough;
    }

    // The return's own place: in the plane of a far wall's inner face, but above its top, where no heap comes so high; too steep for soil; level with the tops.
    const Eight from_end = magnitude8(end.u), from_side = magnitude8(end.v), to_wall = least8(half_u - from_end, half_v - from_side);
    const EightInt amid = judged & (to_wall >= eight(kLevelMargin));
    if (any8(judged & (r.upright | (end.w > eight(-kLevelWithin))))) {
      const Eight on_near = eight(kInnerGate);
      const EightInt at_ends = (from_side < half_v) & ((wall_at_front & (a.u < half_u) & (magnitude8(end.u - half_u) < on_near)) |
                                                      (wall_at_rear & (a.u > -half_u) & (magnitude8(end.u + half_u) < on_near)));
      const EightInt at_sides = (from_end < half_u) & (((a.v < half_v) & (magnitude8(end.v - half_v) < on_near)) | ((a.v > -half_v) & (magnitude8(end.v + half_v) < on_near)));
      const EightInt above_inner = judged & (end.w >= eight(kAboveInner)) & (end.w <= eight(kAboveInnerMost)) & (at_ends | at_sides);
      const EightInt steep = (r.upright & (to_wall > eight(kUprightMargin))) | (to_wall < (end.w - eight(kHeapOver)) * eight(1.0 / kHeapSlope));
      const EightInt not_soil = judged & ~passed & steep & (to_wall >= 0.0F) & (end.w > eight(-kDeepest)) & (end.w < eight(kUprightAbove));
      const EightInt level = amid & (magnitude8(end.w) < eight(kLevelWithin));
      score -= where8(above_inner, eight(kAbove)) + where8(not_soil, eight(kUpright)) + where8(level, eight(kLevel));
      if constexpr (counted) sums.above_inner -= above_inner, sums.not_soil -= not_soil, sums.level_inside -= level;
    }
    if constexpr (counted) sums.below_inside -= amid & (end.w < eight(-kLevelWithin)), sums.above_inside -= amid & (end.w > eight(kLevelWithin));
    sums.score += score;
  }
  BedEvidence e;
  const auto sum = [](const Eight& lanes) { return static_cast<double>(sum8(lanes)); };
  e.end_face = saturated(sum(sums.end_face));
  e.score = sum(sums.score) + e.end_face + saturated(sum(sums.side_face));
  if (pose.open_end != 0) e.score -= kOpenEnd;
  e.score -= tilt_cost(pose.pitch, pose.roll);
  if constexpr (counted) {
    e.outer_face = sum8(sums.outer_face), e.inner_face = sum8(sums.inner_face), e.wall_top = sum8(sums.wall_top), e.inside = sum8(sums.inside);
    e.through = sum8(sums.through), e.before = sum8(sums.before), e.over = sum8(sums.over), e.above_face = sum8(sums.above_face);
    e.above_inner = sum8(sums.above_inner), e.level_inside = sum8(sums.level_inside), e.below_inside = sum8(sums.below_inside);
    e.above_inside = sum8(sums.above_inside), e.not_soil = sum8(sums.not_soil);
  }
  return e;
}

// Which of the rays come within so many metres of the bed's outer faces, in plan, and there no lower than so many below what is seen of the walls.
class alignas(32) Meets {
 public:
  Meets(const BedPose& pose, double within, double below)
      : place_(pose), u_(pose.length / 2 + pose.thickness + within), v_(pose.width / 2 + pose.thickness + within), lowest_(eight(-kWallSeen - below)) {}
  [[nodiscard, gnu::always_inline]] EightInt operator()(const PackedRays::EightRays& r) const {
    const Way way = way_of(r);
    return (way.from < way.to) & (way.highest >= lowest_);
  }
  // Without those that end before they come there, and those that pass over it by so much, in metres, and end beyond.
  [[nodiscard, gnu::always_inline]] EightInt and_tells(const PackedRays::EightRays& r, Eight over) const {
    const Way way = way_of(r);
    return (way.from < way.to) & (way.highest >= lowest_) & (way.from <= 1.0F) & ((way.to >= 1.0F) | (way.lowest <= over));
  }

 private:
  struct alignas(32) Way {
    Eight from, to, highest, lowest;  // in shares of the ray; over the tops
  };
  [[nodiscard, gnu::always_inline]] Way way_of(const PackedRays::EightRays& r) const {
    const Places a = place_.of(r.head), end = place_.of(r.at);
    const Eight fall = end.w - a.w;
    const Crossings crossing(a, one_by8(end.u - a.u), one_by8(end.v - a.v), -u_, u_, v_);
    const Eight from = most8(crossing.in(), Eight{}), to = crossing.out(), w_from = a.w + from * fall, w_to = a.w + to * fall;
    return {from, to, most8(w_from, w_to), least8(w_from, w_to)};
  }
  EightPlacing place_;
  double u_, v_;
  Eight lowest_;
};

}  // namespace

PackedRays::PackedRays(const std::vector<Ray>& rays) {
  reserve(rays.size());
  for (const Ray& ray : rays) add(ray.head, ray.at, ray.upright);
}

BERM_APP_LANES PackedRays PackedRays::meeting(const BedPose& pose, double moved) const {
  PackedRays out;
  out.eights_.reserve(eights_.size());
  const Meets meets(pose, moved + kTiltedAside, moved);
  const Eight over = eight(kTiltedHigher * moved);
  for (std::size_t i = 0; i < eights_.size(); ++i) {
    const EightInt kept = meets.and_tells(eights_[i], over);
    if (!any8(kept)) continue;
    for (int k = 0; k < static_cast<int>(kLanes); ++k)
      if (kept[k] != 0) out.take(*this, i * kLanes + static_cast<std::size_t>(k));
  }
  return out;
}

BERM_APP_LANES std::vector<std::uint32_t> numbers_meeting(const BedPose& pose, const PackedRays& rays, double within, double below) {
  std::vector<std::uint32_t> out(rays.eights().size() * kLanes);
  const Meets meets(pose, within, below);
  std::size_t found = 0;
  std::uint32_t first = 0;
  for (const PackedRays::EightRays& r : rays.eights()) {
    const EightInt kept = meets(r) & (r.head[0] != PackedRays::kFar);
    for (int k = 0; k < static_cast<int>(kLanes); ++k) out[found] = first + static_cast<std::uint32_t>(k), found += kept[k] != 0 ? 1 : 0;
    first += kLanes;
  }
  out.resize(found);
  return out;
}

BERM_APP_LANES BedEvidence weigh(const BedPose& pose, const PackedRays& rays) { return weigh_all<true>(pose, rays); }
BERM_APP_LANES BedScore score_with_ends(const BedPose& pose, const PackedRays& rays) { return weigh_all<false>(pose, rays); }
BERM_APP_LANES double score_of(const BedPose& pose, const PackedRays& rays) { return weigh_all<false>(pose, rays).score; }
BedEvidence weigh(const BedPose& pose, const std::vector<Ray>& rays) { return weigh(pose, PackedRays(rays)); }

}  // namespace berm::app
