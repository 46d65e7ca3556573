// Asking the operator to move the machine back from a face that is dug out: when, and how the horn says it (contract/horn_signals.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>

namespace berm::app {

// Whether the face still gives good passes, by what the last ones brought of what they should.
class FaceYield {
public:
  void add(double share) {
    share_.push_back(share);
    if (share_.size() > remembered) share_.pop_front();
  }
  void clear() { share_.clear(); }
  // The last passes brought less than half of what they should, on average, and the newest two no more: after a move the first digs are trials.
  bool poor() const {
    double sum = 0.0;
    for (const double s : share_) sum += std::min(1.0, s);
    const std::size_t n = share_.size();
    return n == remembered && sum < 0.5 * static_cast<double>(n) && share_[n - 1] < 0.5 && share_[n - 2] < 0.5;
  }

private:
  static constexpr std::size_t remembered = 5;
  std::deque<double> share_;
};

// Whether the horn sounds, so long after the call began: the signal for that distance, again and again.
bool sounds_move_back(double since_s, double distance_m);

}  // namespace berm::app
