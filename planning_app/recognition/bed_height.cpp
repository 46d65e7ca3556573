#include "recognition/bed_height.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "recognition/bed_inside.hpp"
#include "recognition/class_heights.hpp"

namespace berm::app {
namespace {

using Eigen::Vector3d;

using Weights = DepthWeights;

// Of a return so far from the plane of a wall's outer face, m, to the outside positive: densities where the wall stands, below its foot, and of what
// carries the bed: wheels a little behind the plane, tracks in it.
constexpr double kFaceSpread = 0.035, kCarrierSpread = 0.04, kBefore = 0.12;  // m; the spread with mud
constexpr double kFarthest = 2.5, kNearBehind = 0.4;                               // m behind the plane
constexpr double kAnything = 0.03;
struct Under { double edge, near; };  // shares of the floor's own edge, behind the wall, and of what lies near
constexpr std::array<Under, 2> kUnder{{{0.25, 0.5}, {0.05, 0.05}}};
constexpr double kWheelsShare = 0.25, kWheelsBack = 0.04;  // of the length, m behind the plane
constexpr std::array<std::size_t, 9> kGapsUnder{4, 7, 12, 20, 30, 45, 65, 95, kDepths};  // steps, between a foot and what carries the bed
constexpr std::array<std::size_t, 4> kEdges{6, 10, 14, kDepths};            // steps, of the floor's thickness at an open end
struct Toe { double share, deep; };  // of soil behind an open end
constexpr std::array<Toe, 2> kToes{{{0.5, 0.4}, {0.9, 0.2}}};
constexpr double kClosedOften = 1e-8;                                        // how often an end that was taken for open has its wall
constexpr double kGrazing = 0.02;                                           // m
constexpr double kFlushOften = 0.15;  // how often what carries a bed is flush with its walls
constexpr double kFootUnsure = 0.01, kEdgeUnsure = 0.03, kBoxUnsure = 0.008, kPipeUnsure = 0.02;  // m, standard deviations, by mud and by soil at an edge

// The densities' logarithms, kOffStep apart.
class OffWeights {
 public:
  static constexpr std::size_t kWall = 0, kUnders = 1, kWheels = kUnders + kUnder.size(), kMissed = kWheels + 1, kToe = kMissed + 1,
                               kEdge = kToe + kToes.size(), kKinds = kEdge + 1;
  using Kinds = std::array<double, kKinds>;

  explicit OffWeights(double thickness) {
    for (std::size_t i = 0; i < of_.size(); ++i) {
      const double off = (static_cast<double>(i) - 0.5) * kOffStep - kNearBehind;  // the first: farther behind
      const bool far = i == 0;
      const auto near = [&](double behind, double spread) { return far ? 0.0 : gauss(off + behind, spread); };
      const double little = far || off > 0.0 ? 0.0 : 1.0 / kNearBehind, any = 1.0 / kFarthest;
      Kinds& k = of_[i];
      k[kWall] = (1.0 - kAnything) * near(0.0, kFaceSpread) + kAnything * any;
      for (std::size_t u = 0; u < kUnder.size(); ++u)
        k[kUnders + u] = kUnder[u].edge * near(thickness, kFaceSpread) + kUnder[u].near * little + (1.0 - kUnder[u].edge - kUnder[u].near) * any;
      k[kWheels] = kWheelsShare * near(kWheelsBack, kCarrierSpread) + (1.0 - kWheelsShare) * any;
      k[kMissed] = 0.1 * near(kWheelsBack, kCarrierSpread) + 0.2 * little + 0.7 * any;
      for (std::size_t t = 0; t < kToes.size(); ++t) k[kToe + t] = (far || off > 0.0 || off < -kToes[t].deep ? 0.0 : kToes[t].share / kToes[t].deep) + (1.0 - kToes[t].share) * any;
      k[kEdge] = 0.9 * near(0.0, kFaceSpread) + 0.1 * any;
      for (double& density : k) density = std::log(density);
    }
  }
  [[nodiscard]] const Kinds& of(double off) const {
    return of_[static_cast<std::size_t>(std::clamp((off + kNearBehind) / kOffStep + 1.0, 0.0, static_cast<double>(of_.size() - 1)))];
  }

