// The evidence that a sweep's rays are for a bed: each is followed through the model, and what it meets counts for it or against it (bed_model.hpp says what
// a ray can meet, evidence_weights.hpp what that weighs). A search weighs tens of thousands of poses, so rays are packed and followed eight at a time.
#pragma once

#include <vector>

#include "recognition/packed_rays.hpp"

namespace berm::app {

struct BedScore {
  double score = 0.0;
  double end_face = 0.0;  // of it, for returns on outer faces of ends
};

struct BedEvidence : BedScore {
  int outer_face = 0, inner_face = 0, wall_top = 0, inside = 0, through = 0, before = 0, over = 0, above_face = 0, above_inner = 0;
  int level_inside = 0;  // of the returns over the opening, within 5 cm of the plane of the tops, more than 0.3 m from the walls
  int below_inside = 0;  // more than 5 cm below that plane
  int above_inside = 0;
  int not_soil = 0;      // within or over the opening, too steep for soil
};

BedEvidence weigh(const BedPose& pose, const PackedRays& rays);
BedEvidence weigh(const BedPose& pose, const std::vector<Ray>& rays);
// The same without what was counted.
BedScore score_with_ends(const BedPose& pose, const PackedRays& rays);
// The score alone.
double score_of(const BedPose& pose, const PackedRays& rays);

}  // namespace berm::app
