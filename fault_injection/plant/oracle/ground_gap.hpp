// Vertical gap between a prism over the swing plane and the ground it hangs over.
#pragma once

#include <vector>

#include "plant/oracle/oracle.hpp"

namespace berm::plant::oracle {

struct Profile {                       // a part in the swing plane: (r, z) corners, and its half width
  std::vector<Eigen::Vector2d> corner;
  double half_width = 0;
};

struct Upright {                       // a part along a bearing from a point on the ground
  Profile part;
  double x = 0, y = 0, bearing = 0;
};

// Least gap over columns outside every zone, or `gap` when none below the part is less.
double gap_outside_zones(const Upright& upright, const Ground& ground, const std::vector<Zone>& zones, double gap);
// Least height of the part's corners over the floor of the zones they are in; 1e9 when none is.
double gap_over_floor(const Upright& upright, const std::vector<Zone>& zones);

}  // namespace berm::plant::oracle
