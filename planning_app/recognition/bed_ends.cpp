#include "recognition/bed_ends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "recognition/cab_profile.hpp"
#include "recognition/evidence_weights.hpp"
#include "recognition/pair_sums.hpp"

namespace berm::app {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

constexpr double kMeanFit = 2.0 / 3.0;  // of fit over its gate
constexpr float kStraight = 1e-9F;      // m: a ray whose ends differ by less goes straight across an axis
constexpr int kEndsApart = 2;  // steps
constexpr double kAsGood = 2.0;  // rays
constexpr double kCabFront = 0.2;    // m, of a return from the plane of a cab's front
constexpr SizeRange kBehindCabFront{1.3, 2.9};  // m from there to the bed's inside: the cab's length, the gap, the bed's front wall
constexpr double kAboveTop = 0.1;  // m, of a return that lies above a wall's top

// One ray in the strip's frame; t runs from the sensor, 0, to the return, 1.
struct StripRay {
  Vector3f a, d;
  float one_by_u, one_by_v, one_by_w;  // 1 over d, infinite where the ray goes straight across that axis
  float range, gate;                   // gate: in t
  float in, out;                       // t between the outer faces of the sides
  float rim;                           // t on the plane of the tops
  int near_side;                       // side that the sensor stands beyond
  bool upright;
  [[nodiscard]] Vector3f at(float t) const { return a + t * d; }
  [[nodiscard]] float u(float t) const { return a.x() + t * d.x(); }
  [[nodiscard]] bool straight_across() const { return std::isinf(one_by_u); }
  // t in which the ray goes on by half a step between ends, or by the gate.
  [[nodiscard]] float half_step() const { return std::max(gate, single(0.5 * kEndStep) * std::abs(one_by_u)); }
};

float fit_of(float off, double gate) { return 1.0F - off * off * single(1.0 / (gate * gate)); }

BedPose pose_of(const BedStrip& strip) {
  BedPose pose;
  pose.middle = strip.middle;
  pose.yaw = strip.yaw, pose.pitch = strip.pitch, pose.roll = strip.roll;
  return pose;
}

// The rays that may say something of a strip, and where along it the sensors stand that are not well beside it.
struct RaysOfStrip {
  std::vector<StripRay> rays;
  float sensor_first = kNever, sensor_last = -kNever;
};

BERM_APP_LANES RaysOfStrip rays_of(const BedStrip& strip, const PackedRays& rays) {
  RaysOfStrip out;
  out.rays.reserve(rays.eights().size() * kLanes);
  const EightPlacing place(pose_of(strip));
  const double half = strip.width / 2 + strip.thickness;
  const Eight outer = eight(half), sensor_within = eight(half + kSensorClear), never = eight(static_cast<double>(kNever));
  const Eight top = eight(kAboveTop + strip.slack);
  const EightInt behind_cab = EightInt{} - (strip.from_cab ? 1 : 0);
  Eight first = never, last = -never;
  for (const PackedRays::EightRays& r : rays.eights()) {
    const EightInt is_ray = r.head[0] != PackedRays::kFar;
    const Places a = place.of(r.head), end = place.of(r.at), d{end.u - a.u, end.v - a.v, end.w - a.w};
    const EightInt sensor = is_ray & (magnitude8(a.v) < sensor_within);
    first = choose8(sensor, least8(first, a.u), first), last = choose8(sensor, most8(last, a.u), last);
    const EightInt across_u = magnitude8(d.u) < kStraight, across_v = magnitude8(d.v) < kStraight;
    const EightInt on_left = a.v > outer, on_right = a.v < -outer, outside = on_left | on_right;
    const Eight one_by_u = 1.0F / choose8(across_u, Eight{}, d.u), one_by_v = 1.0F / choose8(across_v, Eight{}, d.v), one_by_w = 1.0F / d.w;
    const Eight to = choose8(d.v > 0.0F, outer, -outer), gate = eight(kRangeGate) / r.range;
    const Eight in = choose8(across_v, Eight{}, most8(Eight{}, (-to - a.v) * one_by_v)), out_of = choose8(across_v, never, (to - a.v) * one_by_v);
    const Eight rim = choose8(d.w < 0.0F, -a.w * one_by_w, never);
    // Such a ray says something of the strip unless it ends well before it, comes to a side below what is seen of it, or passes over all.
    const Eight entry_w = a.w + in * d.w, reach = most8(eight(kTopGate) / r.range, most8(gate, eight(0.5 * kEndStep) * magnitude8(one_by_u)));
    const EightInt to_face = outside & (rim < in), above_face = outside & ~to_face & (entry_w > top) & (magnitude8(1.0F - in) < gate);
    const EightInt ends_over = (end.w > 0.0F) & (magnitude8(end.v) <= outer);
    const EightInt says = (to_face & (entry_w >= eight(-kWallSeen))) | above_face | (~to_face & (rim < out_of)) | ends_over;
    const EightInt of_cab = behind_cab & (magnitude8(end.u) < eight(kCabFront));
    const EightInt kept = is_ray & ~of_cab & (a.w > 0.1F) & (out_of > 0.0F) & ~(across_v & outside) & (in <= 1.0F + reach) & says;
    if (!any8(kept)) continue;
    for (int k = 0; k < static_cast<int>(kLanes); ++k)
      if (kept[k] != 0)
        out.rays.push_back({{a.u[k], a.v[k], a.w[k]}, {d.u[k], d.v[k], d.w[k]}, one_by_u[k], one_by_v[k], one_by_w[k], r.range[k], gate[k], in[k], out_of[k], rim[k],
                            on_left[k] != 0 ? 1 : on_right[k] != 0 ? -1 : 0, r.upright[k] != 0});
  }
  for (int k = 0; k < static_cast<int>(kLanes); ++k) out.sensor_first = std::min(out.sensor_first, first[k]), out.sensor_last = std::max(out.sensor_last, last[k]);
  return out;
}

class Weighing {
 public:
  Weighing(const BedStrip& strip, const PackedRays& rays, const Steps& steps)
      : sums(steps), inner_(single(strip.width / 2)), outer_(single(strip.width / 2 + strip.thickness)), thickness_(single(strip.thickness)), slack_(single(strip.slack)),
        of_strip_(rays_of(strip, rays)) {
    for (const StripRay& r : of_strip_.rays) {
      take(r);
      if (r.a.z() + r.d.z() > 0.0F) over_opening(r);
      if (r.a.z() + r.d.z() > kAboveTop + slack_) above_end(r);
    }
    for (EndSums* s : {&rear_face, &front_face, &side_faces}) s->finish();
  }

