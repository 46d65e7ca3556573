#include "recognition/cab_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kCabReach = 11.0, kCabStep = 0.05;   // m
constexpr int kCabCells = static_cast<int>(2 * kCabReach / kCabStep);
// Below the tops of the walls every cab is solid between these heights; it is at most as wide as the bed.
constexpr double kCoreLow = -1.4, kCoreHigh = -0.75, kCoreHalf = 1.0;
constexpr double kReturnLow = -1.6, kReturnHigh = 0.9, kReturnHalf = 1.4;
constexpr std::array<double, 3> kGaps{0.15, 0.3, 0.45};
constexpr double kSideGate = 0.08;                              // m, of a return from the plane of a bed's side
constexpr float kOfSide = 0.5F;                               // of the weight of such a return
constexpr double kShortest = 1.2;
constexpr double kReturnWeight = 0.3, kReturnsMost = 300.0;  // in rays
constexpr float kFlatWeight = 0.5F;                         // of a return that is none of an upright surface: a roof, a canopy
constexpr double kFlatLow = -0.5;                           // m: lower it may be soil
constexpr double kPassWeight = 1.0, kPassesMost = 150.0;
constexpr double kPassedCab = 0.15;                             // m beyond the core

int cab_cell(double u) { return static_cast<int>(std::clamp((u + kCabReach) / kCabStep, 0.0, static_cast<double>(kCabCells))); }

// From where to where on a ray, in its shares, a coordinate is between two values.
struct Stretch {
  double in, out;
};

Stretch between(double from, double by, double low, double high) {
  const double one = 1.0 / (std::abs(by) < 1e-9 ? std::copysign(1e-9, by) : by), s = (low - from) * one, t = (high - from) * one;
  return {std::min(s, t), std::max(s, t)};
}

}  // namespace

CabProfile::CabProfile(double half_inner, double half_outer) : inner_(half_inner), outer_(half_outer) {
  for (std::vector<float>* s : {&returns_, &shared_, &within_, &begins_, &ends_}) s->assign(kCabCells + 2, 0.0F);
}

void CabProfile::take(const Eigen::Vector3d& a, const Eigen::Vector3d& d, bool upright) {
  const Eigen::Vector3d end = a + d;
  if (std::abs(end.y()) < kReturnHalf && end.z() > (upright ? kReturnLow : kFlatLow) && end.z() < kReturnHigh && std::abs(end.x()) < kCabReach) {
    const std::size_t cell = static_cast<std::size_t>(cab_cell(end.x())) + 1;
    const float weight = upright ? 1.0F : kFlatWeight;
    returns_[cell] += weight;
    shared_[cell] += of_side(a, end) ? kOfSide * weight : weight;
  }
  if (std::abs(end.y()) < kCoreHalf - 0.05 && end.z() > kCoreLow && end.z() < kCoreHigh && std::abs(end.x()) < kCabReach)
    within_[static_cast<std::size_t>(cab_cell(end.x())) + 1] += 1.0F;
  // Through the core's slab, and on.
  const Stretch across = between(a.y(), d.y(), -kCoreHalf, kCoreHalf), upright_way = between(a.z(), d.z(), kCoreLow, kCoreHigh);
  const double in = std::max({0.0, across.in, upright_way.in}), out = std::min(across.out, upright_way.out);
  if (in >= out || out >= 1.0 || (1.0 - out) * (1.0 - out) * d.squaredNorm() < kPassedCab * kPassedCab) return;
  const double u = a.x() + in * d.x(), v = a.x() + out * d.x();
  begins_[static_cast<std::size_t>(cab_cell(std::min(u, v))) + 1] += 1.0F;
  ends_[static_cast<std::size_t>(cab_cell(std::max(u, v))) + 1] += 1.0F;
}

bool CabProfile::of_side(const Eigen::Vector3d& a, const Eigen::Vector3d& end) const {
  if (end.z() > 0.0) return false;
  const double y = std::abs(end.y());
  const bool nearer_side = a.y() * end.y() > 0.0;
  return nearer_side ? std::abs(a.y()) > outer_ && std::abs(y - outer_) < kSideGate : std::abs(y - inner_) < kSideGate;
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

double CabProfile::beyond(double u, int side, double share, Returns which) const {
  const std::vector<float>& returns = which == Returns::all ? returns_ : shared_;
  double best = -1e9;
  for (const double gap : kGaps) {
    const double begin = u + side * gap, end = begin + side * kShortest;
    const double low = std::min(begin, end), high = std::max(begin, end);
    best = std::max(best, block(returns, low, high, side > 0 ? low + 0.3 : low + 0.05, side > 0 ? high - 0.05 : high - 0.3, share));
  }
  return best;
}

}  // namespace berm::app
