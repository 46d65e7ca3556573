// The shape of the ground that the digs of a site are to leave: its floor of the digs, and over it the parts of the site's goal.
#pragma once

#include <vector>

#include "planning/cut_model.hpp"
#include "planning/site_model.hpp"

namespace berm::app {

// z of the part of the goal that counts there; minus infinity where there is none and the floor of the digs alone holds.
double goal_part_height(const SiteModel& site, double x, double y);

// The goal's parts along a bearing: the highest over the bucket's width.
class GoalProfile {
public:
  GoalProfile(const MachineModel& machine, const SiteModel& site, double bearing, double width);

  double at(double r) const;
  // z of the tip, at a distance r from the swing axis and with this attitude of the bucket, with which its shell is nowhere under the goal.
  double least_tip(double r, double attitude) const;
  // z of the lowest ground that is to be left between two distances, where the floor of the digs is so low.
  double lowest(double nearest, double farthest, double floor) const;

private:
  double tip_along_ = 0.0;                       // from the bucket's pin to its tip, m
  std::vector<double> z_;                        // at SurfaceProfile's places; none where the site's goal has no part
  std::vector<std::array<double, 2>> shell_;
};

}  // namespace berm::app