  // The sensors' places along the strip, where they are not well beside it.
  [[nodiscard]] bool clear_of_sensor(double rear, double front) const {
    return of_strip_.sensor_last < rear - kSensorClear || of_strip_.sensor_first > front + kSensorClear;
  }

  PairSums sums;                  // of all but the outer faces of walls
  EndSums rear_face, front_face, side_faces;  // of these; of the sides' outer faces running along the strip
  // Returns on the sides' outer faces between the ends. share: as best_ends.
  [[nodiscard]] float sides(int rear, int front, double share) const {
    return static_cast<float>(saturated(share * static_cast<double>(side_faces.at(front) - side_faces.at(rear))) / share);
  }

 private:
  void take(const StripRay& r) {
    if (r.near_side != 0 && r.rim < r.in) {
      side_face(r);
    } else if (r.near_side != 0 && r.at(r.in).z() > single(kAboveTop) + slack_ && std::abs(1.0F - r.in) < r.gate) {
      sums.between(r.u(r.in), -thickness_, -single(kAbove));
    } else if (r.rim < r.out) {
      rim(r);
    }
  }

  // The return lies over the opening: too steep for a heap, or too high beside a wall?
  void over_opening(const StripRay& r) {
    const Vector3f end = r.a + r.d;
    const float to_side = inner_ - std::abs(end.y()), margin = single(heap_margin(static_cast<double>(end.z())));
    if (to_side < 0.0F || end.z() > single(kUprightAbove)) return;
    if (r.upright && to_side > single(kUprightMargin)) {
      sums.between(end.x(), single(kUprightMargin), -single(kUpright));
    } else if (margin > 0.0F) {
      sums.between(end.x(), 0.0F, -single(kUpright));
      if (to_side >= margin) sums.between(end.x(), margin, single(kUpright));
    }
  }

