// Upright planar regions of a sweep: scanlines to line segments, segments grouped with coplanar ones of other scanlines (stentz-1999, section 4.1).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "recognition/fans.hpp"

namespace berm::app {

// A run of returns of one fan, one above the other on an upright line. Metres.
struct UprightSegment {
  std::size_t fan = 0;
  Eigen::Vector2d at;         // in plan
  double low = 0.0, high = 0.0;
  int count = 0;              // of returns
};

// Segments on one upright plane. Metres; in plan the region goes from first to last.
struct UprightRegion {
  Eigen::Vector2d normal;     // in plan, unit, towards the sensor
  Eigen::Vector2d first, last;
  double low = 0.0, high = 0.0;  // the medians of its segments' ends
  int count = 0;                 // of returns
  std::vector<UprightSegment> segments;
};

// Of one fan of the sweep; marks their returns.
void upright_segments(FanSweep& sweep, std::size_t fan, std::vector<UprightSegment>& out);
// Of every fan.
std::vector<UprightSegment> upright_segments(FanSweep& sweep);

// Regions as their segments come. Linear in these: each is offered to the regions that grew within the last three fans.
class RegionGrowth {
public:
  // By rising fan.
  void take(const UprightSegment& segment);
  // Whether a region as long as this, from its first segment to its last, has not grown in the newest fan, but up to three before.
  [[nodiscard]] bool pauses(std::size_t newest_fan, double length) const;
  // The largest first, of the segments so far.
  [[nodiscard]] std::vector<UprightRegion> regions(const FanSweep& sweep) const;

private:
  struct Growing {
    double n = 0.0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double xx = 0.0, xy = 0.0, yy = 0.0;
    std::vector<UprightSegment> members;

    void add(const UprightSegment& segment);
    [[nodiscard]] Eigen::Vector2d normal() const;
    [[nodiscard]] bool takes(const UprightSegment& segment) const;  // one that is not much later than the last
  };

  std::vector<Growing> growing_;
  std::vector<std::size_t> open_;  // of growing_: those that a segment of the newest fan may still join
};

std::vector<UprightRegion> upright_regions(const FanSweep& sweep, const std::vector<UprightSegment>& segments);

}  // namespace berm::app
