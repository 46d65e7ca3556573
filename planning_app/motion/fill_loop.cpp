#include "motion/fill_loop.hpp"

#include <algorithm>

#include "motion/angles.hpp"

namespace berm::app {

double curl_for(const FillSeen& seen, double now, double on_path, double dt) {
  constexpr double curl_from = 0.4;                       // of the goal
  constexpr double holding = radians(-152.0), open = radians(-95.0);
  constexpr double speed_most = radians(45.0);
  if (seen.share <= curl_from) return now;
  const double wanted = open + (holding - open) * std::clamp((seen.share - curl_from) / (1.0 - curl_from), 0.0, 1.0);
  // From the path's own attitude on: asked for at once, the way in would wait for the bucket.
  return std::max(std::min(now, wanted), std::min(now, on_path) - speed_most * dt);
}

double lift_for(const FillSeen& seen, double now, double to_floor, double dt) {
  constexpr double gain = 0.8;                            // m/s for a bucket that lacks all of its goal
  constexpr double fastest = 0.5;                         // m/s
  constexpr double sure_share = 0.5;                      // of what the force says: too deep costs less than a bucket that ends its drag half full
  constexpr double deepest = 0.5;                         // m under the path
  if (seen.planned <= 0.0) return now;
  const double rate = std::clamp(gain * (sure_share * seen.share - seen.planned), -fastest, fastest);
  return std::clamp(now + rate * dt, std::max(to_floor, -deepest), std::max(to_floor, 0.0));
}

}  // namespace berm::app