  // The return lies above an end's top, in the plane of the outer face that the ray comes to.
  void above_end(const StripRay& r) {
    const Vector3f end = r.a + r.d;
    if (std::abs(end.y()) > outer_) return;
    const float gate = r.gate * std::abs(r.d.x()), inner = end.x() + (r.d.x() > 0.0F ? thickness_ : -thickness_);
    (r.d.x() > 0.0F ? rear_face : front_face).add(inner - gate, inner + gate, -single(kAbove));
  }

  // The ray comes to a side from outside, below its top.
  void side_face(const StripRay& r) {
    const Vector3f at = r.at(r.in);
    if (at.z() < -single(kWallSeen)) return;
    if (std::abs(1.0F - r.in) <= r.gate) side_faces.add(at.x(), kNever, fit_of((1.0F - r.in) * r.range, kRangeGate));
    else if (r.in < 1.0F && at.z() < -slack_ && !below_pipe(r.a.cast<double>(), r.d.cast<double>(), outer_, r.gate))
      sums.between(at.x(), -thickness_, -single(kThrough));
    end_face(r, r.in);
  }

  // From t on the ray is below the tops and between the sides: beyond the bed it meets an end's outer face.
  void end_face(const StripRay& r, float from) {
    if (r.straight_across()) return;
    const float until = std::min(r.out, r.d.z() < 0.0F ? (-single(kWallSeen) - r.a.z()) * r.one_by_w : kNever);
    const float sure = r.d.z() < 0.0F ? (-slack_ - r.a.z()) * r.one_by_w : kNever;  // from here on below the tops whatever the slack
    EndSums& face = r.d.x() > 0.0F ? rear_face : front_face;
    const float wall = r.d.x() > 0.0F ? thickness_ : -thickness_;  // from the outer face to the inner
    const auto add = [&](float first, float last, float weight) {
      first = std::max(first, from), last = std::min(last, until);
      if (last <= first) return;
      const float a = r.u(first) + wall, b = r.u(last) + wall;
      face.add(std::min(a, b), std::max(a, b), weight);
    };
    open_end(r, std::max(sure, from), std::min({r.out, until, 1.0F + r.gate}));
    add(sure, 1.0F - r.gate, -single(kThrough));
    const float half = r.half_step();
    add(1.0F - half, 1.0F + half, single(kMeanFit) * r.gate / half);
  }

  // The ray comes down through the plane of the tops between the sides.
  void rim(const StripRay& r) {
    const Vector3f at = r.at(r.rim);
    end_face(r, r.rim);
    const float off = (1.0F - r.rim) * r.range;
    if (std::abs(at.y()) >= inner_) {
      if (off >= -single(kTopGate))
        sums.between(at.x(), -thickness_, off <= single(kTopGate) ? single(kTop) * fit_of(off, kTopGate) : slack_ > 0.0F ? 0.0F : -single(0.5 * kThrough));
      return;
    }
    const Vector3f end = r.a + r.d;
    const float to_side = inner_ - std::abs(end.y());
    if (std::abs(end.z()) < single(kLevelWithin) && to_side > single(kLevelMargin)) sums.between(end.x(), single(kLevelMargin), -single(kLevel));
    if (off < -0.1F) return;
    const float low = std::min(at.x(), end.x()), high = std::max(at.x(), end.x());
    if (to_side > 0.0F && end.z() < -single(kDeepest)) {
      sums.about(low, high, -single(kThrough));
      return;
    }
    if (r.upright && to_side > single(kUprightMargin))
      sums.about(std::min(at.x(), end.x() - single(kUprightMargin)), std::max(at.x(), end.x() + single(kUprightMargin)), -single(kUpright));
    opening(r, at.x());
  }

  // t where the ray would come to the inner face of the side that it goes to.
  [[nodiscard]] float far_side(const StripRay& r) const {
    return std::isinf(r.one_by_v) ? kNever : ((r.d.y() > 0.0F ? inner_ : -inner_) - r.a.y()) * r.one_by_v;
  }

