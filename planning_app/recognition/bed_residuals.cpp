#include "recognition/bed_residuals.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace berm::app {
namespace {

using Eigen::Vector3d;

double in_bed(const BedAxes& a, int axis, const Vector3d& at) { return a.axis[static_cast<std::size_t>(axis)].dot(at - a.middle); }

// Adds factor times the derivative of in_bed at a place that stays where it is.
void add_in_bed(const BedAxes& a, int axis, const Vector3d& at, double factor, BedVector& slope) {
  const auto k = static_cast<std::size_t>(axis);
  slope.head<3>() -= factor * a.axis[k];
  const Vector3d from = at - a.middle;
  for (std::size_t angle = 0; angle < 3; ++angle) slope[static_cast<Eigen::Index>(kBedYaw + angle)] += factor * a.turn[angle][k].dot(from);
}

bool has_thickness(const BedPlane& plane, int open_end) { return plane.outer && !(plane.axis == 0 && plane.side == open_end); }

double face(const BedPlane& plane, const BedVector& values, int open_end) {
  if (plane.axis == 2) return 0.0;
  const double inner = 0.5 * values[plane.axis == 0 ? kBedLength : kBedWidth];
  return has_thickness(plane, open_end) ? inner + values[kBedThickness] : inner;
}

void add_face(const BedPlane& plane, int open_end, double factor, BedVector& slope) {
  if (plane.axis == 2) return;
  slope[plane.axis == 0 ? kBedLength : kBedWidth] += 0.5 * factor;
  if (has_thickness(plane, open_end)) slope[kBedThickness] += factor;
}

double of_return(const BedConstraint& c, const BedAxes& a, const BedVector& values, int open_end, BedVector* slope) {
  const Vector3d at = c.at.cast<double>();
  const double side = c.plane.side, one = 1.0 / c.deviation;
  if (slope != nullptr) {
    slope->setZero();
    add_in_bed(a, c.plane.axis, at, side * one, *slope);
    add_face(c.plane, open_end, -one, *slope);
  }
  return (side * in_bed(a, c.plane.axis, at) - face(c.plane, values, open_end) - c.offset) * one;
}

double of_edge(const BedConstraint& c, const BedAxes& a, const BedVector& values, int open_end, BedVector* slope) {
  const Vector3d head = c.head.cast<double>(), to = c.at.cast<double>();
  const double side = c.plane.side, bound_side = c.bound.side, scale = c.sense / c.deviation;
  const double begin = in_bed(a, c.plane.axis, head) * side, end = in_bed(a, c.plane.axis, to) * side, one_by_across = 1.0 / (end - begin);
  const double share = (face(c.plane, values, open_end) - begin) * one_by_across;
  const double first = in_bed(a, c.bound.axis, head), way = in_bed(a, c.bound.axis, to) - first;
  const double y = (bound_side * (first + share * way) - face(c.bound, values, open_end)) * scale;
  if (y < -kCertain) {
    if (slope != nullptr) slope->setZero();
    return 0.0;
  }
  const double e = std::exp(std::min(y, kCertain)), r = std::sqrt(2.0 * (y > kCertain ? y : std::log(1.0 + e)));
  if (slope == nullptr) return r;
  // The crossing moves along the ray as the plane moves against it, and in the bed's frame as the bed does.
  const Vector3d at = head + share * (to - head);
  const double factor = scale * (y > kCertain ? 1.0 / r : e / ((1.0 + e) * r)), along = factor * bound_side * way * one_by_across;
  slope->setZero();
  add_in_bed(a, c.bound.axis, at, factor * bound_side, *slope);
  add_face(c.bound, open_end, -factor, *slope);
  add_in_bed(a, c.plane.axis, at, -along * side, *slope);
  add_face(c.plane, open_end, along, *slope);
  return r;
}

}  // namespace

BedVector values_of(const BedPose& p) {
  BedVector v;
  v << p.middle, p.yaw, p.pitch, p.roll, p.length, p.width, p.thickness;
  return v;
}

void set_values(BedPose& p, const BedVector& v) {
  p.middle = v.head<3>();
  p.yaw = v[kBedYaw], p.pitch = v[kBedPitch], p.roll = v[kBedRoll];
  p.length = v[kBedLength], p.width = v[kBedWidth], p.thickness = v[kBedThickness];
}

BedAxes::BedAxes(const BedVector& v) : middle(v.head<3>()) {
  BedPose pose;
  set_values(pose, v);
  const Eigen::Matrix3d rotation = pose.rotation();
  // What turns a bed: yaw about the upright, pitch about the level line across it, roll about its own length.
  const std::array<Vector3d, 3> about{Vector3d::UnitZ(), Vector3d(-std::sin(pose.yaw), std::cos(pose.yaw), 0.0), rotation.col(0)};
  for (std::size_t k = 0; k < 3; ++k) {
    axis[k] = rotation.col(static_cast<Eigen::Index>(k));
    for (std::size_t angle = 0; angle < 3; ++angle) turn[angle][k] = about[angle].cross(axis[k]);
  }
}

double residual(const BedConstraint& c, const BedAxes& axes, const BedVector& values, int open_end, BedVector* slope) {
  return c.edge ? of_edge(c, axes, values, open_end, slope) : of_return(c, axes, values, open_end, slope);
}

}  // namespace berm::app