 private:
  static constexpr double kOffStep = 0.004;
  std::array<Kinds, 132> of_{};  // up to kBefore
};

struct Crossed { double depth, aside, off; Vector3d from, along; };

// The rays in the bed's frame.
std::vector<PlacedRay> placed(const BedPose& pose, const std::vector<Ray>& rays) {
  std::vector<PlacedRay> out;
  out.reserve(rays.size());
  RayPlacing place(pose);
  for (const Ray& ray : rays) out.push_back({place.head(ray), place.end(ray)});
  return out;
}

// Where rays cross the outer faces of walls that the sensor sees, or the open end: how deep below the tops, how far from the middle, and how far from
// the face, to the outside, they end.
std::vector<Crossed> crossings(const BedPose& pose, const std::vector<PlacedRay>& rays, int axis, bool open) {
  std::vector<Crossed> out;
  for (const PlacedRay& ray : rays) {
    const Vector3d& a = ray.from;
    const int side = a[axis] > 0.0 ? 1 : -1;
    const double face = pose.face(axis, side, true), off = side * ray.end[axis] - face;
    if (std::abs(a[axis]) < face || off > kBefore || off < -kFarthest || (axis == 0 && side == pose.open_end) != open) continue;
    const Vector3d d = ray.end - a;
    if (side * d[axis] >= 0.0) continue;
    const double share = (side * face - a[axis]) / d[axis], aside = a[1 - axis] + share * d[1 - axis], depth = -(a.z() + share * d.z());
    if (std::abs(aside) > pose.face(1 - axis, 1, false) || depth < kTopLeft || depth > kDeepestSeen) continue;
    out.push_back({depth, aside, off, {a.x(), side * a.y(), a.z()}, {d.x(), side * d.y(), d.z()}});
  }
  return out;
}

// Sums over the crossings of each kind of weight: of those shallower than each depth, and of all.
struct DepthSums {
  std::array<OffWeights::Kinds, kDepths + 1> above{};
  OffWeights::Kinds all{};

