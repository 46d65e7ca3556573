// One candidate of the refined dig planner through the forward model (stentz-1999, 4.2, Figure 13): from the compact parameters of a dig its drag, from that
// what it cuts and how long it takes, and whether arm and zones permit it.
#pragma once

#include <optional>
#include <vector>

#include "planning/dig_point.hpp"
#include "planning/goal_shape.hpp"

namespace berm::app {

struct DigParameters {
  double start = 0.0;    // of the tip where the drag begins, m from the swing axis
  double attack = 0.0;   // rad, the bucket's attitude there
  double depth = 0.0;    // greatest vertical depth under the surface, m
};

struct DigOutcome {
  double volume = 0.0;   // bank m3
  double seconds = 0.0;  // of the drag, and of the way out from where it ends
};

class DigForwardModel {
public:
  // All of it outlives the model.
  DigForwardModel(const MachineModel& machine, const SiteModel& site, const DigFloor& floor, const DigGround& ground, const DigNeeds& needs, const DigBounds& bounds);

  // From over the entry to the end with the bucket curled: nowhere under the bounds' floor, the kernel's and the site's goal.
  std::vector<DigWaypoint> drag(const DigParameters& dig) const;
  // What the drag does; nothing where the arm does not reach it.
  std::optional<DigOutcome> outcome(const DigParameters& dig) const;
  // Whether boom and stick keep off the soil that the bucket has not cut yet, stick and bucket off the machine's own body, and the bucket in the soil inside a dig zone.
  bool permitted(const DigParameters& dig) const;
  double surface(double r) const { return surface_.at(r); }

private:
  struct Profile { std::vector<double> r, z; };  // from the start inward
  Profile profile(double start) const;
  double lowest(double r, double attitude) const;
  double lift_seconds(const ArmPoints& end) const;
  bool in_zone(double r) const;

  const MachineModel* machine_;
  const SiteModel* site_;
  const DigFloor* floor_;
  const DigNeeds* needs_;
  DigBounds bounds_;
  SurfaceProfile surface_;
  GoalProfile goal_;
};

}  // namespace berm::app
