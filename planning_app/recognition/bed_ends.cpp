#include "recognition/bed_ends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "recognition/cab_profile.hpp"
#include "recognition/evidence_weights.hpp"

namespace berm::app {
namespace {

using Eigen::Vector3d;

constexpr double kEndStep = 0.1;  // m between ends
constexpr int kEnds = static_cast<int>(2 * kEndReach / kEndStep) + 1;
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kMeanFit = 2.0 / 3.0;  // of fit over its gate
constexpr int kEndsApart = 2;  // steps
constexpr double kAsGood = 2.0;  // rays
constexpr double kCabFront = 0.2;    // m, of a return from the plane of a cab's front
constexpr SizeRange kBehindCabFront{1.3, 2.9};  // m from there to the bed's inside: the cab's length, the gap, the bed's front wall
constexpr double kAboveTop = 0.1;  // m, of a return that lies above a wall's top

double place_of(int end) { return -kEndReach + kEndStep * end; }
// The first end at or beyond u; kEnds when there is none.
int first_end(double u) {
  const double k = std::clamp((u + kEndReach) * (1.0 / kEndStep), 0.0, static_cast<double>(kEnds));
  const int whole = static_cast<int>(k);
  return whole + (whole < k ? 1 : 0);
}

// Sums of weights over ends.
class EndSums {
 public:
  // For the ends in [from, to).
  void add(double from, double to, double weight) {
    const int a = first_end(from), b = first_end(to);
    if (b <= a) return;
    sum_[static_cast<std::size_t>(a)] += static_cast<float>(weight);
    sum_[static_cast<std::size_t>(b)] -= static_cast<float>(weight);
  }
  void finish() {
    for (std::size_t k = 1; k < sum_.size(); ++k) sum_[k] += sum_[k - 1];
  }
  [[nodiscard]] float at(int end) const { return sum_[static_cast<std::size_t>(end)]; }

 private:
  std::array<float, kEnds + 1> sum_{};
};

// Lengths of beds, in steps between their ends.
struct Steps {
  int shortest, longest;
};

// Which of a pair's ends have a wall: both, the front one alone, the rear one alone; the fourth makes it a vector register.
using Ways = Eigen::Array4f;
const Ways kAnyWay(1.0F, 1.0F, 1.0F, 0.0F), kWithRearWall(1.0F, 0.0F, 1.0F, 0.0F), kWithFrontWall(1.0F, 1.0F, 0.0F, 0.0F);
const Ways kOpenRear(0.0F, 1.0F, 0.0F, 0.0F), kOpenFront(0.0F, 0.0F, 1.0F, 0.0F);

// Sums of weights, of each way, over pairs of ends (rear, front) that are a bed's length apart: a band beside the table's diagonal. A corner of a rectangle stands for
// all pairs at or beyond it at both ends, so it may as well lie where the first of these lie in the band.
class PairSums {
 public:
  explicit PairSums(const Steps& steps) : shortest_(steps.shortest), longest_(steps.longest), width_(longest_ - shortest_ + 1), sum_(static_cast<std::size_t>(kEnds * width_), Ways::Zero()) {}
  // For the rear ends in [rear_from, rear_to) with the front ends in [front_from, front_to).
  void add(double rear_from, double rear_to, double front_from, double front_to, double weight, const Ways& ways) {
    const int a = first_end(rear_from), b = first_end(rear_to), c = first_end(front_from), d = first_end(front_to);
    if (b <= a || d <= c) return;
    const Ways w = static_cast<float>(weight) * ways;
    corner(a, c, w);
    corner(b, c, -w);
    corner(a, d, -w);
    corner(b, d, w);
  }
  void finish() {
    std::vector<Ways> column(static_cast<std::size_t>(kEnds + longest_ + 1), Ways::Zero());  // of each front end, of the rear ends until now
    Ways before = Ways::Zero();                                                             // all front ends nearer than the shortest
    for (int rear = 0; rear < kEnds; ++rear) {
      Ways row = before;
      Ways *const here = &sum_[static_cast<std::size_t>(rear * width_)], *const ends = &column[static_cast<std::size_t>(rear + shortest_)];
      for (int k = 0; k < width_; ++k) {
        ends[k] += here[k];
        row += ends[k];
        here[k] = row;
      }
      before += ends[0];
    }
  }
  [[nodiscard]] const Ways& at(int rear, int front) const { return sum_[static_cast<std::size_t>(rear * width_ + front - rear - shortest_)]; }

