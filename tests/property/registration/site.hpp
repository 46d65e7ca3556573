// A site of drawn terrain, with things that move on it, and a scanner that sweeps over it: returns in the frame of a base that may slip.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/scanline_raster.h"

namespace berm::registration_test {

// An upright box on the ground, world frame, m.
struct Thing {
  double x = 0, y = 0, yaw = 0, length = 1, width = 1, top = 1;
};

struct SiteConfig {
  double relief_m = 0.02;      // standard deviation of the surface
  bool edges = true;           // a bench that falls away by 2.2 m to the front and to the left
  double range_stddev_m = 0.03;
  double swing_error_rad = 0.0026;  // of the joint sensor, wandering
};

class Site {
 public:
  Site(const SiteConfig& config, std::uint64_t seed);

  void dig(double x, double y, double radius, double depth);  // a pit, or with a negative depth a heap

  // The returns of one cycle of 10 ms.
  void scan(double time_s, std::vector<sk_point>& returns);

  std::vector<Thing> things;
  double base_x = 0, base_y = 0, base_z = 0, base_yaw = 0;  // where the base stands in the world
  std::mt19937_64 random;

 private:
  double height(double x, double y) const;  // of the ground, without things; m
  bool cast(double bearing, double depression, double& range) const;  // of the ground or a thing

  SiteConfig config_;
  std::vector<float> height_;  // on a lattice, between whose points the ground is straight
  double swing_error_ = 0;
};

}  // namespace berm::registration_test
