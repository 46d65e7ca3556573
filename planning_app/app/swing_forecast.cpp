#include "app/swing_forecast.hpp"

#include <algorithm>

namespace berm::app {

void SwingForecast::Shortest::add(double seconds) {
  last_s_[next_] = seconds;
  next_ = (next_ + 1) % last_s_.size();
}

double SwingForecast::Shortest::seconds() const { return *std::min_element(last_s_.begin(), last_s_.end()); }

double SwingForecast::step(double time_s, Work work, double done) {
  constexpr double never = 1e9;
  constexpr double least_done = 0.05;  // before that how long it takes cannot be told
  if (work != work_) {
    // What then waits for the scanner was ready; the wait is none of its time.
    if (work_ == Work::lifts && (work == Work::other || work == Work::waits)) lift_.add(time_s - began_s_);
    began_s_ = time_s;
    work_ = work;
  }
  const double so_far = time_s - began_s_;
  switch (work) {
    case Work::digs: return done < least_done ? never : so_far * std::max(0.0, 1.0 - done) / done + lift_.seconds();
    case Work::lifts: return std::max(0.0, lift_.seconds() - so_far);
    case Work::waits: return 0.0;
    case Work::other: return never;
  }
  return never;
}

}  // namespace berm::app
