// The drag of one dig: a path of the bucket's tip and attitude in the swing plane, and the follower that turns it into velocity requests.
#pragma once

#include <optional>
#include <vector>

#include "motion/arm_controller.hpp"
#include "motion/arm_kinematics.hpp"

namespace berm::app {

struct DigWaypoint {
  double r = 0.0, z = 0.0;   // tip
  double attitude = 0.0;     // absolute bucket angle
};

// The pose of a waypoint (swing 0), as paths have it: where a joint's range forbids the attitude, with the nearest that is possible. Nothing when the tip
// itself is out of reach.
std::optional<Joints> pose_at(const MachineModel& machine, const DigWaypoint& waypoint);

class DigPath {
public:
  static constexpr double spacing = 0.04;         // m
  // Waypoints are joined by straight lines, sampled so far apart and solved by pose_at. Nothing when that gives none.
  static std::optional<DigPath> solve(const MachineModel& machine, const std::vector<DigWaypoint>& waypoints, double apart = spacing);

  double length() const { return length_; }       // m, of the tip's way (a turn on the spot counts by its arc at the tip)
  Joints at(double s) const;                      // swing entry 0
  Joints slope(double s) const;                   // d joints / ds

private:
  struct Sample { double s = 0.0; Joints q{}; };
  std::size_t segment(double s) const;

  std::vector<Sample> samples_;
  double length_ = 0.0;
};

// m/s of the tip where the path's joints turn by so much a metre: as wanted, or as the joints can.
double speed_along(const MachineModel& machine, const Joints& slope, double wanted);
// m/s of the tip that a dig wants in the air, and in soil.
constexpr double drag_air_speed = 3.6, drag_soil_speed = 1.8;

// Follows a path. The reference waits for joints that soil holds back.
class DigFollower {
public:
  void begin(DigPath path) { path_ = std::move(path); s_ = stalled_ = 0.0; departure_ = last_departure_ = {}; }
  bool finished() const { return path_ && s_ >= path_->length(); }
  double progress() const { return path_ ? s_ / path_->length() : 0.0; }
  double stalled_s() const { return stalled_; }   // for how long the joints have not come after the reference
  Joints on_path() const { return path_ ? path_->at(s_) : Joints{}; }  // where the reference would be had it not departed
  // How the reference departs from the path: the tip over it, m (negative: under it); the bucket curled at least as far as the attitude. As far as
  // the joints reach.
  struct Departure { double lift = 0.0, curl = 0.0; };
  const Departure& departure() const { return departure_; }
  void depart(const Departure& departure) { departure_ = departure; }

  // Requests for this cycle, none before a path was begun; speed: of the tip along the path, m/s; held_swing: where the swing stays.
  Joints step(const MachineModel& machine, ArmController& arm, double held_swing, double speed, const Joints& angle, const Joints& velocity);

private:
  static Joints departed(const MachineModel& machine, const Joints& on_path, const Departure& departure);

  std::optional<DigPath> path_;
  double s_ = 0.0;
  double stalled_ = 0.0;
  Departure departure_, last_departure_;
};

}  // namespace berm::app
