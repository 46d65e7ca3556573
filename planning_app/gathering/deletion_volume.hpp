// The space between two consecutive scans through which the beams have passed (zolynski-2012, 2.6 and 3.1): what lies in it is gone.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace berm::app {

// One return: angle in the scan plane from the frame's x axis, radians, -pi to pi; range from the optical centre, metres.
struct PolarReturn {
  double angle_rad;
  double range_m;
};

struct DeletionRule {
  double shrink_m = 0.05;       // the strip is moved towards the scanner by this,
  double quantile = 2.0;        // and by this many deviations of the strip's range:
  double range_m = 0.012;       // of the range itself,
  double along_rad = 0.0022;    // of the angle along the scan plane, by the slope of the strip,
  double across_rad = 0.0044;   // and across it; the planes are moved apart by the quantile of this one
  double max_gap_rad = 0.045;   // between neighbouring returns; a wider gap was not looked through
  double max_turn_rad = 0.045;  // between the scans
};

class DeletionVolume {
public:
  // The scans' frames (see KinematicChain) and returns in rising angle. Uses the memory of the volume before.
  void build(const Eigen::Isometry3d& first_frame, std::span<const PolarReturn> first, const Eigen::Isometry3d& second_frame,
             std::span<const PolarReturn> second, const DeletionRule& rule);

  // Whether the beams passed the place, metres in the cloud's frame.
  bool contains(double x, double y, double z) const;

  bool empty() const { return edges_.size() < 2; }
  // Bounds for a search: nothing of the volume is outside the box, nor farther than slab_half_width of its range from the plane in the middle.
  const Eigen::AlignedBox3d& box() const { return box_; }
  const Eigen::Vector3d& origin() const { return origin_; }  // halfway
  const Eigen::Vector3d& normal() const { return normal_; }  // of the plane in the middle
  double slab_half_width(double range_m) const { return slab_offset_ + slab_slope_ * range_m; }

private:
  // One edge of the strip, from a return of the first scan to one of the second. Two neighbouring edges make a triangle.
  struct Edge {
    float angle_first, angle_second;
    float inverse_first, inverse_second;  // 1 / shrunk range
    bool open;                            // the triangle that follows was not looked through
  };
  void shrink(std::span<const PolarReturn> scan, const DeletionRule& rule, std::vector<double>& out) const;

  std::vector<Edge> edges_;
  std::vector<double> range_first_, range_second_;
  Eigen::Vector3d origin_first_, origin_step_, x_first_, x_step_, y_first_, y_step_, normal_first_, normal_second_, origin_second_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(), normal_ = Eigen::Vector3d::UnitZ();
  Eigen::AlignedBox3d box_;
  double slab_offset_ = 0.0, slab_slope_ = 0.0, aside_ = 0.0, reach_ = 0.0;
};

}  // namespace berm::app
