#include "planning/dump_point.hpp"

#include <array>
#include <cmath>

namespace berm::app {

DumpPoint choose_dump_point(const BedMap& bed, double bucket_half_width, double since_s) {
  constexpr double enough_seen = 0.25;
  constexpr int thirds = 3;
  constexpr double wall_guard = 0.25;
  constexpr double zone_guard = 1.5;  // half the bucket, how far its tip leans out beyond the point, and the swing's way to a stop
  const double length = bed.bed().length;
  const bool observed = bed.seen_share(since_s) >= enough_seen;
  // From the middle outward: an even first layer begins where the axles share the weight.
  constexpr std::array<int, thirds> order{1, 0, 2};
  int best = order[0];
  double least = INFINITY;
  for (const int third : order) {
    const double low = -0.5 * length + third * length / thirds, high = low + length / thirds;
    const double fill = observed ? bed.mean_height(low, high, since_s) : bed.noted_mass(low, high);
    // Less than a hand or a hundredth of a truck more is no reason to leave the order.
    const double tie = observed ? 0.02 : 1.0;
    if (fill < least - tie) {
      least = fill;
      best = third;
    }
  }
  DumpPoint point;
  point.observed = observed;
  const double farthest = std::fmax(0.0, 0.5 * length - bucket_half_width - wall_guard - 2.0 * bed.bed().end_deviation);
  const double wanted = -0.5 * length + (best + 0.5) * length / thirds;
  const double lowest = std::fmin(0.0, std::fmax(-farthest, bed.bed().zone_low + zone_guard));
  const double highest = std::fmax(0.0, std::fmin(farthest, bed.bed().zone_high - zone_guard));
  point.u = std::fmin(highest, std::fmax(lowest, wanted));
  double x = 0.0, y = 0.0;
  from_bed(bed.bed(), {point.u, 0.0}, x, y);
  point.bearing = std::atan2(y, x);
  point.radius = std::hypot(x, y);
  return point;
}

}  // namespace berm::app
