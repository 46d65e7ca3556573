// A dig's loop on the soil's force (stentz-1999, 4.2; what is in the bucket by force: soil_force.hpp): how its path is left so that the bucket comes up full.
#pragma once

namespace berm::app {

struct FillSeen {
  double share = 0.0;       // of the goal that is in the bucket
  double planned = 0.0;     // share of all that the path cuts that it was planned to have cut here; 0 before the soil
};

// The attitude to which the bucket is curled at least, rad: a bucket that fills curls, so that it keeps what is in it. now: to which it was; on_path: the path's own.
double curl_for(const FillSeen& seen, double now, double on_path, double dt);

// How far the tip is over its path, m (negative: under it): where less has come into the bucket than the plan had here the soil lies lower than it seemed, and the
// tip goes deeper. now: how far it is; to_floor: where the lowest is that it may be led to, from the path.
double lift_for(const FillSeen& seen, double now, double to_floor, double dt);

}  // namespace berm::app
