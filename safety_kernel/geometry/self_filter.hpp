// Recognises returns on the machine itself.
//
// A hazard by nature: nothing nearer to the implements than the margin, and nothing inside the own body's cylinder, is seen by the map.
#ifndef BERM_KERNEL_GEOMETRY_SELF_FILTER_HPP
#define BERM_KERNEL_GEOMETRY_SELF_FILTER_HPP

#include "geometry/kinematics.hpp"

namespace berm::kernel {

class SelfFilter {
public:
  static constexpr double body_height_m = 3.6; // top of upper body, cab and scanner masts above the ground

  explicit SelfFilter(const berm_parameters& parameters) noexcept;

  // One pose serves all samples of a packet whose joint angles are near enough to one another.
  ImplementPose pose(const JointAngles& angles) const noexcept { return kinematics_.implements(angles); }

  // point: upper body's frame, m. True within the own body's cylinder or within the margin of an implement part (outline in the swing
  // plane, and half width to the sides). False for a point with a coordinate that is not finite.
  bool is_own(const Eigen::Vector3d& point, const ImplementPose& pose) const noexcept;
  // The second alone: within the margin of an implement part.
  bool is_implement(const Eigen::Vector3d& point, const ImplementPose& pose) const noexcept;
  bool is_own(const Eigen::Vector3d& point, const JointAngles& angles) const noexcept { return is_own(point, pose(angles)); }

private:
  struct Part {
    int link, vertices;
    double half_width;                             // m, with the margin
    double x_low, x_high, z_low, z_high;           // of the outline, with the margin
    double x[BERM_PART_VERTICES], z[BERM_PART_VERTICES];
  };
  bool near_outline(const Part& part, const Eigen::Vector2d& in_link) const noexcept;

  Kinematics kinematics_;
  double margin_, body_radius_;
  int parts_ = 0;
  Part part_[BERM_PARTS];
};

} // namespace berm::kernel
#endif