  // Without a wall at the end between t = first and last the ray goes on within.
  void open_end(const StripRay& r, float first, float last) {
    if (r.near_side != 0) first = std::max(first, (r.near_side > 0 ? inner_ - r.a.y() : -inner_ - r.a.y()) * r.one_by_v);
    last = std::min(last, far_side(r));
    if (last <= first) return;
    const Ways& open = r.d.x() > 0.0F ? kOpenRear : kOpenFront;
    within(r, {r.u(first), r.u(last)}, r.u(first), -kNever, open, open);
  }

  // The ray enters the opening at rim_u: the end that it comes from lies behind.
  void opening(const StripRay& r, float rim_u) {
    const bool forward = r.d.x() > 0.0F;
    within(r, {forward ? -kNever : kNever, rim_u}, rim_u, (-slack_ - r.a.z()) * r.one_by_w, kAnyWay, forward ? kWithFrontWall : kWithRearWall);
  }

  // From came_in on the ray is in the bed: it ends within, or on the far side, or on the end that it goes to, which lies beyond came_in. The end that it comes from
  // lies in own, in the ray's sense. Sums of what is so whether the other end has a wall or not, and of what only such a wall says; low: t from which the
  // ray is below its top.
  void within(const StripRay& r, std::array<float, 2> own, float came_in, float low, const Ways& anyhow, const Ways& wall) {
    const bool forward = r.d.x() > 0.0F;
    const int own_from = first_end(forward ? own[0] : own[1]), own_to = first_end(forward ? own[1] : own[0]);
    if (own_to <= own_from) return;
    const float side = far_side(r), onwards = forward ? kNever : -kNever;
    const bool sure = !std::isinf(side) && r.at(side).z() < -slack_;
    const float far = side > 1.0F + r.gate   ? single(kInside)
                      : side < 1.0F - r.gate ? (sure ? -single(kThrough) : 0.0F)
                                             : single(kInside) + single(1.0 - kInside) * fit_of((1.0F - side) * r.range, kRangeGate);
    const float side_u = r.straight_across() ? came_in : std::isinf(side) ? onwards : r.u(side);
    // The end that the ray goes to lies between from and to, in the ray's sense.
    const auto add = [&](const Ways& ways, float from, float to, float weight) {
      if (forward) sums.add(own_from, own_to, first_end(std::max(from, came_in)), first_end(to), weight * ways);
      else sums.add(first_end(to), first_end(std::min(from, came_in)), own_from, own_to, weight * ways);
    };
    const auto before_side = [&](float u) { return forward ? std::min(side_u, u) : std::max(side_u, u); };
    add(anyhow, side_u, onwards, far);
    if (r.straight_across()) return;
    const float half = r.half_step();
    add(anyhow, r.u(1.0F), side_u, single(kInside));
    add(wall, r.u(low), before_side(r.u(1.0F - r.gate)), -single(kThrough));
    add(wall, r.u(1.0F - half), before_side(r.u(1.0F + half)), single((1.0 - kInside) * kMeanFit) * r.gate / half);
  }

  float inner_, outer_, thickness_, slack_;
  RaysOfStrip of_strip_;
};

// What a pair of ends is worth as a bed with both walls, and without one of them.
struct Beds {
  int rear, front;
  float closed, open_rear, open_front;
};

struct Pair {
  int rear = 0, front = 0, open_end = 0, cab_end = 0;
  float score = 0.0F, bed = 0.0F, cab = 0.0F;
};

Pair pair(const Beds& b, int open_end, int cab_end, float bed, float cab) {
  return {b.rear, b.front, open_end, cab_end, static_cast<float>(with_cab(static_cast<double>(bed), static_cast<double>(cab))), bed, cab};
}

// Near to each other at both ends, or at one and as good: what lies at the other is not seen.
bool same(const Pair& a, const Pair& b, float as_good) {
  const bool rear = std::abs(a.rear - b.rear) < kEndsApart, front = std::abs(a.front - b.front) < kEndsApart;
  return (rear && front) || ((rear || front) && std::abs(a.score - b.score) <= as_good);
}

BedPose pose_of(const BedStrip& strip, const Pair& pair) {
  BedPose p = pose_of(strip);
  p.width = strip.width, p.thickness = strip.thickness, p.open_end = pair.open_end;
  const double rear = place_of(pair.rear), front = place_of(pair.front);
  p.length = front - rear;
  p.middle += p.rotation() * Vector3d(0.5 * (rear + front), 0.0, 0.0);
  return p;
}

}  // namespace

