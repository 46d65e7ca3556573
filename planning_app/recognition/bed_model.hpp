// The model of a bed: an open box of walls with a common top, and what each ray of a sweep should meet of it.
// Bed frame: origin in the middle of the opening, u along the bed, v across (u x v = w), w up from the plane of the walls' tops. Metres, radians.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "recognition/evidence_weights.hpp"
#include "recognition/fans.hpp"

namespace berm::app {

struct BedPose {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double yaw = 0.0, pitch = 0.0, roll = 0.0;  // R = Rz(yaw) Ry(pitch) Rx(roll)
  double length = 0.0, width = 0.0, thickness = 0.0;
  int open_end = 0;                           // 1: no wall at +u; -1: none at -u; 0: walls all round

  [[nodiscard]] Eigen::Matrix3d rotation() const;
  // From the middle to a wall's inner or outer face; axis 0: u, 1: v; side: 1 or -1. Where the end is open both are the side walls' end.
  [[nodiscard]] double face(int axis, int side, bool outer) const;
};

// Takes places into a bed's frame.
class Placing {
 public:
  explicit Placing(const BedPose& pose) : turn_(pose.rotation().transpose()), shift_(-(turn_ * pose.middle)) {}
  [[nodiscard]] Eigen::Vector3d of(const Eigen::Vector3f& at) const { return of(Eigen::Vector3d(at.cast<double>())); }
  [[nodiscard]] Eigen::Vector3d of(const Eigen::Vector3d& at) const { return turn_.col(0) * at.x() + turn_.col(1) * at.y() + turn_.col(2) * at.z() + shift_; }

 private:
  Eigen::Matrix3d turn_;
  Eigen::Vector3d shift_;
};

struct Ray {
  Eigen::Vector3f head, at;  // from the sensor to the return; single precision, good to a micrometre
  bool upright = false;      // one of several returns one above the other
};

// Takes rays into a bed's frame. Rays that follow one another have the head of a whole fan: its place is kept.
class RayPlacing {
 public:
  explicit RayPlacing(const BedPose& pose) : place_(pose), at_(place_.of(head_)) {}
  // The returned place is that of the newest ray's head.
  const Eigen::Vector3d& head(const Ray& ray) {
    if (ray.head != head_) head_ = ray.head, at_ = place_.of(head_);
    return at_;
  }
  [[nodiscard]] Eigen::Vector3d end(const Ray& ray) const { return place_.of(ray.at); }

 private:
  Placing place_;
  Eigen::Vector3f head_ = Eigen::Vector3f::Zero();
  Eigen::Vector3d at_;
};

// Of the returns, what the model says of them.
enum class Meeting {
  none,          // the ray does not come to the bed, or below the walls
  before,        // ends before the bed, or above the plane of the tops: hidden, or heap
  outer_face,    // as predicted
  below_side,    // through the side's outer face as if it were upright, but where a half pipe's side may have drawn in
  above_face,    // in the plane of an outer face, but above the walls' tops
  wall_top,      // as predicted
  inside,        // between the tops' plane and the far wall's inner face
  inner_face,    // as predicted
  over,          // passes over the far wall, or out of the open end
  through_face,  // ends beyond a wall that should have stopped it
  through_inner,
  through_top
};

struct RayMeeting {
  Meeting what = Meeting::none;
  int axis = -1, side = 0;          // of the face that is entered (outer), or met last inside
  double off = 0.0;                 // m: measured less predicted range, where a surface is predicted
  bool by_open_end = false;         // entered below the tops where no wall stands; rim says nothing then
  Eigen::Vector3d entry, rim, end;  // in the bed frame: on the entered face's plane, on the plane of the tops, the return
};

// A side that may be that of a half pipe is upright for 0.08 m at least, and below that no farther in than a circle about the bed's axis. Whether a ray
// that goes from a by d to its return at 1, through the upright side's outer face (half the outer width from the middle), misses that circle, or ends
// no more than slack, a share of d, behind it.
bool below_pipe(const Eigen::Vector3d& a, const Eigen::Vector3d& d, double half_outer, double slack);

// A bed's faces in plan, in its frame: those of the ends, and the left one, opposite the right one.
struct BedRectangle {
  double rear, front, side;
};

// A bed's faces, for many rays.
class BedFaces {
 public:
  explicit BedFaces(const BedPose& pose);
  // a: the sensor, end: the return, in the bed frame.
  [[nodiscard]] RayMeeting meet(const Eigen::Vector3d& a, const Eigen::Vector3d& end) const;

 private:
  BedPose pose_;
  BedRectangle outer_, inner_;
};

RayMeeting meet_in_bed(const BedPose& pose, const Eigen::Vector3d& a, const Eigen::Vector3d& end);
RayMeeting meet(const BedPose& pose, const Eigen::Matrix3d& rotation, const Ray& ray);

}  // namespace berm::app