  // rise: of a half pipe's floor over its lowest line, by the place across; 0 deep: none.
  DepthSums(const std::vector<Crossed>& crossed, const OffWeights& weights, double radius) {
    std::array<OffWeights::Kinds, kDepths + 1> at{};
    for (const Crossed& c : crossed) {
      const double rise = radius > 0.0 ? radius - std::sqrt(std::max(0.0, radius * radius - c.aside * c.aside)) : 0.0;
      const auto i = static_cast<std::size_t>(std::clamp((c.depth + rise - kShallowest) / kStep, 0.0, static_cast<double>(kDepths)));
      const OffWeights::Kinds& w = weights.of(c.off);
      for (std::size_t k = 0; k < w.size(); ++k) at[i][k] += kIndependent * w[k];
    }
    for (std::size_t i = 0; i <= kDepths; ++i)
      for (std::size_t k = 0; k < all.size(); ++k) {
        above[i][k] = all[k];
        all[k] += at[i][k];
      }
  }
  [[nodiscard]] double between(std::size_t from, std::size_t to, std::size_t kind) const { return above[to][kind] - above[from][kind]; }
  [[nodiscard]] double below(std::size_t from, std::size_t kind) const { return all[kind] - above[from][kind]; }
};

// With the depths known to a standard deviation only.
Weights blurred(const Weights& sharp, double deviation) {
  const int reach = static_cast<int>(std::lround(2.5 * deviation / kStep));
  std::vector<double> weight;
  double all = 0.0;
  for (int j = -reach; j <= reach; ++j) all += weight.emplace_back(gauss(j * kStep, deviation));
  Weights out{};
  for (int i = 0; i < static_cast<int>(kDepths); ++i) {
    const int from = std::max(i - reach, 0), to = std::min(i + reach, static_cast<int>(kDepths) - 1);
    double most = kImpossible, sum = 0.0;
    for (int k = from; k <= to; ++k) most = std::max(most, sharp[static_cast<std::size_t>(k)]);
    for (int k = from; k <= to; ++k) {
      const double below = sharp[static_cast<std::size_t>(k)] - most;
      if (below > -20.0) sum += weight[static_cast<std::size_t>(k - i + reach)] / all * std::exp(below);
    }
    out[static_cast<std::size_t>(i)] = sum > 0.0 ? most + std::log(sum) : kImpossible;
  }
  return out;
}

// By the depth of an upright wall's foot.
Weights weigh_feet(const DepthSums& sums) {
  Weights feet{};
  for (std::size_t i = 0; i < kDepths; ++i) {
    double any = kImpossible;
    for (const std::size_t gap : kGapsUnder) {
      const std::size_t end = std::min(i + gap, kDepths);
      for (std::size_t u = 0; u < kUnder.size(); ++u)
        for (const std::size_t carrier : {OffWeights::kWheels, OffWeights::kWall})  // tracks look as the wall does
          any = std::max(any, sums.between(i, end, OffWeights::kUnders + u) + sums.below(end, carrier));
    }
    feet[i] = sums.above[i][OffWeights::kWall] + any;
  }
  return feet;
}

// By the depth of the floor at an open end: soil or nothing above it, its edge, and what is below that. Or by the foot of a wall that stands there after all.
Weights weigh_edges(const DepthSums& sums) {
  Weights floors{};
  const Weights feet = weigh_feet(sums);
  const double closed = std::log(kClosedOften);
  for (std::size_t i = 0; i < kDepths; ++i) {
    double any = kImpossible;
    for (const std::size_t edge : kEdges) {
      const std::size_t end = std::min(i + edge, kDepths);
      for (std::size_t u = 0; u < kUnder.size(); ++u) any = std::max(any, sums.between(i, end, OffWeights::kEdge) + sums.below(end, OffWeights::kUnders + u));
    }
    floors[i] = std::max(std::max(sums.above[i][OffWeights::kToe], sums.above[i][OffWeights::kToe + 1]) + any, feet[i] + closed);
  }
  return floors;
}

// By the height of a half pipe whose sides are these, where that is allowed.
Weights weigh_pipes(const BedPose& pose, const std::vector<Crossed>& crossed, const OffWeights& weights, const Weights& may_be) {
  Weights heights{};
  heights.fill(kImpossible);
  const double inner = pose.width / 2, outer = inner + pose.thickness;
  std::size_t first = kDepths, last = 0;
  for (std::size_t i = 0; i < kDepths; ++i)
    if (may_be[i] > kImpossible) first = std::min(first, i), last = i;
  const auto straight = [&](std::size_t i) { return std::max(0.0, depth_of(i) - inner); };
  struct Near { double depth, y, z, dy, dz, one_by, missed; };
  std::vector<Near> near;
  double same = 0.0;  // whatever the height
  for (const Crossed& c : crossed) {
    const OffWeights::Kinds& w = weights.of(c.off);
    const Near n{c.depth, c.from.y(), c.from.z(), c.along.y(), c.along.z(), 1.0 / std::sqrt(c.along.y() * c.along.y() + c.along.z() * c.along.z()), w[OffWeights::kMissed]};
    if (c.depth < straight(first)) same += w[OffWeights::kWall];
    else if (c.depth > straight(last) && std::fabs(n.y * n.dz - (n.z + straight(last)) * n.dy) * n.one_by > outer + kGrazing) same += n.missed;
    else near.push_back(n);
  }
  const auto weight_of = [&](const Near& n, double upright) {
    if (n.depth < upright) return weights.of(n.y + n.dy - outer)[OffWeights::kWall];
    const double z = n.z + upright, past = std::fabs(n.y * n.dz - z * n.dy) * n.one_by - outer;  // the ray from the pipe
    if (past > kGrazing) return n.missed;
    const double y_end = n.y + n.dy, z_end = z + n.dz, off = std::sqrt(y_end * y_end + z_end * z_end) - outer;
    const double of_pipe = weights.of(off > kBefore || (y_end < 0.0 && z_end < 0.0) ? -kFarthest : off)[OffWeights::kWall];
    return past < -kGrazing ? of_pipe : std::max(of_pipe, n.missed);
  };
  const auto sum_at = [&](std::size_t i) {
    double sum = same;
    for (const Near& n : near) sum += weight_of(n, straight(i));
    return kIndependent * sum;
  };
  double before = 0.0;
  for (std::size_t i = first; i <= last; i += 2) {
    const double here = sum_at(i);
    heights[i] = here;
    if (i > first) heights[i - 1] = 0.5 * (before + here);
    before = here;
  }
  if ((last - first) % 2 == 1) heights[last] = sum_at(last);
  return heights;
}

Weights either(const Weights& a, const Weights& b) {
  Weights out{};
  for (std::size_t i = 0; i < kDepths; ++i) out[i] = std::max(a[i], b[i]);
  return out;
}

// The greatest sum of both.
double likeliest(const Weights& returns, const Weights& classes) {
  double most = 2 * kImpossible;
  for (std::size_t i = 0; i < kDepths; ++i) most = std::max(most, returns[i] + classes[i]);
  return most;
}

// Of heights and shapes, each as likely as a weight.
class Likely {
 public:
  void add(double weight, double depth, double unsure, bool pipe) {
    sum_ += weight;
    if (pipe) pipes_ += weight;
    first_ += weight * depth;
    second_ += weight * (depth * depth + unsure * unsure);
  }
  void add(const Likely& more) {
    sum_ += more.sum_;
    pipes_ += more.pipes_;
    first_ += more.first_;
    second_ += more.second_;
  }
  [[nodiscard]] double sum() const { return sum_; }
  [[nodiscard]] double half_pipe() const { return pipes_ / sum_; }
  [[nodiscard]] double mean() const { return first_ / sum_; }
  [[nodiscard]] double variance() const { return std::max(0.0, second_ / sum_ - mean() * mean()); }

