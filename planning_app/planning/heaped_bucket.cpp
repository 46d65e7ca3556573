#include "planning/heaped_bucket.hpp"

#include <algorithm>

namespace berm::app {

void HeapedBucket::held(double weighed_kg) {
  if (weighed_kg > kg_) kg_ = std::min(weighed_kg, most_kg_);
}

void HeapedBucket::learn(double goal_kg, double weighed_kg, double impulse) {
  constexpr std::size_t digs = 3;
  constexpr double brought = 0.93;      // of the goal
  constexpr double alike = 0.02;        // of the weight
  constexpr double more_force = 1.12;
  constexpr double lightest_soil = 0.6;  // of the heaviest
  if (weighed_kg <= 0.0 || weighed_kg > brought * goal_kg) {
    short_.clear();
    return;
  }
  short_.push_back({weighed_kg, impulse});
  if (short_.size() > digs) short_.erase(short_.begin());
  if (short_.size() < digs) return;
  const auto [lightest, heaviest] = std::minmax_element(short_.begin(), short_.end(), [](const Dig& a, const Dig& b) { return a.kg < b.kg; });
  const auto [least, most] = std::minmax_element(short_.begin(), short_.end(), [](const Dig& a, const Dig& b) { return a.impulse < b.impulse; });
  if (heaviest->kg - lightest->kg > alike * heaviest->kg || most->impulse < more_force * least->impulse) return;
  kg_ = std::max(heaviest->kg, lightest_soil * most_kg_);
  short_.clear();
}

}  // namespace berm::app
