// The Workspace Monitor once more, from safety_kernel/requirements/workspace_monitor.md and not from the kernel's code: cells in a std::map, points kept
// whole and sorted when they are needed, no list.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace berm::core_test {

enum class Held { kEmpty, kSet, kInterpolated, kChanged, kObstacle };
enum class Fresh { kEmpty, kSet, kInterpolated, kNotVisited, kInterpolatedNotVisited };

struct ReferenceRules {
  int height_threshold, neighbour_threshold, slope_threshold;
  std::int64_t wait;
  bool continuous;
};

struct ReferenceCell {
  Held held = Held::kEmpty;
  int height = 0, obstacle_height = 0;  // meaningless while EMPTY; the second of meaning for an OBSTACLE
  Fresh fresh = Fresh::kEmpty;
  std::vector<int> points;
  std::int64_t since = 0;

  int seen_height() const;
};

class ReferenceMonitor {
 public:
  ReferenceMonitor(const ReferenceRules& rules, int side) : rules_(rules), side_(side) {}
  void point(int y, int x, int z, bool interpolated, std::int64_t now);
  void update(std::int64_t now);
  ReferenceCell& at(int y, int x) { return cells_[{y, x}]; }

 private:
  enum class Verdict { kNothing, kDoubtful, kChanged, kObstacle };  // doubtful: rises by one point alone
  Verdict judge(int y, int x) const;
  const ReferenceCell* find(int y, int x) const;
  void merge(ReferenceCell& cell, Verdict verdict) const;
  void merge_calm(ReferenceCell& cell) const;

  ReferenceRules rules_;
  int side_;
  std::map<std::pair<int, int>, ReferenceCell> cells_;
};

}  // namespace berm::core_test
