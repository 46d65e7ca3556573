// Forward and inverse kinematics of the implements: the app's own code (kernel and plant have theirs, on purpose).
//
// In the swing plane a point is (r, z): r forward from the swing axis, z up from the ground. The angles are those of Figure 15 of
// stentz-1999: boom = elevation of its pin line, stick relative to the boom line, bucket relative to the stick line (negative folds in).
// The bucket's attitude is the absolute elevation of its pin-to-tip line: -90 deg points down, -180 deg is curled with the mouth up.
#pragma once

#include <optional>

#include "motion/machine_model.hpp"

namespace berm::app {

struct PlanePoint { double r = 0.0, z = 0.0; };
struct Point { double x = 0.0, y = 0.0, z = 0.0; };

struct ArmPoints {
  PlanePoint boom_pin, stick_pin, bucket_pin, tip;
  double stick_attitude = 0.0, bucket_attitude = 0.0;  // absolute elevations
};

ArmPoints forward(const MachineModel& machine, double boom_angle, double stick_angle, double bucket_angle);
inline ArmPoints forward(const MachineModel& machine, const Joints& q) { return forward(machine, q[boom], q[stick], q[bucket]); }

// A point of the swing plane in the base frame.
Point in_base(const PlanePoint& p, double swing_angle);

// Joint angles (swing 0) that put the bucket pin at the point with the bucket at the attitude. Nothing when the point is out of reach or
// a joint would come nearer than guard to an end of its range.
std::optional<Joints> inverse_pin(const MachineModel& machine, const PlanePoint& pin, double attitude, double guard = 0.0);

// The same for the tip.
std::optional<Joints> inverse_tip(const MachineModel& machine, const PlanePoint& tip, double attitude, double guard = 0.0);

}  // namespace berm::app
