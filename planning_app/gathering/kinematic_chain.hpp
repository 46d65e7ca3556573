// A scanner on a kinematic chain in Denavit-Hartenberg form (zolynski-2012, section 3).
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

namespace berm::app {

// One link, classic convention: turn by theta about z, shift by d along z, shift by a along x, turn by alpha about x. Radians and metres.
struct DhLink {
  enum class Joint { kFixed, kRevolute, kPrismatic };
  double theta = 0.0, d = 0.0, a = 0.0, alpha = 0.0;
  Joint joint = Joint::kFixed;
  std::size_t encoder = 0;  // which joint value is added to theta (revolute) or d (prismatic); several links and scanners may share one
};

// The transform of one link at a joint's value.
Eigen::Isometry3d dh_transform(const DhLink& link, double joint_value);

// From the cloud's frame to a scanner's: in the scanner's frame x points along the beam of angle 0, y along that of 90 degrees, z along the normal of
// the scan plane; the origin is the optical centre.
class KinematicChain {
public:
  KinematicChain() = default;
  explicit KinematicChain(std::vector<DhLink> links) : links_(std::move(links)) {}

  // joint_values: by encoder number. Throws std::out_of_range when a link's encoder is not among them.
  Eigen::Isometry3d pose(std::span<const double> joint_values) const;
  const std::vector<DhLink>& links() const { return links_; }

private:
  std::vector<DhLink> links_;
};

// A scanner that pans (encoder 1) on an upper body that swings (encoder 0). The head's place in the upper body's frame, metres; from the base frame to
// the scan plane: x along the beam forward and level, y along the beam upward.
KinematicChain panning_scanner(double x, double y, double z);

}  // namespace berm::app