 private:
  void corner(int rear, int front, const Ways& weight) {
    const int row = std::max(rear, front - longest_), column = std::max(front, row + shortest_);
    if (row < kEnds && front < kEnds) sum_[static_cast<std::size_t>(row * width_ + column - row - shortest_)] += weight;
  }
  int shortest_, longest_, width_;
  std::vector<Ways> sum_;
};

// One ray in the strip's frame; t runs from the sensor, 0, to the return, 1.
struct StripRay {
  Vector3d a, d;
  double range = 0.0, gate = 0.0;           // gate: in t
  double in = 0.0, out = kNever;            // t between the outer faces of the sides
  double rim = kNever;                      // t on the plane of the tops
  int near_side = 0;                        // side that the sensor stands beyond
  [[nodiscard]] Vector3d at(double t) const { return a + t * d; }
  [[nodiscard]] double u(double t) const { return a.x() + t * d.x(); }
};

BedPose pose_of(const BedStrip& strip) {
  BedPose pose;
  pose.middle = strip.middle;
  pose.yaw = strip.yaw, pose.pitch = strip.pitch, pose.roll = strip.roll;
  return pose;
}

CabProfile cab_of(const BedStrip& strip, const std::vector<Ray>& rays) {
  CabProfile cab(strip.width / 2, strip.width / 2 + strip.thickness);
  RayPlacing place(pose_of(strip));
  for (const Ray& ray : rays) {
    const Vector3d& a = place.head(ray);
    cab.take(a, place.end(ray) - a, ray.upright);
  }
  cab.finish();
  return cab;
}

class Weighing {
 public:
  Weighing(const BedStrip& strip, const std::vector<Ray>& rays, const Steps& steps)
      : sums(steps), inner_(strip.width / 2), outer_(inner_ + strip.thickness), thickness_(strip.thickness), slack_(strip.slack) {
    RayPlacing place(pose_of(strip));
    for (const Ray& ray : rays) {
      StripRay r;
      r.a = place.head(ray);
      r.d = place.end(ray) - r.a;
      if (std::abs(r.a.y()) < outer_ + kSensorClear) sensor_first_ = std::min(sensor_first_, r.a.x()), sensor_last_ = std::max(sensor_last_, r.a.x());
      if (strip.from_cab && std::abs(r.u(1.0)) < kCabFront) continue;  // of the cab
      if (!enter(r)) continue;
      take(r, ray.upright);
      if (r.a.z() + r.d.z() > 0.0) over_opening(r, ray.upright);
      if (r.a.z() + r.d.z() > kAboveTop + slack_) above_end(r);
    }
    sums.finish();
    for (EndSums* s : {&rear_face, &front_face, &side_faces}) s->finish();
  }

  // The sensors' places along the strip, where they are not well beside it.
  [[nodiscard]] bool clear_of_sensor(double rear, double front) const {
    return sensor_last_ < rear - kSensorClear || sensor_first_ > front + kSensorClear;
  }

  PairSums sums;                  // of all but the outer faces of walls
  EndSums rear_face, front_face;  // of these
  // Returns on the sides' outer faces between the ends. share: as best_ends.
  [[nodiscard]] float sides(int rear, int front, double share) const {
    return static_cast<float>(saturated(share * static_cast<double>(side_faces.at(front) - side_faces.at(rear))) / share);
  }

 private:
  EndSums side_faces;               // running along the strip

  // False when the ray has nothing to say of this strip.
  bool enter(StripRay& r) const {
    if (r.a.z() <= 0.1) return false;
    if (r.a.y() > outer_) r.near_side = 1;
    if (r.a.y() < -outer_) r.near_side = -1;
    if (std::abs(r.d.y()) > 1e-9) {
      const double to = r.d.y() > 0.0 ? 1.0 : -1.0;
      r.in = std::max(0.0, (-to * outer_ - r.a.y()) / r.d.y());
      r.out = (to * outer_ - r.a.y()) / r.d.y();
      if (r.out <= 0.0) return false;
    } else if (r.near_side != 0) {
      return false;
    }
    if (r.d.z() < 0.0) r.rim = -r.a.z() / r.d.z();
    r.range = r.d.norm();
    r.gate = kRangeGate / r.range;
    return true;
  }

  // For the pairs that have u between them, by so much at least (less than 0: beyond them).
  void between(double u, double margin, double weight) { sums.add(-kNever, u - margin, u + margin, kNever, weight, kAnyWay); }

  void take(const StripRay& r, bool is_upright) {
    if (r.near_side != 0 && r.rim < r.in) {
      side_face(r);
    } else if (r.near_side != 0 && r.at(r.in).z() > kAboveTop + slack_ && std::abs(1.0 - r.in) < r.gate) {
      between(r.u(r.in), -thickness_, -kAbove);
    } else if (r.rim < r.out) {
      rim(r, is_upright);
    }
  }

