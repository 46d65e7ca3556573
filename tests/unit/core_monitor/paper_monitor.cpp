#include "paper_monitor.hpp"

#include <algorithm>

namespace berm::core_test {

PaperMonitor::PaperMonitor(PaperMerge merge, int side, int height_threshold, int neighbour_threshold, int slope_threshold)
    : merge_(merge),
      side_(side),
      height_threshold_(height_threshold),
      neighbour_threshold_(neighbour_threshold),
      slope_threshold_(slope_threshold),
      temporary_(static_cast<std::size_t>(side * side)),
      accumulated_(static_cast<std::size_t>(side * side)) {}

void PaperMonitor::modify(int y, int x, PaperFlag status) {
  Temporary& t = temporary_[index(y, x)];
  if (t.status == PaperFlag::kEmpty) modified_.emplace_back(y, x);
  t.status = status;
}

void PaperMonitor::point(int y, int x, int z) {
  Temporary& t = temporary_[index(y, x)];
  if (t.status != PaperFlag::kSet && t.status != PaperFlag::kNotVisited) {
    t.highest = z;
    t.second.reset();
  } else if (z >= t.highest) {
    t.second = std::exchange(t.highest, z);
  } else {
    t.second = std::max(t.second.value_or(z), z);
  }
  modify(y, x, PaperFlag::kSet);
}

void PaperMonitor::interpolated_point(int y, int x, int z) {
  Temporary& t = temporary_[index(y, x)];
  if (t.status != PaperFlag::kEmpty) return;
  t.highest = z;
  t.second.reset();
  modify(y, x, PaperFlag::kInterpolated);
}

// Figure 6.
void PaperMonitor::check_cell(int y, int x) {
  Cell& cell = accumulated_[index(y, x)];
  Temporary& temp_cell = temporary_[index(y, x)];
  if (temp_cell.height() - cell.height > height_threshold_) {
    int num_empty = 0;
    for (int ny = std::max(0, y - 1); ny <= std::min(side_ - 1, y + 1); ++ny)
      for (int nx = std::max(0, x - 1); nx <= std::min(side_ - 1, x + 1); ++nx) {
        if (ny == y && nx == x) continue;
        const Cell& n = accumulated_[index(ny, nx)];
        if (n.status == PaperFlag::kSet) {
          if (n.height > temp_cell.height() - neighbour_threshold_ || n.height - cell.height > slope_threshold_) {
            temp_cell.status = PaperFlag::kChanged;
            return;
          }
        } else if (n.status == PaperFlag::kEmpty) {
          temp_cell.status = PaperFlag::kChanged;
          num_empty = num_empty + 1;
          if (num_empty >= 2) return;
        }
      }
    cell.status = PaperFlag::kObstacle;
  }
}

// Figure 7.
void PaperMonitor::merge_figure_7(Temporary& temp_cell, Cell& cell) {
  if (temp_cell.status == PaperFlag::kNotVisited || temp_cell.status == PaperFlag::kINotVisited) {
    if ((cell.status == PaperFlag::kObstacle || cell.status == PaperFlag::kChanged) && temp_cell.height() < cell.height - height_threshold_) {
      if (cell.status == PaperFlag::kObstacle) ++notices_;
      cell.status = PaperFlag::kSet;
    }
  } else if (temp_cell.status == PaperFlag::kChanged) {
    cell.status = PaperFlag::kChanged;
  } else if (temp_cell.status == PaperFlag::kObstacle) {
    cell.status = PaperFlag::kObstacle;
    ++notices_;
  }
  cell.height = temp_cell.height();
}

// Figure 8.
void PaperMonitor::merge_figure_8(Temporary& temp_cell, Cell& cell) {
  if (temp_cell.status == PaperFlag::kNotVisited || temp_cell.status == PaperFlag::kINotVisited) {
    const PaperFlag asked = merge_ == PaperMerge::kFigure8Repaired ? cell.status : temp_cell.status;
    if (asked == PaperFlag::kObstacle || asked == PaperFlag::kChanged) {
      const int d_height = temp_cell.height() - cell.obstacle_height;
      if (d_height < height_threshold_ / 2 || (temp_cell.status == PaperFlag::kINotVisited && d_height < 0)) {
        if (cell.status == PaperFlag::kObstacle) ++notices_;
        cell.status = PaperFlag::kSet;
      }
    } else if (cell.status == PaperFlag::kEmpty) {
      cell.height = temp_cell.height();
      cell.status = PaperFlag::kSet;
    }
  } else if (temp_cell.status == PaperFlag::kChanged || temp_cell.status == PaperFlag::kObstacle) {
    cell.status = temp_cell.status;
    cell.obstacle_height = temp_cell.height();
    if (cell.status == PaperFlag::kObstacle) ++notices_;
  }
}

// Section 3.2.
void PaperMonitor::update() {
  for (const auto& [y, x] : modified_)
    if (temporary_[index(y, x)].status == PaperFlag::kNotVisited) check_cell(y, x);
  std::vector<std::pair<int, int>> rest;
  for (const auto& [y, x] : modified_) {
    Temporary& t = temporary_[index(y, x)];
    if (t.status == PaperFlag::kSet || t.status == PaperFlag::kInterpolated) {
      t.status = t.status == PaperFlag::kSet ? PaperFlag::kNotVisited : PaperFlag::kINotVisited;
      rest.emplace_back(y, x);
      continue;
    }
    if (merge_ == PaperMerge::kFigure7) merge_figure_7(t, accumulated_[index(y, x)]);
    else merge_figure_8(t, accumulated_[index(y, x)]);
    t.status = PaperFlag::kEmpty;
  }
  modified_ = std::move(rest);
}

}  // namespace berm::core_test
