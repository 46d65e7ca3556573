#include "recognition/bed_inside.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kFromWalls = 0.12;  // m: what lies within nearer to the walls tells nothing
constexpr double kFloorSpread = 0.022, kPipeSpread = 0.035;                 // m
constexpr double kFlatnessMost = 10.0;  // not all soil is as rough
constexpr double kFlatLoad = 0.5, kRoundLoad = 1e-4;  // how often a load looks like a floor, and like a half pipe's
struct Shown { double share, often; };
constexpr double kPipeFloor = 0.85;                                         // of its radius: farther aside it is too steep
constexpr double kFaceOver = 0.15;                                          // m: no return of an inner face lies so far below the floor
constexpr double kSoil = 0.5, kDeeper = 0.01;                               // densities of a return over the floor and below it, per m
constexpr double kMostInside = 150.0;                                       // returns within count as so many at most
constexpr std::array<Shown, 3> kFloorShown{{{0.95, 0.7}, {0.5, 0.2}, {0.15, 0.1}}}, kFlatShown{{{0.95, 0.1}, {0.5, 0.5}, {0.15, 0.4}}};
constexpr std::size_t kFlatOver = 4;  // steps: a flat load lies so much over the floor at least

// By the floor's depth: far walls go down to it, and no farther.
DepthWeights weigh_inner_faces(const std::vector<double>& faces) {
  DepthWeights out{};
  for (const double depth : faces) {
    const double i = (depth - kFaceOver - kShallowest) / kStep;
    if (i > 0.0) out[std::min(static_cast<std::size_t>(i), kDepths - 1)] += kIndependent * std::log(kDeeper / kSoil);
  }
  for (std::size_t i = kDepths - 1; i-- > 0;) out[i] += out[i + 1];
  return out;
}

// How often a load is as flat as what is seen.
double flat_load(double flatness) { return kFlatLoad * std::exp(-std::clamp(flatness, 0.0, kFlatnessMost)); }

// As how many returns these count.
double counted(const std::vector<double>& floors) { return std::min(kIndependent * static_cast<double>(floors.size()), kMostInside); }

// By the floor's depth, from what lies within: of whatever there is, and of a flat load alone.
struct Inside {
  DepthWeights any{}, flat{};
};
Inside weigh_inside(const std::vector<double>& floors, double spread, double flat_load) {
  Inside both;
  DepthWeights& out = both.any;
  if (floors.empty()) return both;
  std::array<double, kDepths> count{};
  double under = 0.0, over = 0.0;  // the grid's ends
  for (const double f : floors) {
    const double i = (f - kShallowest) / kStep + 0.5;
    if (i < 0.0) ++under;
    else if (i >= static_cast<double>(kDepths)) ++over;
    else ++count[static_cast<std::size_t>(i)];
  }
  const double each = std::min(kIndependent, kMostInside / static_cast<double>(floors.size()));
  constexpr int kReach = 12;
  // Of a surface at each depth, seen by a share of the returns.
  const auto surface = [&](double share, bool floor) {
    std::array<double, 2 * kReach + 1> near{};
    for (int j = -kReach; j <= kReach; ++j) {
      const double deeper = j * kStep, soil = !floor || deeper < 0.0 ? kSoil : std::max(kDeeper, kSoil * std::exp(-0.5 * deeper * deeper / (spread * spread)));
      near[static_cast<std::size_t>(j + kReach)] = std::log(share * gauss(deeper, spread) + (1.0 - share) * soil);
    }
    const double shallow = std::log((1.0 - share) * kSoil), deep = std::log(floor ? kDeeper : (1.0 - share) * kSoil);
    double total = under + over;
    for (const double c : count) total += c;
    DepthWeights w{};
    double above = under;  // returns farther up than near reaches
    for (int i = 0; i < static_cast<int>(kDepths); ++i) {
      if (i - kReach - 1 >= 0) above += count[static_cast<std::size_t>(i - kReach - 1)];
      double sum = 0.0, within = 0.0;
      for (int j = std::max(-kReach, -i); j <= kReach && i + j < static_cast<int>(kDepths); ++j) {
        const double c = count[static_cast<std::size_t>(i + j)];
        sum += c * near[static_cast<std::size_t>(j + kReach)];
        within += c;
      }
      w[static_cast<std::size_t>(i)] = each * (sum + above * shallow + (total - above - within) * deep);
    }
    return w;
  };
  out.fill(kImpossible);
  // The floor is seen, in part or whole.
  for (const Shown& s : kFloorShown) {
    const DepthWeights w = surface(s.share, true);
    for (std::size_t i = 0; i < kDepths; ++i) out[i] = add_logs(out[i], w[i] + std::log(s.often));
  }
  // A load hides it: rough, or flat, anywhere above it.
  const DepthWeights rough = surface(0.0, true);
  for (std::size_t i = 0; i < kDepths; ++i) out[i] = add_logs(out[i], rough[i] + std::log(1.0 - flat_load));
  DepthWeights flat{};
  flat.fill(kImpossible);
  for (const Shown& s : kFlatShown) {
    const DepthWeights w = surface(s.share, false);
    for (std::size_t i = 0; i < kDepths; ++i) flat[i] = add_logs(flat[i], w[i] + std::log(s.often));
  }
  double sum = kImpossible;
  const double anywhere = std::log(flat_load * kStep), too_deep = std::log(kDeeper / kSoil);
  double deeper = over;  // returns that lie below the floor
  for (std::size_t i = kFlatOver; i < kDepths; ++i) deeper += count[i];
  for (std::size_t i = 0; i < kDepths; ++i) {
    if (i >= kFlatOver) sum = add_logs(sum, flat[i - kFlatOver]);
    both.flat[i] = sum + anywhere + each * deeper * too_deep;
    out[i] = add_logs(out[i], both.flat[i]);
    if (i + kFlatOver < kDepths) deeper -= count[i + kFlatOver];
  }
  return both;
}

}  // namespace

