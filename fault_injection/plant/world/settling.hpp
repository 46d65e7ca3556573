// Local relaxation of a soil surface: only cells that were touched, or whose neighbour gave way, are looked at again.
//
// A Field is a rectangle of cells that offers:
//   int count_x(), count_y();
//   double height(ix, iy)                      also one cell beyond the rim: +infinity holds the soil, a finite height lets it fall out
//   double distance(dx, dy)                    between the centres of neighbours
//   double give(ix, iy, jx, jy)                moves soil from (ix, iy) to (jx, jy) if the step between them is too steep; returns the
//                                              height that left (ix, iy), 0 when it stands
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace berm::plant {

class Settling {
 public:
  Settling(int count_x, int count_y) : count_x_(count_x), count_y_(count_y), queued_(static_cast<size_t>(count_x) * static_cast<size_t>(count_y), 0) {}

  // The cell's height changed: it and its neighbours may no longer stand.
  void touch(int ix, int iy) {
    for (int y = iy - 1; y <= iy + 1; ++y) {
      for (int x = ix - 1; x <= ix + 1; ++x) push(x, y);
    }
  }

  // Looks at no more than `budget` cells; the rest waits for the next call. Returns how many it looked at.
  template <class Field>
  int run(Field& field, int budget) {
    int looked = 0;
    while (looked < budget && !queue_.empty()) {
      const int cell = queue_.front();
      queue_.pop_front();
      queued_[static_cast<size_t>(cell)] = 0;
      ++looked;
      relax(field, cell % count_x_, cell / count_x_);
    }
    return looked;
  }

  [[nodiscard]] bool at_rest() const { return queue_.empty(); }

 private:
  template <class Field>
  void relax(Field& field, int ix, int iy) {
    // The steepest way down only: the cell is queued again while it moves.
    int best_x = ix, best_y = iy;
    double steepest = 0;
    const double h = field.height(ix, iy);
    for (int y = iy - 1; y <= iy + 1; ++y) {
      for (int x = ix - 1; x <= ix + 1; ++x) {
        if (x == ix && y == iy) continue;
        const double drop = (h - field.height(x, y)) / field.distance(x - ix, y - iy);
        if (drop > steepest) {
          steepest = drop;
          best_x = x;
          best_y = y;
        }
      }
    }
    if (steepest <= 0 || field.give(ix, iy, best_x, best_y) <= 0) return;
    touch(ix, iy);
    touch(best_x, best_y);
  }

  void push(int x, int y) {
    if (x < 0 || y < 0 || x >= count_x_ || y >= count_y_) return;
    const int cell = y * count_x_ + x;
    if (queued_[static_cast<size_t>(cell)]) return;
    queued_[static_cast<size_t>(cell)] = 1;
    queue_.push_back(cell);
  }

  int count_x_, count_y_;
  std::vector<uint8_t> queued_;
  std::deque<int> queue_;
};

}  // namespace berm::plant
