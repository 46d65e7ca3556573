// Forward model of a cut: what the bucket's shell takes from the ground in its way, in the swing plane.
#pragma once

#include <array>
#include <vector>

#include "motion/dig_path.hpp"
#include "planning/dig_ground.hpp"

namespace berm::app {

// The ground along a bearing, from the machine outward: the mean over the bucket's width.
class SurfaceProfile {
public:
  static constexpr double first = 4.0, last = 10.0, step = 0.1;  // m

  SurfaceProfile(const DigGround& ground, double bearing, double width);

  double at(double r) const;
  std::vector<double>& heights() { return z_; }  // at first, first + step, ...

private:
  std::vector<double> z_;
};

// The side of the bucket's outline that cuts, as points a few centimetres apart: the other side is the heaped load.
class BucketShell {
public:
  explicit BucketShell(const MachineModel& machine);

  // In the bucket's frame: along the line from pin to tip, and to its left.
  const std::vector<std::array<double, 2>>& points() const { return points_; }

private:
  std::vector<std::array<double, 2>> points_;
};

class CutModel {
public:
  // The machine outlives it.
  CutModel(const MachineModel& machine, const SurfaceProfile& surface, double bucket_width);

  // The bucket gets to the pose; returns the bank volume (m3) that it takes on the way from the pose before, and lowers the surface.
  double reach(const Joints& pose);
  double volume() const { return volume_; }  // since the start
  const SurfaceProfile& surface() const { return surface_; }

private:
  const MachineModel* machine_;
  BucketShell shell_;
  SurfaceProfile surface_;
  double width_;
  double volume_ = 0.0;
};

constexpr double cut_pace = 0.06;  // m along a path, from pose to pose of a cut

// What is in the bucket (bank m3) at places that lie evenly along a path, from its start to its end.
std::vector<double> fill_along(const MachineModel& machine, const SurfaceProfile& surface, double bucket_width, const DigPath& path);

// Volume of a whole path.
double cut_volume(const MachineModel& machine, const SurfaceProfile& surface, double bucket_width, const DigPath& path);

}  // namespace berm::app
