#include "recognition/cab_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kCabReach = 11.0, kCabStep = 0.05;   // m
constexpr int kCabCells = static_cast<int>(2 * kCabReach / kCabStep);
// Below the tops of the walls every cab is solid between these heights; it is at most as wide as the bed.
constexpr double kCoreLow = -1.4, kCoreHigh = -0.95, kCoreHalf = 1.0;
constexpr double kReturnLow = -1.6, kReturnHigh = 0.9, kReturnHalf = kCabAside;
constexpr std::array<double, 3> kGaps{0.15, 0.3, 0.45};
constexpr double kSideGate = 0.08;                              // m, of a return from the plane of a bed's side
constexpr float kOfSide = 0.5F;                               // of the weight of such a return
constexpr double kShortest = 1.2;
constexpr std::array<double, 3> kLengths{1.2, 1.65, 2.1};  // of a cab, to its front
constexpr double kReturnWeight = 0.3, kReturnsMost = 300.0;  // in rays
constexpr float kFlatWeight = 0.5F;                         // of a return that is none of an upright surface: a roof, a canopy
constexpr double kFlatLow = -0.5;                           // m: lower it may be soil
constexpr double kPassWeight = 1.0, kPassesMost = 150.0;
constexpr double kPassedCab = 0.15;                             // m beyond the core

constexpr float kStraightWay = 1e-9F;                          // m: no less is divided by

int cab_cell(double u) { return static_cast<int>(std::clamp((u + kCabReach) / kCabStep, 0.0, static_cast<double>(kCabCells))); }
BERM_APP_INLINE EightInt cab_cells(Eight u) {
  return __builtin_convertvector(least8(most8((u + eight(kCabReach)) * eight(1.0 / kCabStep), Eight{}), eight(kCabCells)), EightInt);
}

// From where to where on rays, in their shares, a coordinate is between two values.
struct alignas(32) Stretches {
  Eight in, out;
};

BERM_APP_INLINE Stretches between(Eight from, Eight by, double low, double high) {
  const Eight one = 1.0F / choose8(magnitude8(by) < kStraightWay, eight(static_cast<double>(kStraightWay)), by), s = (eight(low) - from) * one, t = (eight(high) - from) * one;
  return {least8(s, t), most8(s, t)};
}

}  // namespace

CabProfile::CabProfile(double half_inner, double half_outer) : inner_(half_inner), outer_(half_outer) {
  for (std::vector<float>* s : {&returns_, &shared_, &within_, &begins_, &ends_}) s->assign(kCabCells + 2, 0.0F);
}

BERM_APP_LANES void CabProfile::take(const BedPose& frame, const PackedRays& rays) {
  const EightPlacing place(frame);
  const Eight side_gate = eight(kSideGate), inner = eight(inner_), outer = eight(outer_);
  for (const PackedRays::EightRays& r : rays.eights()) {
    const Places a = place.of(r.head), end = place.of(r.at), d{end.u - a.u, end.v - a.v, end.w - a.w};
    const Eight aside = magnitude8(end.v);
    const EightInt is_ray = r.head[0] != PackedRays::kFar, near = is_ray & (magnitude8(end.u) < eight(kCabReach));
    const EightInt returned = near & (aside < eight(kReturnHalf)) & (end.w > choose8(r.upright, eight(kReturnLow), eight(kFlatLow))) & (end.w < eight(kReturnHigh));
    const EightInt in_core = near & (aside < eight(kCoreHalf - 0.05)) & (end.w > eight(kCoreLow)) & (end.w < eight(kCoreHigh));
    // Through the core's slab, and on.
    const Stretches across = between(a.v, d.v, -kCoreHalf, kCoreHalf), upright_way = between(a.w, d.w, kCoreLow, kCoreHigh);
    const Eight in = most8(most8(across.in, upright_way.in), Eight{}), out = least8(across.out, upright_way.out);
    const EightInt passes = is_ray & (in < out) & ((1.0F - out) * r.range >= eight(kPassedCab));
    if (!any8(returned | in_core | passes)) continue;
    // In the plane of the near side's outer face, or of the far one's inner face.
    const EightInt nearer = a.v * end.v > 0.0F;
    const EightInt of_side = (end.w <= 0.0F) & ((nearer & (magnitude8(a.v) > outer) & (magnitude8(aside - outer) < side_gate)) | (~nearer & (magnitude8(aside - inner) < side_gate)));
    const Eight one_end = a.u + in * d.u, other_end = a.u + out * d.u;
    const EightInt cells = cab_cells(end.u), first = cab_cells(least8(one_end, other_end)), last = cab_cells(most8(one_end, other_end));
    for (int k = 0; k < static_cast<int>(kLanes); ++k) {
      const auto cell = static_cast<std::size_t>(cells[k]) + 1;
      if (returned[k] != 0) {
        const float weight = r.upright[k] != 0 ? 1.0F : kFlatWeight;
        returns_[cell] += weight;
        shared_[cell] += of_side[k] != 0 ? kOfSide * weight : weight;
      }
      if (in_core[k] != 0) within_[cell] += 1.0F;
      if (passes[k] != 0) {
        begins_[static_cast<std::size_t>(first[k]) + 1] += 1.0F;
        ends_[static_cast<std::size_t>(last[k]) + 1] += 1.0F;
      }
    }
  }
}

void CabProfile::finish() {
  for (std::vector<float>* s : {&returns_, &shared_, &within_, &begins_, &ends_})
    for (std::size_t k = 1; k < s->size(); ++k) (*s)[k] += (*s)[k - 1];
}

double CabProfile::block(const std::vector<float>& returns, double low, double high, double core_low, double core_high, double share) const {
  const auto until = [](const std::vector<float>& sums, double u) { return static_cast<double>(sums[static_cast<std::size_t>(cab_cell(u))]); };
  const double hits = until(returns, high) - until(returns, low);
  const double passes = until(begins_, core_high) - until(ends_, core_low) +       // those that reach into the core
                        until(within_, core_high) - until(within_, core_low);
  return kReturnWeight * std::min(hits, kReturnsMost / kReturnWeight / share) - kPassWeight * std::min(passes, kPassesMost / share);
}

double CabProfile::of_length(double u, int side, double length, double share, Returns which) const {
  const std::vector<float>& returns = which == Returns::all ? returns_ : shared_;
  double best = -1e9;
  for (const double gap : kGaps) {
    const double begin = u + side * gap, end = begin + side * length;
    const double low = std::min(begin, end), high = std::max(begin, end);
    best = std::max(best, block(returns, low, high, side > 0 ? low + 0.3 : low + 0.05, side > 0 ? high - 0.05 : high - 0.3, share));
  }
  return best;
}

double CabProfile::beyond(double u, int side, double share, Returns which) const { return of_length(u, side, kShortest, share, which); }

double CabProfile::to_front(double u, int side, double share) const {
  double best = -1e9;
  for (const double length : kLengths) best = std::max(best, of_length(u, side, length, share, Returns::shared));
  return best;
}

}  // namespace berm::app
