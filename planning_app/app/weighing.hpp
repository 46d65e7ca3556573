// Mean of the on-board weighing's noisy values.
#pragma once

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

}  // namespace berm::app
