#include "planning/bed_map.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

BedMap::BedMap(const TruckBed& bed, const ImplementScale& scale) : bed_(bed), scale_(scale), grid_(bed.length, bed.width), noted_(grid_), time_(grid_.height.size(), -1.0) {
  std::fill(noted_.known.begin(), noted_.known.end(), char{1});
}

void BedMap::insert(double x, double y, double z, double time_s) {
  constexpr double hand = 0.15;
  BedPoint p = to_bed(bed_, x, y);
  // In the bed's own frame, whose walls lean as its floor tilts; trucks tilt by a few degrees, whose cosine is 1.
  const double over_tops = z - bed_.top_at(p.u, p.v), over_middle = z - bed_.top_at(0.0, 0.0);
  p.u += bed_.rise_along * over_middle, p.v += bed_.rise_across * over_middle;
  if (std::fabs(p.u) > 0.5 * bed_.length - hand || std::fabs(p.v) > 0.5 * bed_.width - hand) return;
  const double above_floor = over_tops + bed_.height;
  if (above_floor > bed_.height + 1.0) return;  // no heap stands so high: the implements, or someone in the bed
  const std::size_t i = grid_.index(grid_.column_of(p.u), grid_.row_of(p.v));
  grid_.height[i] = std::max(0.0, above_floor);
  time_[i] = time_s;
}

void BedMap::note_dump(const BedPoint& at, double mass_kg) {
  load_.add(at, mass_kg);
  noted_ = settled(poured(noted_, {at.u, at.v, dump_along * scale_.width, dump_across * scale_.bucket, mass_kg, loose_density}), repose);
}

BedGrid BedMap::seen(double since_s) const {
  BedGrid out = grid_;
  for (std::size_t i = 0; i < time_.size(); ++i) out.known[i] = time_[i] >= 0.0 && time_[i] >= since_s ? 1 : 0;
  return out;
}

}  // namespace berm::app