std::vector<BedEnds> best_ends(const BedStrip& strip, const PackedRays& rays, const SizeRange& lengths, double share, std::size_t most) {
  const int shortest = static_cast<int>(lengths[0] / kEndStep), longest = std::min(static_cast<int>(std::ceil(lengths[1] / kEndStep)), kEnds - 1);
  const Weighing w(strip, rays, {shortest, longest});
  const auto open_weight = static_cast<float>(kOpenEnd / share);
  std::array<int, 2> fronts{0, kEnds - 1};
  if (strip.from_cab) fronts = {first_end(-single(kBehindCabFront[1])), first_end(-single(kBehindCabFront[0]))};
  // What each end adds to the sums of its pairs, were every return on a side's outer face to count whole: no pair is worth more.
  std::array<Ways, kEnds> of_rear, of_front;
  for (int k = 0; k < kEnds; ++k) {
    const float rear = w.rear_face.at(k), front = w.front_face.at(k), side = w.side_faces.at(k);
    of_rear[static_cast<std::size_t>(k)] = Ways{rear - side, -side - open_weight, rear - side - open_weight, -kNever};
    of_front[static_cast<std::size_t>(k)] = k < fronts[0] || k > fronts[1] ? kNoWay : Ways{front + side, front + side, side, 0.0F} + kRounding;
  }
  std::vector<Beds> beds;
  w.sums.visit(of_rear, of_front, [&](int i, int j, const Ways& sums) {
    const float rear = w.rear_face.at(i), front = w.front_face.at(j), sides = w.sides(i, j, share);
    const Beds b{i, j, sums[0] + sides + rear + front, sums[1] + sides + front - open_weight, sums[2] + sides + rear - open_weight};
    if (std::max({b.closed, b.open_rear, b.open_front}) > 0.0F && w.clear_of_sensor(place_of(i), place_of(j))) beds.push_back(b);
  });
  if (beds.empty()) return {};  // nor with any cab
  CabProfile cab(strip.width / 2, strip.width / 2 + strip.thickness);
  cab.take(pose_of(strip), rays);
  cab.finish();
  constexpr float unknown = 1e9F;
  std::array<float, kEnds> cab_front, cab_rear;  // where a bed has that end
  cab_front.fill(unknown), cab_rear.fill(unknown);
  const auto cab_at = [&](std::array<float, kEnds>& known, int end, int side) {
    float& cab_there = known[static_cast<std::size_t>(end)];
    if (cab_there == unknown) cab_there = static_cast<float>(cab.to_front(place_of(end) + side * strip.thickness, side, share));
    return cab_there;
  };
  std::vector<Pair> pairs;
  for (const Beds& b : beds) {
    const float at_front = cab_at(cab_front, b.front, 1), at_rear = cab_at(cab_rear, b.rear, -1);
    Pair p = pair(b, 0, at_front >= at_rear ? 1 : -1, b.closed, std::max(at_front, at_rear));
    for (const Pair& open : {pair(b, -1, 1, b.open_rear, at_front), pair(b, 1, -1, b.open_front, at_rear)})
      if (open.score > p.score) p = open;
    if (p.score > 0.0F) pairs.push_back(p);
  }
  const auto as_good = static_cast<float>(kAsGood / share);
  const double usual = 0.5 * (shortest + longest);
  const auto unusual = [usual](const Pair& p) { return std::abs(p.front - p.rear - usual); };
  std::vector<BedEnds> out;
  while (out.size() < most && !pairs.empty()) {
    const Pair best = *std::max_element(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.score < b.score; });
    // Of an end that no ray shows: where it makes a bed of a usual length.
    Pair chosen = best;
    for (const Pair& p : pairs)
      if ((p.rear == best.rear || p.front == best.front) && p.score >= best.score - as_good && unusual(p) < unusual(chosen)) chosen = p;
    out.push_back({pose_of(strip, chosen), chosen.cab_end, share * static_cast<double>(chosen.bed), share * static_cast<double>(chosen.cab)});
    if (out.size() < most) std::erase_if(pairs, [&](const Pair& p) { return same(chosen, p, as_good); });
  }
  return out;
}

}  // namespace berm::app