  // The return lies over the opening: too steep for a heap, or too high beside a wall?
  void over_opening(const StripRay& r, bool is_upright) {
    const Vector3d end = r.a + r.d;
    const double to_side = inner_ - std::abs(end.y()), margin = heap_margin(end.z());
    if (to_side < 0.0 || end.z() > kUprightAbove) return;
    if (is_upright && to_side > kUprightMargin) {
      between(end.x(), kUprightMargin, -kUpright);
    } else if (margin > 0.0) {
      between(end.x(), 0.0, -kUpright);
      if (to_side >= margin) between(end.x(), margin, kUpright);
    }
  }

  // The return lies above an end's top, in the plane of the outer face that the ray comes to.
  void above_end(const StripRay& r) {
    const Vector3d end = r.a + r.d;
    if (std::abs(end.y()) > outer_) return;
    const double gate = r.gate * std::abs(r.d.x()), inner = end.x() + (r.d.x() > 0.0 ? thickness_ : -thickness_);
    (r.d.x() > 0.0 ? rear_face : front_face).add(inner - gate, inner + gate, -kAbove);
  }

  // The ray comes to a side from outside, below its top.
  void side_face(const StripRay& r) {
    const Vector3d at = r.at(r.in);
    if (at.z() < -kWallSeen) return;
    if (std::abs(1.0 - r.in) <= r.gate) side_faces.add(at.x(), kNever, fit((1.0 - r.in) * r.range, kRangeGate));
    else if (r.in < 1.0 && at.z() < -slack_ && !below_pipe(r.a, r.d, outer_, r.gate)) between(at.x(), -thickness_, -kThrough);
    end_face(r, r.in);
  }

  // From t on the ray is below the tops and between the sides: beyond the bed it meets an end's outer face.
  void end_face(const StripRay& r, double from) {
    if (std::abs(r.d.x()) < 1e-9) return;
    const double until = std::min(r.out, r.d.z() < 0.0 ? (-kWallSeen - r.a.z()) / r.d.z() : kNever);
    const double sure = r.d.z() < 0.0 ? (-slack_ - r.a.z()) / r.d.z() : kNever;  // from here on below the tops whatever the slack
    EndSums& face = r.d.x() > 0.0 ? rear_face : front_face;
    const double wall = r.d.x() > 0.0 ? thickness_ : -thickness_;  // from the outer face to the inner
    const auto add = [&](double first, double last, double weight) {
      first = std::max(first, from), last = std::min(last, until);
      if (last <= first) return;
      const double a = r.u(first) + wall, b = r.u(last) + wall;
      face.add(std::min(a, b), std::max(a, b), weight);
    };
    open_end(r, std::max(sure, from), std::min({r.out, until, 1.0 + r.gate}));
    add(sure, 1.0 - r.gate, -kThrough);
    const double half = std::max(r.gate, 0.5 * kEndStep / std::abs(r.d.x()));
    add(1.0 - half, 1.0 + half, kMeanFit * r.gate / half);
  }

  // The ray comes down through the plane of the tops between the sides.
  void rim(const StripRay& r, bool is_upright) {
    const Vector3d at = r.at(r.rim);
    end_face(r, r.rim);
    const double off = (1.0 - r.rim) * r.range;
    if (std::abs(at.y()) >= inner_) {
      if (off >= -kTopGate) between(at.x(), -thickness_, off <= kTopGate ? kTop * fit(off, kTopGate) : slack_ > 0.0 ? 0.0 : -0.5 * kThrough);
      return;
    }
    const Vector3d end = r.a + r.d;
    if (std::abs(end.z()) < kLevelWithin && std::abs(end.y()) < inner_ - kLevelMargin) between(end.x(), kLevelMargin, -kLevel);
    if (off < -0.1) return;
    const double low = std::min(at.x(), end.x()), high = std::max(at.x(), end.x());
    if (std::abs(end.y()) < inner_ && end.z() < -kDeepest) {
      sums.add(-kNever, low, high, kNever, -kThrough, kAnyWay);
      return;
    }
    if (is_upright && std::abs(end.y()) < inner_ - kUprightMargin)
      sums.add(-kNever, std::min(at.x(), end.x() - kUprightMargin), std::max(at.x(), end.x() + kUprightMargin), kNever, -kUpright, kAnyWay);
    opening(r, at.x());
  }

  // t where the ray would come to the inner face of the side that it goes to.
  [[nodiscard]] double far_side(const StripRay& r) const {
    return std::abs(r.d.y()) > 1e-9 ? ((r.d.y() > 0.0 ? inner_ : -inner_) - r.a.y()) / r.d.y() : kNever;
  }

  // Without a wall at the end between t = first and last the ray goes on within.
  void open_end(const StripRay& r, double first, double last) {
    if (r.near_side != 0) first = std::max(first, (r.near_side * inner_ - r.a.y()) / r.d.y());
    last = std::min(last, far_side(r));
    if (last <= first) return;
    const Ways& open = r.d.x() > 0.0 ? kOpenRear : kOpenFront;
    within(r, {r.u(first), r.u(last)}, r.u(first), -kNever, open, open);
  }

