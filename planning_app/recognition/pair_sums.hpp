// Sums of weights over a bed's ends, and over pairs of them (bed_ends).
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "recognition/bed_ends.hpp"

namespace berm::app {

constexpr double kEndStep = 0.1;  // m between ends
constexpr int kEnds = static_cast<int>(2 * kEndReach / kEndStep) + 1;
constexpr float kNever = std::numeric_limits<float>::infinity();

constexpr float single(double v) { return static_cast<float>(v); }
inline double place_of(int end) { return -kEndReach + kEndStep * end; }
// The first end at or beyond u; kEnds when there is none.
inline int first_end(float u) {
  const float k = std::clamp((u + static_cast<float>(kEndReach)) * static_cast<float>(1.0 / kEndStep), 0.0F, static_cast<float>(kEnds));
  const int whole = static_cast<int>(k);
  return whole + (static_cast<float>(whole) < k ? 1 : 0);
}

class EndSums {
 public:
  // For the ends in [from, to).
  void add(float from, float to, float weight) {
    const int a = first_end(from), b = first_end(to);
    if (b <= a) return;
    sum_[static_cast<std::size_t>(a)] += weight;
    sum_[static_cast<std::size_t>(b)] -= weight;
  }
  void finish() {
    for (std::size_t k = 1; k < sum_.size(); ++k) sum_[k] += sum_[k - 1];
  }
  [[nodiscard]] float at(int end) const { return sum_[static_cast<std::size_t>(end)]; }

 private:
  std::array<float, kEnds + 1> sum_{};
};

// Lengths of beds, in steps between their ends.
struct Steps {
  int shortest, longest;
};

// Which of a pair's ends have a wall: both, the front one alone, the rear one alone; the fourth makes it a vector register.
using Ways = float __attribute__((vector_size(16)));
constexpr Ways kAnyWay{1.0F, 1.0F, 1.0F, 0.0F}, kWithRearWall{1.0F, 0.0F, 1.0F, 0.0F}, kWithFrontWall{1.0F, 1.0F, 0.0F, 0.0F};
constexpr Ways kNoWay{-kNever, -kNever, -kNever, -kNever};
constexpr float kRounding = 1e-3F;  // rays, of sums that are added up in another order
constexpr Ways kOpenRear{0.0F, 1.0F, 0.0F, 0.0F}, kOpenFront{0.0F, 0.0F, 1.0F, 0.0F};

inline bool any_positive(const Ways& w) {
  const auto mask = w > 0.0F;
  std::int64_t half[2];
  std::memcpy(half, &mask, sizeof half);
  return (half[0] | half[1]) != 0;
}

// Sums of weights, of each way, over pairs of ends (rear, front) that are a bed's length apart: a band beside the table's diagonal. A corner of a rectangle stands for
// all pairs at or beyond it at both ends, so it may as well lie where the first of these lie in the band.
class PairSums {
 public:
  explicit PairSums(const Steps& steps)
      : shortest_(steps.shortest), longest_(steps.longest), width_(longest_ - shortest_ + 1), corners_(static_cast<std::size_t>(kEnds * width_)) {}
  // For the rear ends in [rear_from, rear_to) with the front ends in [front_from, front_to).
  void add(int rear_from, int rear_to, int front_from, int front_to, const Ways& weights) {
    if (rear_to <= rear_from || front_to <= front_from) return;
    corner(rear_from, front_from, weights);
    corner(rear_to, front_from, -weights);
    corner(rear_from, front_to, -weights);
    corner(rear_to, front_to, weights);
  }
  // For the pairs that have all from low to high between them.
  void about(float low, float high, float weight) { add(0, first_end(low), first_end(high), kEnds, weight * kAnyWay); }
  // For those that have u between them, by so much at least (less than 0: beyond them).
  void between(float u, float margin, float weight) { about(u - margin, u + margin, weight); }
  // Hands on the sums of each pair of which, with what its ends add, one at least is more than 0, once all is added. of_rear, of_front: what each end adds. Of most rear ends the
  // best front end for each way tells that no pair comes to that.
  template <typename Take>
  void visit(const std::array<Ways, kEnds>& of_rear, const std::array<Ways, kEnds>& of_front, const Take& take) const {
    std::vector<Ways> column(static_cast<std::size_t>(kEnds + longest_ + 1));  // of each front end, of the rear ends until now
    Ways before{};                                                             // all front ends nearer than the shortest
    for (int rear = 0; rear + shortest_ < kEnds; ++rear) {
      Ways row = before, most = kNoWay;
      const int fronts = std::min(width_, kEnds - rear - shortest_);
      const Ways adds = of_rear[static_cast<std::size_t>(rear)];
      const Ways* const here = &corners_[static_cast<std::size_t>(rear * width_)];
      const Ways* const front_adds = &of_front[static_cast<std::size_t>(rear + shortest_)];
      Ways* const ends = &column[static_cast<std::size_t>(rear + shortest_)];
      for (int k = 0; k < fronts; ++k) {
        ends[k] += here[k];
        row += ends[k];
        const Ways with_front = row + front_adds[k];
        most = with_front > most ? with_front : most;
      }
      if (any_positive(most + adds + kRounding)) {
        row = before;
        for (int k = 0; k < fronts; ++k) {
          row += ends[k];
          if (any_positive(row + adds + front_adds[k])) take(rear, rear + shortest_ + k, row);
        }
      }
      before += ends[0];
    }
  }

 private:
  void corner(int rear, int front, const Ways& weight) {
    const int row = std::max(rear, front - longest_), column = std::max(front, row + shortest_);
    if (row < kEnds && front < kEnds) corners_[static_cast<std::size_t>(row * width_ + column - row - shortest_)] += weight;
  }
  int shortest_, longest_, width_;
  std::vector<Ways> corners_;
};

}  // namespace berm::app
