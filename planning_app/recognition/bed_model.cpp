#include "recognition/bed_model.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

struct Crossing {
  double in = -1e9, out = 1e9;
  int in_axis = -1, in_side = 0, out_axis = -1, out_side = 0;
};

// Where a ray crosses the rectangle of the walls' faces in plan; in >= out: not at all.
Crossing cross(const BedPose& pose, const Eigen::Vector3d& a, const Eigen::Vector3d& d, bool outer) {
  Crossing c;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = -pose.face(axis, -1, outer), high = pose.face(axis, 1, outer);
    if (std::abs(d[axis]) < 1e-12) {
      if (a[axis] < low || a[axis] > high) c.out = -1e9;
      continue;
    }
    const int entered = d[axis] > 0.0 ? -1 : 1;
    const double in = ((entered < 0 ? low : high) - a[axis]) / d[axis], out = ((entered < 0 ? high : low) - a[axis]) / d[axis];
    if (in > c.in) c.in = in, c.in_axis = axis, c.in_side = entered;
    if (out < c.out) c.out = out, c.out_axis = axis, c.out_side = -entered;
  }
  return c;
}

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

RayMeeting meet_in_bed(const BedPose& pose, const Eigen::Vector3d& a, const Eigen::Vector3d& end) {
  RayMeeting m;
  const Eigen::Vector3d d = end - a;
  m.end = end;
  const Crossing outer = cross(pose, a, d, true);
  if (outer.in >= outer.out || outer.out <= 0.0 || outer.in <= 0.0) return m;
  const double range = d.norm();
  m.entry = a + outer.in * d;
  m.axis = outer.in_axis;
  m.side = outer.in_side;
  const auto leave = [&](const Crossing& c) { m.axis = c.out_axis, m.side = c.out_side; };
  // From within: stopped by load or floor, by the face that it comes to, or not at all.
  const auto stopped_within = [&]() {
    const Crossing inner = cross(pose, a, d, false);
    leave(inner);
    m.off = (1.0 - inner.out) * range;
    const bool out_of_end = m.axis == 0 && m.side == pose.open_end;
    if (m.off < -kRangeGate || (out_of_end && m.off <= kRangeGate)) m.what = Meeting::inside;
    else if (out_of_end) m.what = Meeting::over;
    else m.what = m.off <= kRangeGate ? Meeting::inner_face : Meeting::through_inner;
  };
  const bool open = m.axis == 0 && m.side == pose.open_end;
  if (m.entry.z() < 0.0) {
    if (m.entry.z() < -kWallSeen) return m;
    m.off = (1.0 - outer.in) * range;
    if (m.off < -kRangeGate) {
      m.what = Meeting::before;
    } else if (open && std::abs(m.entry.y()) < pose.width / 2) {
      m.by_open_end = true;
      stopped_within();
    } else {
      m.what = m.off <= kRangeGate                                                                        ? Meeting::outer_face
               : m.axis == 1 && below_pipe(a, d, pose.face(1, m.side, true), kRangeGate / range) ? Meeting::below_side
                                                                                                          : Meeting::through_face;
    }
    return m;
  }
  if (m.entry.z() > 0.1 && std::abs(1.0 - outer.in) * range < kRangeGate) {
    m.what = Meeting::above_face;
    return m;
  }
  if (outer.in * range > range + kRangeGate) {
    m.what = Meeting::before;
    return m;
  }
  if (d.z() >= 0.0) {
    m.what = Meeting::over;
    return m;
  }
  const double to_rim = -a.z() / d.z();
  m.rim = a + to_rim * d;
  if (to_rim >= outer.out) {
    leave(outer);
    m.what = outer.out > 1.0 ? Meeting::before : Meeting::over;
    return m;
  }
  m.off = (1.0 - to_rim) * range;
  const bool over_opening = m.rim.x() < pose.face(0, 1, false) && m.rim.x() > -pose.face(0, -1, false) && std::abs(m.rim.y()) < pose.width / 2;
  if (!over_opening) {
    m.what = m.off < -kTopGate ? Meeting::before : m.off <= kTopGate ? Meeting::wall_top : Meeting::through_top;
    for (int axis = 0; axis < 2; ++axis)
      for (int side = -1; side <= 1; side += 2)
        if (m.rim[axis] * side >= pose.face(axis, side, false)) m.axis = axis, m.side = side;
    return m;
  }
  if (m.off < -0.1) m.what = Meeting::before;
  else stopped_within();
  return m;
}

RayMeeting meet(const BedPose& pose, const Eigen::Matrix3d& rotation, const Ray& ray) {
  return meet_in_bed(pose, rotation.transpose() * (ray.head - pose.middle), rotation.transpose() * (ray.at - pose.middle));
}

BedEvidence weigh(const BedPose& pose, const std::vector<Ray>& rays) {
  BedEvidence e;
  double face[2] = {0.0, 0.0};  // on outer faces of ends and of sides
  const Eigen::Matrix3d turn = pose.rotation().transpose();
  Eigen::Vector3d head(0.0, 0.0, 0.0), a = -(turn * pose.middle);
  for (const Ray& ray : rays) {
    if (ray.head != head) head = ray.head, a = turn * (head - pose.middle);  // that of a whole fan
    const RayMeeting m = meet_in_bed(pose, a, turn * (ray.at - pose.middle));
    switch (m.what) {
      case Meeting::none:
      case Meeting::below_side: break;
      case Meeting::before: ++e.before; break;
      case Meeting::outer_face: ++e.outer_face, face[m.axis] += fit(m.off, kRangeGate); break;
      case Meeting::above_face: ++e.above_face, e.score -= kAbove; break;
      case Meeting::wall_top: ++e.wall_top, e.score += kTop * fit(m.off, kTopGate); break;
      case Meeting::inside:
        if (m.end.z() < -kDeepest) ++e.through, e.score -= kThrough;
        else ++e.inside, e.score += kInside;
        break;
      case Meeting::inner_face: ++e.inner_face, e.score += kInside + (1.0 - kInside) * fit(m.off, kRangeGate); break;
      case Meeting::over: ++e.over; break;
      case Meeting::through_face:
      case Meeting::through_inner: ++e.through, e.score -= kThrough; break;
      case Meeting::through_top: ++e.through, e.score -= 0.5 * kThrough; break;
    }
    if (m.what == Meeting::none || m.what == Meeting::outer_face || m.what == Meeting::below_side) continue;
    const Eigen::Vector3d& p = m.end;
    const double to_wall = std::min(pose.length / 2 - std::abs(p.x()), pose.width / 2 - std::abs(p.y()));
    if (to_wall < 0.0) continue;
    const bool steep = (ray.upright && to_wall > kUprightMargin) || to_wall < heap_margin(p.z());
    if (steep && p.z() > -kDeepest && p.z() < kUprightAbove && m.what != Meeting::through_face && m.what != Meeting::through_top) ++e.not_soil, e.score -= kUpright;
    if (to_wall < kLevelMargin) continue;
    if (std::abs(p.z()) < kLevelWithin) ++e.level_inside, e.score -= kLevel;
    e.below_inside += p.z() < -kLevelWithin ? 1 : 0;
    e.above_inside += p.z() > kLevelWithin ? 1 : 0;
  }
  e.score += saturated(face[0]) + saturated(face[1]);
  if (pose.open_end != 0) e.score -= kOpenEnd;
  return e;
}

}  // namespace berm::app
