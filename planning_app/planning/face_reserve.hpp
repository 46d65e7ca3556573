// What the dig face within reach still holds, and how far the machine should move back to reach fresh ground (stentz-1999, 4.2: the face is eroded until
// the machine has to be moved).
#pragma once

#include "planning/site_model.hpp"
#include "planning/dig_ground.hpp"

namespace berm::app {

struct FaceReserve {
  double volume = 0.0;  // bank m3 over what the digs leave, between the radii of a drag and inside the dig zone
  double crest = 0.0;   // where the ground begins to fall, distance from the swing axis, mean over the site's bearings
};

// ground: what is known of it. lowest: z below which no dig goes; width: of the bucket, m.
FaceReserve face_reserve(const SiteModel& site, const DigGround& ground, double lowest, double width);

// How far back, in steps of step, at least one and at most most steps: the crest shall lie a little beyond where a drag ends.
double back_distance(const SiteModel& site, const FaceReserve& face, double step, int most);

}  // namespace berm::app
