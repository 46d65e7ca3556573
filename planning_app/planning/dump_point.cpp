#include "planning/dump_point.hpp"

#include <array>
#include <cmath>

namespace berm::app {

DumpPoint choose_dump_point(const BedMap& bed, double bucket_half_width, double since_s) {
  constexpr double enough_seen = 0.25;
  constexpr int thirds = 3;
  constexpr double wall_guard = 0.25;
  constexpr double zone_guard = 0.9;  // how far the bucket's tip leans out beyond the point, and the swing's way to a stop
  const double half = 0.5 * bed.bed().length;
  const double first = std::fmin(0.0, std::fmax(-half, bed.bed().zone_low + zone_guard));
  const double last = std::fmax(0.0, std::fmin(half, bed.bed().zone_high - zone_guard));
  const double third_length = (last - first) / thirds;
  const bool observed = bed.seen_share(since_s) >= enough_seen;
  // From the middle outward: an even first layer begins where the axles share the weight.
  constexpr std::array<int, thirds> order{1, 0, 2};
  int best = order[0];
  double least = INFINITY;
  for (const int third : order) {
    const double low = first + third * third_length, high = low + third_length;
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
  const double farthest = half - bucket_half_width - wall_guard;
  const double wanted = first + (best + 0.5) * third_length;
  point.u = std::fmin(farthest, std::fmax(-farthest, wanted));
  double x = 0.0, y = 0.0;
  from_bed(bed.bed(), {point.u, 0.0}, x, y);
  point.bearing = std::atan2(y, x);
  point.radius = std::hypot(x, y);
  return point;
}

}  // namespace berm::app
