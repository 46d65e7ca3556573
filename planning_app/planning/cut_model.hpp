// Forward model of a cut: what the bucket's shell takes from the ground in its way, in the swing plane.
#pragma once

#include <vector>

#include "motion/dig_path.hpp"
#include "planning/terrain_map.hpp"

namespace berm::app {

// The ground along a bearing, from the machine outward. A face hides itself from a scanner above its crest: what was never seen is taken to
// fall from the last seen point at the slope at which cut bank stands, down to the next seen point, and never to lie above the bucket's passage.
class SurfaceProfile {
public:
  static constexpr double first = 4.0, last = 10.0, step = 0.1;  // m

  SurfaceProfile(const TerrainMap& terrain, double bearing, double width);

  double at(double r) const;
  std::vector<double>& heights() { return z_; }  // at first, first + step, ...

private:
  std::vector<double> z_;
};

class CutModel {
public:
  CutModel(const MachineModel& machine, const SurfaceProfile& surface, double bucket_width);

  // The bucket gets to the pose; returns the bank volume (m3) that it takes on the way from the pose before, and lowers the surface.
  double reach(const Joints& pose);
  double volume() const { return volume_; }  // since the start
  const SurfaceProfile& surface() const { return surface_; }

private:
  MachineModel machine_;
  SurfaceProfile surface_;
  double width_;
  double volume_ = 0.0;
};

// Volume of a whole path.
double cut_volume(const MachineModel& machine, const SurfaceProfile& surface, double bucket_width, const DigPath& path);

}  // namespace berm::app