  // The ray enters the opening at rim_u: the end that it comes from lies behind.
  void opening(const StripRay& r, double rim_u) {
    const bool forward = r.d.x() > 0.0;
    within(r, {forward ? -kNever : kNever, rim_u}, rim_u, (-slack_ - r.a.z()) / r.d.z(), kAnyWay, forward ? kWithFrontWall : kWithRearWall);
  }

  // From came_in on the ray is in the bed: it ends within, or on the far side, or on the end that it goes to, which lies beyond came_in. The end that it comes from
  // lies in own, in the ray's sense. Sums of what is so whether the other end has a wall or not, and of what only such a wall says; low: t from which the
  // ray is below its top.
  void within(const StripRay& r, std::array<double, 2> own, double came_in, double low, const Ways& anyhow, const Ways& wall) {
    const bool forward = r.d.x() > 0.0, straight_across = std::abs(r.d.x()) < 1e-9;
    const double side = far_side(r), onwards = forward ? kNever : -kNever;
    const bool sure = !std::isinf(side) && r.at(side).z() < -slack_;
    const double far = side > 1.0 + r.gate ? kInside : side < 1.0 - r.gate ? (sure ? -kThrough : 0.0) : kInside + (1.0 - kInside) * fit((1.0 - side) * r.range, kRangeGate);
    const double side_u = straight_across ? came_in : std::isinf(side) ? onwards : r.u(side);
    // The end that the ray goes to lies between from and to, in the ray's sense.
    const auto add = [&](const Ways& ways, double from, double to, double weight) {
      if (forward) sums.add(own[0], own[1], std::max(from, came_in), to, weight, ways);
      else sums.add(to, std::min(from, came_in), own[1], own[0], weight, ways);
    };
    const auto before_side = [&](double u) { return forward ? std::min(side_u, u) : std::max(side_u, u); };
    add(anyhow, side_u, onwards, far);
    if (straight_across) return;
    const double half = std::max(r.gate, 0.5 * kEndStep / std::abs(r.d.x()));
    add(anyhow, r.u(1.0), side_u, kInside);
    add(wall, r.u(low), before_side(r.u(1.0 - r.gate)), -kThrough);
    add(wall, r.u(1.0 - half), before_side(r.u(1.0 + half)), (1.0 - kInside) * kMeanFit * r.gate / half);
  }

  double inner_, outer_, thickness_, slack_;
  double sensor_first_ = kNever, sensor_last_ = -kNever;
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

std::vector<BedEnds> best_ends(const BedStrip& strip, const std::vector<Ray>& rays, const SizeRange& lengths, double share, std::size_t most) {
  const int shortest = static_cast<int>(lengths[0] / kEndStep), longest = std::min(static_cast<int>(std::ceil(lengths[1] / kEndStep)), kEnds - 1);
  const Weighing w(strip, rays, {shortest, longest});
  const auto open_weight = static_cast<float>(kOpenEnd / share);
  const std::array<int, 2> fronts = strip.from_cab ? std::array<int, 2>{first_end(-kBehindCabFront[1]), first_end(-kBehindCabFront[0])} : std::array<int, 2>{0, kEnds - 1};
  std::vector<Beds> beds;
  for (int i = 0; i + shortest < kEnds; ++i) {
    const float rear = w.rear_face.at(i);
    for (int j = std::max(i + shortest, fronts[0]); j <= std::min(i + longest, fronts[1]); ++j) {
      const Ways& sums = w.sums.at(i, j);
      const float front = w.front_face.at(j), sides = w.sides(i, j, share);
      const Beds b{i, j, sums[0] + sides + rear + front, sums[1] + sides + front - open_weight, sums[2] + sides + rear - open_weight};
      if (std::max({b.closed, b.open_rear, b.open_front}) > 0.0F && w.clear_of_sensor(place_of(i), place_of(j))) beds.push_back(b);
    }
  }
  if (beds.empty()) return {};  // nor with any cab
  const CabProfile cab = cab_of(strip, rays);
  std::array<float, kEnds> cab_front{}, cab_rear{};
  for (int k = 0; k < kEnds; ++k) {
    cab_front[static_cast<std::size_t>(k)] = static_cast<float>(cab.beyond(place_of(k) + strip.thickness, 1, share));
    cab_rear[static_cast<std::size_t>(k)] = static_cast<float>(cab.beyond(place_of(k) - strip.thickness, -1, share));
  }
  std::vector<Pair> pairs;
  for (const Beds& b : beds) {
    const float at_front = cab_front[static_cast<std::size_t>(b.front)], at_rear = cab_rear[static_cast<std::size_t>(b.rear)];
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