ReturnsWithin returns_within(const BedPose& pose, const std::vector<PlacedRay>& rays) {
  ReturnsWithin out;
  const double radius = pose.width / 2;
  for (const auto& [from, at] : rays) {
    if (std::abs(at.x()) > pose.length / 2 + kFromWalls || std::abs(at.y()) > radius + kFromWalls || at.z() > -kTopLeft) continue;
    const Meeting what = meet_in_bed(pose, from, at).what;
    if (what == Meeting::inner_face) out.faces.push_back(-at.z());
    if (what != Meeting::inside || std::abs(at.x()) > pose.length / 2 - kFromWalls || std::abs(at.y()) > radius - kFromWalls) continue;
    out.floors.push_back(-at.z());
    if (std::abs(at.y()) > kPipeFloor * radius) continue;
    out.pipes.push_back(radius - at.z() - std::sqrt(radius * radius - at.y() * at.y()));
    out.beside.push_back(-at.z());
  }
  return out;
}

DepthWeights weigh_box_inside(const ReturnsWithin& returns, double flatness) {
  DepthWeights out = weigh_inside(returns.floors, kFloorSpread, flat_load(flatness)).any;
  const DepthWeights faces = weigh_inner_faces(returns.faces);
  for (std::size_t i = 0; i < kDepths; ++i) out[i] += faces[i];
  return out;
}

DepthWeights weigh_pipe_inside(const ReturnsWithin& returns, double flatness) {
  const Inside round = weigh_inside(returns.pipes, kPipeSpread, kRoundLoad);
  // What lies too far aside to tell a half pipe's floor is soil to it, as the rest is to a box.
  const double aside = std::log(kSoil) * (counted(returns.floors) - counted(returns.pipes));
  DepthWeights out = round.any;
  if (!returns.pipes.empty()) {
    const DepthWeights flat = weigh_inside(returns.beside, kFloorSpread, flat_load(flatness)).flat;
    for (std::size_t i = 0; i < kDepths; ++i) out[i] = add_logs(out[i], flat[i]);
  }
  for (double& w : out) w += aside;
  return out;
}

}  // namespace berm::app
