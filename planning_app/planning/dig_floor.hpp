// How deep a bucket may be led in a dig. The kernel allows contact with soil only while all that it checks stays over the dig zone's floor, and that is
// more than the tip: the shell, which comes to lie below the tip as the bucket curls, and the reach box of a slow drag about it.
#pragma once

#include <vector>

#include "motion/machine_model.hpp"
#include "planning/site_model.hpp"

namespace berm::app {

class DigFloor {
public:
  DigFloor(const MachineModel& machine, const SiteModel& site);

  // z below which the tip is nowhere led: the site's floor of the digs; where that cannot be dug in any pose, what can.
  double lowest() const { return lowest_; }
  // z of the tip, at a distance r (m) from the swing axis and with this attitude of the bucket (rad), as low as a slow drag may be there.
  double at(double r, double attitude) const;

private:
  // The table reaches as far as a dig's surface is followed.
  static constexpr double r_first = 4.0, r_step = 0.25, attitude_first = -180.0, attitude_step = 8.0;  // m; degrees
  static constexpr int radii = 25, attitudes = 13;

  double lowest_;
  std::vector<double> least_;  // z by radius and attitude, the zones' floors alone
};

}  // namespace berm::app
