// When the next swing begins, at the soonest: while a bucket is filled, by how far it is; while it is lifted, by the shortest of the last few times.
#pragma once

#include <array>
#include <cstddef>

namespace berm::app {

class SwingForecast {
public:
  enum class Work {
    digs,
    lifts,   // from the dig's end until the swing to the truck begins
    waits,   // for nothing but the scanner, after that
    other
  };

  // Once a cycle. done: while it digs, the share of the dig that is done, 0..1. Seconds until the swing begins.
  double step(double time_s, Work work, double done = 0.0);

private:
  // The shortest of the last few.
  class Shortest {
  public:
    explicit Shortest(double first_s) { last_s_.fill(first_s); }
    void add(double seconds);
    double seconds() const;

  private:
    std::array<double, 4> last_s_;
    std::size_t next_ = 0;
  };

  Work work_ = Work::other;
  double began_s_ = 0.0;         // this work
  Shortest lift_{0.8};
};

}  // namespace berm::app
