// The rays of a sweep that come to a place.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "recognition/bed_model.hpp"
#include "recognition/fans.hpp"
#include "recognition/packed_rays.hpp"

namespace berm::app {

// Upright, about a middle in plan, between two heights. Metres.
struct Surroundings {
  Eigen::Vector2d middle;
  double radius, low, high;
};

// The returns, by rising number, whose rays pass through it.
class PassingRays {
 public:
  PassingRays(const FanSweep& sweep, const Surroundings& place);
  [[nodiscard]] std::size_t size() const { return count_; }
  // Hands on fan and return of every stride-th.
  template <typename Take>
  void visit(std::size_t stride, const Take& take) const {
    std::size_t fan = 0;
    for (std::size_t i = 0; i < count_; i += stride) {
      const std::size_t k = numbers_[i];
      while (sweep_.begin[fan + 1] <= k) ++fan;
      take(fan, k);
    }
  }
  [[nodiscard]] std::vector<Ray> rays(std::size_t stride) const;
  [[nodiscard]] PackedRays packed(std::size_t stride) const;

 private:
  // The head, in single precision, is that of a whole fan.
  template <typename Take>
  void visit_with_heads(std::size_t stride, const Take& take) const {
    std::size_t of = sweep_.heads.size();
    Eigen::Vector3f head = Eigen::Vector3f::Zero();
    visit(stride, [&](std::size_t fan, std::size_t k) {
      if (fan != of) of = fan, head = sweep_.heads[fan].cast<float>();
      take(head, sweep_.returns[k]);
    });
  }
  const FanSweep& sweep_;
  std::unique_ptr<std::uint32_t[]> numbers_;  // not set to anything: most are never used
  std::size_t count_;
};

// Where rays come to within 0.6 m of the bed's walls or opening, down to so many metres below the walls' tops.
constexpr double kNearBelow = 1.1;
Surroundings near_bed(const BedPose& pose, double below = kNearBelow);
// Where rays may come to the bed, to what stands beyond its ends, or below it: within 7 m.
Surroundings around_bed(const Eigen::Vector3d& middle);
// Where they may come to a cab beyond either end of the bed, as far as so many metres from the end wall.
Surroundings around_cabs(const BedPose& pose, double farthest);

// Every stride-th of the rays near a bed.
std::vector<Ray> rays_near(const FanSweep& sweep, const BedPose& pose, double below = kNearBelow, std::size_t stride = 1);

template <typename Take>
void visit_around(const FanSweep& sweep, const Eigen::Vector3d& middle, const Take& take) {
  PassingRays(sweep, around_bed(middle)).visit(1, take);
}

// Every stride-th of the rays.
std::vector<Ray> every(const std::vector<Ray>& rays, std::size_t stride);

// Of the rays about so many, evenly, and at most every least-th; each stands for `share` of them.
struct SomeRays {
  PackedRays rays;
  double share = 1.0;
};
SomeRays about(const FanSweep& sweep, const Surroundings& place, std::size_t most, std::size_t least = 1);

}  // namespace berm::app
