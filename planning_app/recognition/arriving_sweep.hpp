// A sweep as its scanlines arrive: of each, when it comes, its fan, its rays' directions, its upright segments and what they add to regions, so that a
// search for a truck may begin at once. Frame and units of fans.hpp.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "points/point_cloud.hpp"
#include "recognition/fans.hpp"
#include "recognition/upright_regions.hpp"

namespace berm::app {

class ArrivingSweep {
public:
  // viewpoint: of the sensor in the middle of the sweep, or, where it stands, at any time.
  explicit ArrivingSweep(const std::array<double, 3>& viewpoint);

  // The points of the next scanline in measuring order, as many as there are; turned: by how much the machine was told to have swung by then from where the
  // sensor stands at the viewpoint, rad. Linear in them, but for the steps between the fans so far, which are kept in order.
  void take(std::span<const ScanPoint> scanline, double turned = 0.0);

  // What a search is made in, of the scanlines so far. Where the machine swings the heads depend on all scanlines, and everything is made anew with
  // the heads as they are now. Valid until the next call of either.
  struct View {
    std::string reason;                 // why the scanlines cannot be used; empty when they can
    const FanSweep& whole;              // nothing is marked upright
    const FanSweep& thin;               // about a degree apart, upright returns marked
    std::vector<UprightRegion> regions; // of thin
  };
  View view();

  std::size_t fans() const { return planes_.size(); }
  // How far the fans have turned so far, rad.
  double turn() const { return std::abs(turned_); }
  // Whether the newest fan lies beyond a place in plan, in the sense in which they turn.
  bool passed(const Eigen::Vector2d& at) const;
  // Whether an upright region as long as this (m) grew lately, and not in the newest fan of the thinned ones.
  bool wall_pauses(double length) const;

private:
  // A thinned sweep with what is upright in it.
  struct Thinned {
    FanSweep sweep;
    RegionGrowth growth;
    void take(const FanSweep& whole, std::size_t fan);
  };
  static Thinned thin(const FanSweep& whole, std::size_t stride);

  Eigen::Vector3d head_;
  FanSweep whole_;
  std::vector<FanPlane> planes_;
  std::vector<double> steps_;  // between the fans, rising
  double turned_ = 0.0;  // rad, with its sense
  bool swung_ = false;   // the heads of the last view lie elsewhere
  std::size_t stride_ = 1;
  Thinned thinned_;
  Thinned swung_thinned_;
};

}  // namespace berm::app
