// Mean of the on-board weighing's noisy values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>

namespace berm::app {

// Over everything since the reset.
class MeanWeight {
public:
  void reset() { sum_ = 0.0; count_ = 0; }
  void add(double kg) {
    if (kg < 0.0) return;  // unknown
    sum_ += kg;
    ++count_;
  }
  bool known() const { return count_ > 0; }
  std::size_t count() const { return count_; }
  double kg() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0; }

private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

// Over the newest values.
class RecentWeight {
public:
  void add(double kg) {
    if (kg < 0.0) return;
    newest_.push_back(kg);
    if (newest_.size() > most) newest_.pop_front();
  }
  double kg() const {  // 0 when unknown
    double sum = 0.0;
    for (const double kg : newest_) sum += kg;
    return newest_.empty() ? 0.0 : sum / static_cast<double>(newest_.size());
  }

private:
  static constexpr std::size_t most = 15;
  std::deque<double> newest_;
};

// What is in a bucket that weighs so much in the mean, kg. The weighing wavers by some 15 kg and never shows less than nothing, so that of an empty bucket it
// shows 6, and of one that holds 18 and more what is in it.
inline double left_in_bucket(double mean_kg) {
  constexpr double of_nothing = 6.0, as_it_is = 18.0;
  const double too_much = of_nothing * (as_it_is - mean_kg) / (as_it_is - of_nothing);
  return std::max(0.0, mean_kg - std::clamp(too_much, 0.0, of_nothing));
}

}  // namespace berm::app
