#include "recognition/bed_model.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kAlongFace = 1e-12;  // m: a ray whose ends differ by less goes along the faces of an axis

// A ray's way through a rectangle of faces in plan, in shares of the ray: by each axis it is between the faces from in to out. No branches: what a ray
// meets is as good as random, and a branch that is foretold wrongly costs more than all of this.
struct Crossing {
  double in_u, out_u, in_v, out_v;
  Crossing(double a_u, double a_v, double one_by_u, double one_by_v, const BedRectangle& faces) {
    const double rear = (faces.rear - a_u) * one_by_u, front = (faces.front - a_u) * one_by_u;
    const double right = (-faces.side - a_v) * one_by_v, left = (faces.side - a_v) * one_by_v;
    in_u = std::min(rear, front), out_u = std::max(rear, front);
    in_v = std::min(right, left), out_v = std::max(right, left);
  }
  [[nodiscard]] double in() const { return std::max(in_u, in_v); }
  [[nodiscard]] double out() const { return std::min(out_u, out_v); }
  [[nodiscard]] int in_axis() const { return in_v > in_u ? 1 : 0; }
  [[nodiscard]] int out_axis() const { return out_v < out_u ? 1 : 0; }
};

double one_by(double d) { return 1.0 / (std::abs(d) < kAlongFace ? std::copysign(kAlongFace, d) : d); }

}  // namespace

Eigen::Matrix3d BedPose::rotation() const {
  const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch), cr = std::cos(roll), sr = std::sin(roll);
  Eigen::Matrix3d r;
  r << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, -sp, cp * sr, cp * cr;
  return r;
}

double BedPose::face(int axis, int side, bool outer) const {
  const double inner = (axis == 0 ? length : width) / 2;
  return outer && !(axis == 0 && side == open_end) ? inner + thickness : inner;
}

bool below_pipe(const Eigen::Vector3d& a, const Eigen::Vector3d& d, double half_outer, double slack) {
  const double y = a.y(), z = a.z() + kPipeUpright, along = d.y() * d.y() + d.z() * d.z(), half = y * d.y() + z * d.z();
  const double root = half * half - along * (y * y + z * z - half_outer * half_outer);
  return root <= 0.0 || 1.0 <= (-half - std::sqrt(root)) / along + slack;
}

BedFaces::BedFaces(const BedPose& pose)
    : pose_(pose), outer_{-pose.face(0, -1, true), pose.face(0, 1, true), pose.face(1, 1, true)},
      inner_{-pose.face(0, -1, false), pose.face(0, 1, false), pose.face(1, 1, false)} {}

RayMeeting BedFaces::meet(const Eigen::Vector3d& a, const Eigen::Vector3d& end) const {
  RayMeeting m;
  const Eigen::Vector3d d = end - a;
  m.end = end;
  const double one_by_u = one_by(d.x()), one_by_v = one_by(d.y());
  const Crossing outer(a.x(), a.y(), one_by_u, one_by_v, outer_);
  const double in = outer.in(), out = outer.out();
  if (in >= out || in <= 0.0 || a.z() + in * d.z() < -kWallSeen) return m;
  m.entry = a + in * d;
  const double range = d.norm();
  m.axis = outer.in_axis();
  m.side = d[m.axis] > 0.0 ? -1 : 1;
  const auto leave = [&](const Crossing& c) { m.axis = c.out_axis(), m.side = d[m.axis] > 0.0 ? 1 : -1; };
  // From within: stopped by load or floor, by the face that it comes to, or not at all.
  const auto stopped_within = [&]() {
    const Crossing inner(a.x(), a.y(), one_by_u, one_by_v, inner_);
    leave(inner);
    m.off = (1.0 - inner.out()) * range;
    const bool out_of_end = m.axis == 0 && m.side == pose_.open_end;
    if (m.off < -kRangeGate || (out_of_end && m.off <= kRangeGate)) m.what = Meeting::inside;
    else if (out_of_end) m.what = Meeting::over;
    else m.what = m.off <= kRangeGate ? Meeting::inner_face : Meeting::through_inner;
  };
  const bool open = m.axis == 0 && m.side == pose_.open_end;
  if (m.entry.z() < 0.0) {
    m.off = (1.0 - in) * range;
    if (m.off < -kRangeGate) {
      m.what = Meeting::before;
    } else if (open && std::abs(m.entry.y()) < pose_.width / 2) {
      m.by_open_end = true;
      stopped_within();
    } else {
      m.what = m.off <= kRangeGate                                                           ? Meeting::outer_face
               : m.axis == 1 && below_pipe(a, d, outer_.side, kRangeGate / range) ? Meeting::below_side
                                                                                             : Meeting::through_face;
    }
    return m;
  }
  if (m.entry.z() > 0.1 && std::abs(1.0 - in) * range < kRangeGate) {
    m.what = Meeting::above_face;
    return m;
  }
  if (in * range > range + kRangeGate) {
    m.what = Meeting::before;
    return m;
  }
  if (d.z() >= 0.0) {
    m.what = Meeting::over;
    return m;
  }
  const double to_rim = -a.z() / d.z();
  m.rim = a + to_rim * d;
  if (to_rim >= out) {
    leave(outer);
    m.what = out > 1.0 ? Meeting::before : Meeting::over;
    return m;
  }
  m.off = (1.0 - to_rim) * range;
  const bool over_opening = m.rim.x() < inner_.front && m.rim.x() > inner_.rear && std::abs(m.rim.y()) < pose_.width / 2;
  if (!over_opening) {
    m.what = m.off < -kTopGate ? Meeting::before : m.off <= kTopGate ? Meeting::wall_top : Meeting::through_top;
    for (int axis = 0; axis < 2; ++axis)
      for (int side = -1; side <= 1; side += 2)
        if (m.rim[axis] * side >= pose_.face(axis, side, false)) m.axis = axis, m.side = side;
    return m;
  }
  if (m.off < -0.1) m.what = Meeting::before;
  else stopped_within();
  return m;
}

RayMeeting meet_in_bed(const BedPose& pose, const Eigen::Vector3d& a, const Eigen::Vector3d& end) { return BedFaces(pose).meet(a, end); }

RayMeeting meet(const BedPose& pose, const Eigen::Matrix3d& rotation, const Ray& ray) {
  return meet_in_bed(pose, rotation.transpose() * (ray.head.cast<double>() - pose.middle), rotation.transpose() * (ray.at.cast<double>() - pose.middle));
}

}  // namespace berm::app