 private:
  double sum_ = 0.0, pipes_ = 0.0, first_ = 0.0, second_ = 0.0;
};

}  // namespace

BedHeight bed_height(const FittedBed& fit, const std::vector<Ray>& rays, const TruckRangeSet& classes, double flatness) {
  const BedPose& pose = fit.pose;
  const OffWeights weights(pose.thickness);
  const std::vector<PlacedRay> near = placed(pose, rays);
  const std::vector<Crossed> sides = crossings(pose, near, 1, false), edge = crossings(pose, near, 0, true);
  const DepthSums ends(crossings(pose, near, 0, false), weights, 0.0), faces(sides, weights, 0.0);
  // The plane of the tops leans by so much less or more.
  const double at_side = std::hypot(kFootUnsure, pose.width / 2 * std::sqrt(fit.covariance(5, 5)));
  const double tilt_along = pose.length / 2 * std::sqrt(fit.covariance(4, 4)), at_end = std::hypot(kFootUnsure, tilt_along), at_edge = std::hypot(kEdgeUnsure, tilt_along);
  const Weights end_feet = blurred(weigh_feet(ends), at_end), side_feet = blurred(weigh_feet(faces), at_side);
  Weights edges{};
  if (!edge.empty()) edges = blurred(weigh_edges(DepthSums(edge, weights, 0.0)), at_edge);
  const double flush = ends.all[OffWeights::kWall] + faces.all[OffWeights::kWall] + std::log(kFlushOften);
  const ClassHeights box = class_heights(classes, false, pose.width), half = class_heights(classes, true, pose.width);
  const ReturnsWithin returns = returns_within(pose, near);
  const Weights inside = weigh_box_inside(returns, flatness);
  Weights boxes{}, pipes{}, other_pipes{};
  for (std::size_t i = 0; i < kDepths; ++i) boxes[i] = inside[i] + edges[i] + add_logs(end_feet[i] + side_feet[i] + std::log(1.0 - kFlushOften), flush);
  const double likeliest_box = likeliest(boxes, either(either(box.within, box.in_slack), box.beyond));
  pipes.fill(kImpossible);
  other_pipes.fill(kImpossible);
  if (half.any()) {
    const Weights round = weigh_pipe_inside(returns, flatness);
    if (!edge.empty()) edges = blurred(weigh_edges(DepthSums(edge, weights, pose.width / 2)), at_edge);
    Weights but_sides{};
    for (std::size_t i = 0; i < kDepths; ++i) but_sides[i] = round[i] + edges[i] + end_feet[i];
    const auto with_sides = [&](const Weights& may_be) {
      Weights out = blurred(weigh_pipes(pose, sides, weights, may_be), kPipeUnsure);
      for (std::size_t i = 0; i < kDepths; ++i) out[i] += but_sides[i];
      return out;
    };
    pipes = with_sides(half.within);
    // A half pipe deeper than the classes' looks as a box does whose foot is where its sides begin to draw in: it is thought of only where the classes' are likelier than any box.
    if (likeliest(pipes, half.within) > likeliest_box) other_pipes = with_sides(either(half.in_slack, half.beyond));
  }
  const double most = std::max({likeliest_box, likeliest(pipes, half.within), likeliest(other_pipes, either(half.in_slack, half.beyond))});
  Likely of_class, outside;
  for (std::size_t i = 0; i < kDepths; ++i) {
    const double depth = depth_of(i);
    for (const double classes_say : {box.within[i], box.in_slack[i]}) of_class.add(std::exp(boxes[i] + classes_say - most), depth, kBoxUnsure, false);
    of_class.add(std::exp(pipes[i] + half.within[i] - most), depth, kPipeUnsure, true);
    of_class.add(std::exp(other_pipes[i] + half.in_slack[i] - most), depth, kPipeUnsure, true);
    outside.add(std::exp(boxes[i] + box.beyond[i] - most), depth, kBoxUnsure, false);
    outside.add(std::exp(other_pipes[i] + half.beyond[i] - most), depth, kPipeUnsure, true);
  }
  BedHeight out;
  out.beyond = outside.sum() / (of_class.sum() + outside.sum());
  Likely told = out.beyond > kLikelyNone ? outside : of_class;
  if (out.beyond > kHardlyNone && out.beyond <= kLikelyNone) told.add(outside);
  out.height = told.mean();
  out.half_pipe = told.half_pipe();
  out.deviation = std::sqrt(told.variance() + kStep * kStep / 12.0 + fit.covariance(2, 2));
  return out;
}

}  // namespace berm::app
