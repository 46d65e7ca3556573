// The Workspace Monitor of leger-1998, section 3, to the letter of its text and of Figures 6, 7 and 8, for comparison with the kernel's. Where the paper is
// silent: a neighbour beyond the map is none; a cell that was merged is EMPTY in the temporary map again.
#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace berm::core_test {

enum class PaperFlag { kEmpty, kSet, kInterpolated, kNotVisited, kINotVisited, kChanged, kObstacle };
// kFigure8Repaired: Figure 8 whose first inner test asks the accumulated cell's status, as Figure 7 does; the temporary cell's can never be so there.
enum class PaperMerge { kFigure7, kFigure8, kFigure8Repaired };

class PaperMonitor {
 public:
  struct Cell {
    PaperFlag status = PaperFlag::kEmpty;
    int height = 0, obstacle_height = 0;
  };

  PaperMonitor(PaperMerge merge, int side, int height_threshold, int neighbour_threshold, int slope_threshold);
  void point(int y, int x, int z);
  void interpolated_point(int y, int x, int z);
  void update();

  Cell& cell(int y, int x) { return accumulated_[index(y, x)]; }
  PaperFlag temporary(int y, int x) const { return temporary_[index(y, x)].status; }
  int notices() const { return notices_; }  // calls of notifyPlannerOfChange

 private:
  struct Temporary {
    PaperFlag status = PaperFlag::kEmpty;
    int highest = 0;
    std::optional<int> second;
    int height() const { return second.value_or(highest); }
  };
  std::size_t index(int y, int x) const { return static_cast<std::size_t>(y * side_ + x); }
  void modify(int y, int x, PaperFlag status);
  void check_cell(int y, int x);
  void merge_figure_7(Temporary& temp_cell, Cell& cell);
  void merge_figure_8(Temporary& temp_cell, Cell& cell);

  PaperMerge merge_;
  int side_, height_threshold_, neighbour_threshold_, slope_threshold_, notices_ = 0;
  std::vector<Temporary> temporary_;
  std::vector<Cell> accumulated_;
  std::vector<std::pair<int, int>> modified_;
};

}  // namespace berm::core_test
