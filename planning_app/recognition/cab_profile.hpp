// The cab as evidence: what rays say of a cab that would begin at a place along a strip. Every truck has one beyond an end of its bed; a bed with none
// is no truck, and returns that a cab explains are none that a longer bed would have to explain.
#pragma once

#include <algorithm>
#include <vector>

#include "recognition/evidence_weights.hpp"
#include "recognition/packed_rays.hpp"

namespace berm::app {

// A cab counts for no more than a share of the bed before it.
inline double with_cab(double bed, double cab) { return bed + std::min({cab, kCabEnough, kCabShare * std::max(0.0, bed)}); }

// What closes a bed, an end's outer face and a cab, counts for no more than there being one: a cab's front has as many returns as all of the bed, and does not tell where it ends.
inline double closed_by(double end_face, double cab) { return std::min(end_face + cab, kCabEnough); }

// What lies so far beyond an end wall's outer face, and so far from the bed's axis, says nothing of a cab. Metres.
constexpr double kCabNear = 1.7, kCabFarthest = 2.6, kCabAside = 1.4;  // near: of a cab of the least length

class CabProfile {
 public:
  // half_inner, half_outer: from the middle to the faces of the bed's sides.
  CabProfile(double half_inner, double half_outer);
  void take(const BedPose& frame, const PackedRays& rays);
  void finish();
  // The evidence, in rays, for a cab beyond the end wall's outer face at u, towards `side`, at the best of the usual gaps. share: rays that each one
  // taken stands for; the evidence is in those taken. Shared: what lies in the planes of the bed's sides counts half, for a longer bed would explain it as well.
  enum class Returns { all, shared };
  [[nodiscard]] double beyond(double u, int side, double share, Returns which = Returns::shared) const;
  // The same of each return, of the length with the most: a cab's front, as one sees it from before the truck, has most of its returns.
  [[nodiscard]] double to_front(double u, int side, double share) const;

 private:
  [[nodiscard]] double of_length(double u, int side, double length, double share, Returns which) const;
  [[nodiscard]] double block(const std::vector<float>& returns, double low, double high, double core_low, double core_high, double share) const;
  double inner_, outer_;
  std::vector<float> returns_, shared_, within_, begins_, ends_;  // running sums along u
};

}  // namespace berm::app
