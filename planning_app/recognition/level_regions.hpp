// Level planar regions of a sweep: runs of returns on a line of a scanline that is nearly level, grouped with coplanar ones of other scanlines (stentz-1999, section 4.1).
// What a bed's floor and its canopy are made of. Only about a place, for most of a sweep is ground: what a bed's sides and ends leave.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "recognition/fans.hpp"

namespace berm::app {

// Sums over returns, of which a plane is told. Metres.
struct PlaneSums {
  double n = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& at);
  void add(const PlaneSums& more);
};

// The ends of two returns at least of one fan, one behind the other, by their distance from the sensor. Metres; single precision, as the returns are.
struct LevelEnds {
  std::size_t fan = 0;
  Eigen::Vector3f nearest, farthest;
};
struct LevelSegment {
  LevelEnds ends;
  PlaneSums sums;
};

// Segments on one plane. Metres.
struct LevelRegion {
  Eigen::Vector3d middle;   // the mean of its returns
  Eigen::Vector3d normal;   // unit, upwards
  double spread = 0.0;      // of its returns off the plane, root mean square
  double noise = 0.0;       // the same as the range's noise alone would make it, at the angles at which its rays meet it
  int count = 0;            // of returns
  std::vector<LevelEnds> segments;
};

// Upright, about a middle in plan, m.
struct LevelPlace {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double radius = 0.0;
};

// Of one fan of the sweep, of returns within the place that are not marked upright.
void level_segments(const FanSweep& sweep, std::size_t fan, const LevelPlace& place, std::vector<LevelSegment>& out);

// Regions as their segments come. Linear in these: each is offered to the regions that grew within the last three fans.
class LevelGrowth {
public:
  // By rising fan; head: of that fan.
  void take(const LevelSegment& segment, const Eigen::Vector3d& head);
  // The largest first, of the segments so far.
  [[nodiscard]] std::vector<LevelRegion> regions() const;

private:
  struct Growing {
    PlaneSums sums;
    Eigen::Vector3d plane = Eigen::Vector3d::Zero();  // height = plane . (1, x, y), from the mean
    Eigen::Matrix3d towards = Eigen::Matrix3d::Zero();  // of the unit ways of its rays, each way times itself
    std::vector<LevelEnds> members;

    void add(const LevelSegment& segment, const Eigen::Vector3d& head);
    [[nodiscard]] double off(const LevelEnds& ends) const;  // m, of the end that lies farther from the plane
  };

  std::vector<Growing> growing_;
  std::vector<std::size_t> open_;  // of growing_: those that a segment of the newest fan may still join
};

std::vector<LevelRegion> level_regions(const FanSweep& sweep, const LevelPlace& place);

// Those about beds, which mostly stand at one place: found anew only where one stands elsewhere.
class LevelRegionsOfBeds {
public:
  // sweep: upright returns are marked. It must outlive this.
  explicit LevelRegionsOfBeds(const FanSweep& sweep) : sweep_(sweep) {}
  // About a bed's middle, as far as its ends and a canopy. Valid until the next call.
  const std::vector<LevelRegion>& about(const Eigen::Vector3d& middle);

private:
  const FanSweep& sweep_;
  LevelPlace place_;
  std::vector<LevelRegion> regions_;
};

}  // namespace berm::app
