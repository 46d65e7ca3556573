#include "motion/script_tempo.hpp"

#include <algorithm>

namespace berm::app {

Joints tempos_of(const Script& script, const Joints& shares) {
  constexpr double least = 0.2;  // a swing that hardly moves may be waiting for the very joint
  constexpr double least_of_bucket = 0.05;  // less is a stop
  const double share = std::max(least, shares[swing]);
  Joints tempo{1.0, 1.0, 1.0, 1.0};
  for (const Joint j : {boom, stick, bucket})
    if (script.of(j).waited_for(swing)) tempo[j] = share;
  // A bucket that still opens when the swing has turned round is timed by it no more.
  if (script.of(swing).reached(RuleMark::returns) && script.of(bucket).rules()[static_cast<std::size_t>(script.of(bucket).active())].mark == RuleMark::opens) tempo[bucket] = 1.0;
  // What waited for the bucket is timed by the bucket: an arm that is drawn in as it opens, at a share of its speed, would be drawn in before a slowed one has opened.
  const double opens = std::max(least_of_bucket, tempo[bucket] * shares[bucket]);
  for (const Joint j : {boom, stick})
    if (script.of(j).waited_for(bucket)) tempo[j] = std::min(tempo[j], opens);
  return tempo;
}

}  // namespace berm::app
