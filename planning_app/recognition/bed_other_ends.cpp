#include "recognition/bed_other_ends.hpp"

#include <algorithm>
#include <cmath>

#include "recognition/bed_evidence.hpp"
#include "recognition/cab_profile.hpp"
#include "recognition/rays_of_sweep.hpp"

namespace berm::app {
namespace {

constexpr double kPlaceStep = 0.1;           // m, between places of an end: a wall's agreement reaches over 0.12
constexpr int kFirstPlace = 2, kPlacesMost = 15;
constexpr std::size_t kPlaceStride = 2;
constexpr std::size_t kPeaks = 2;       // of an end

BedPose with_end_moved(const BedPose& from, int end, double by) {
  BedPose p = from;
  p.length += end * by;
  p.middle += p.rotation().col(0) * (0.5 * by);
  return p;
}

// What an end's outer face, or a cab, says beyond there being one does not tell where it is.
double worth_of(const BedPose& pose, const PackedRays& rays) {
  const BedScore e = score_with_ends(pose, rays);
  return e.score - e.end_face + closed_by(e.end_face, 0.0);
}

struct Place {
  BedPose pose;
  double score;
};

}  // namespace

std::vector<BedPose> other_ends(const FanSweep& sweep, const BedPose& pose, const SizeRange& lengths, double worth) {
  const PackedRays rays = PassingRays(sweep, around_bed(pose.middle)).packed(kPlaceStride).meeting(with_end_moved(with_end_moved(pose, 1, kPlacesMost * kPlaceStep), -1, -kPlacesMost * kPlaceStep), 0.0);
  const double least = worth * worth_of(pose, rays);
  std::vector<BedPose> out;
  for (const int end : {1, -1}) {
    std::vector<Place> peaks;
    const auto score_at = [&](int step) {
      const BedPose p = with_end_moved(pose, end, step * kPlaceStep);
      return p.length < lengths[0] || p.length > lengths[1] ? -1e9 : worth_of(p, rays);
    };
    double before = -1e9, here = score_at(-kPlacesMost);
    for (int step = -kPlacesMost; step <= kPlacesMost; ++step) {
      const double next = step < kPlacesMost ? score_at(step + 1) : -1e9;
      if (std::abs(step) >= kFirstPlace && here >= least && here > before && here >= next) peaks.push_back({with_end_moved(pose, end, step * kPlaceStep), here});
      before = here, here = next;
    }
    std::sort(peaks.begin(), peaks.end(), [](const Place& a, const Place& b) { return a.score > b.score; });
    for (std::size_t k = 0; k < std::min(kPeaks, peaks.size()); ++k) out.push_back(peaks[k].pose);
  }
  return out;
}

}  // namespace berm::app
