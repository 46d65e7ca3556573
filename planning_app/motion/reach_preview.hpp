// The app's own estimate of what the kernel will ask for: the interval each joint may run through if it is stopped one cycle from now, and
// the lower edge of the implements over those intervals. Written from the machine file's figures, not from the kernel's code: the kernel
// decides, this only keeps the app from asking for what would be refused.
#pragma once

#include <array>

#include "motion/machine_model.hpp"

namespace berm::app {

struct ReachIntervals {
  Joints low{}, high{};
  double swing_speed = 0.0;  // bound until standstill, rad/s
  double reach = 0.0;        // farthest point of the implements from the swing axis over the intervals, m
};

// How far a joint can still go in the direction of velocity (rad/s, negative: it moves the other way) when stopped one cycle from now; rad.
double stop_travel(const MachineModel& machine, std::size_t joint, double reach_m, double velocity);

// The largest speed up to wanted (its sign is the direction) whose stop travel stays inside the joint's range; 0 when none does.
double within_range(const MachineModel& machine, std::size_t joint, double reach_m, double angle, double wanted);

ReachIntervals preview(const MachineModel& machine, const Joints& angle, const Joints& velocity);

// Lowest z of stick and bucket over boom, stick and bucket intervals, by distance from the swing axis.
class LowerEdge {
public:
  static constexpr int bins = 60;
  static constexpr double bin_m = 0.2;
  static constexpr double none = 1e9;  // no implement in this bin

  LowerEdge(const MachineModel& machine, const ReachIntervals& box);

  double z(int bin) const { return z_[static_cast<std::size_t>(bin)]; }
  double lowest() const;
  double reach() const { return reach_; }         // m
  double nearest() const { return nearest_; }     // m, least distance of stick and bucket from the axis
  double half_width() const { return half_width_; }

private:
  std::array<double, bins> z_;
  double reach_ = 0.0, nearest_ = none, half_width_ = 0.0;
};

// Whether the kernel lets stick and bucket be so near to the machine's own body, for its cells are never seen.
bool clears_own_body(const MachineModel& machine, const LowerEdge& edge);

// Lower edge and reach of one pose, without any spread.
LowerEdge lower_edge(const MachineModel& machine, const Joints& pose);

// z of the bucket's underside in a pose.
double bucket_underside(const MachineModel& machine, const Joints& pose);

// Of the bucket's cutting edge.
double bucket_width(const MachineModel& machine);

// From how near to how far from the swing axis a part lies in a pose, in the swing plane, m.
struct Extent { double near, far; };
Extent extent_of(const MachineModel& machine, const Prism& part, const Joints& pose);

// Farthest point of the implements from the swing axis in a pose.
double reach_of(const MachineModel& machine, const Joints& pose);

}  // namespace berm::app
