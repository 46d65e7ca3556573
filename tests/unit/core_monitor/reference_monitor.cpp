#include "reference_monitor.hpp"

#include <algorithm>
#include <functional>

namespace berm::core_test {

int ReferenceCell::seen_height() const {
  std::vector<int> sorted = points;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  return sorted.size() == 1 ? sorted[0] : sorted.at(1);
}

void ReferenceMonitor::point(int y, int x, int z, bool interpolated, std::int64_t now) {
  if (y < 0 || y >= side_ || x < 0 || x >= side_) return;
  ReferenceCell& c = cells_[{y, x}];
  if (interpolated && c.fresh != Fresh::kEmpty) return;
  if (c.fresh == Fresh::kEmpty) c.since = now;
  if (c.fresh != Fresh::kSet && c.fresh != Fresh::kNotVisited) c.points.clear();
  c.points.push_back(std::clamp(z, -20000, 20000));
  c.fresh = interpolated ? Fresh::kInterpolated : Fresh::kSet;
}

const ReferenceCell* ReferenceMonitor::find(int y, int x) const {
  static const ReferenceCell kBlank;
  if (y < 0 || y >= side_ || x < 0 || x >= side_) return nullptr;
  const auto found = cells_.find({y, x});
  return found == cells_.end() ? &kBlank : &found->second;
}

ReferenceMonitor::Verdict ReferenceMonitor::judge(int y, int x) const {
  const ReferenceCell& c = *find(y, x);
  if (c.held == Held::kEmpty || c.seen_height() - c.height <= rules_.height_threshold) return Verdict::kNothing;
  if (c.points.size() == 1) return Verdict::kDoubtful;
  int empty = 0;
  for (const auto& [dy, dx] : {std::pair{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}) {
    const ReferenceCell* n = find(y + dy, x + dx);
    if (n == nullptr) continue;
    if (n->held == Held::kEmpty) ++empty;
    if (n->held != Held::kSet) continue;
    const bool nearly_as_high = n->height > c.seen_height() - rules_.neighbour_threshold;
    const bool edge = n->height - c.height > rules_.slope_threshold;
    if (nearly_as_high || edge) return Verdict::kChanged;
  }
  return empty >= 2 ? Verdict::kChanged : Verdict::kObstacle;
}

// Nothing moves in the cell.
void ReferenceMonitor::merge_calm(ReferenceCell& c) const {
  const int z = c.seen_height();
  const bool measured = c.fresh != Fresh::kInterpolatedNotVisited;
  if (c.held == Held::kEmpty || (c.held == Held::kInterpolated && measured)) {
    c.held = measured ? Held::kSet : Held::kInterpolated;
    c.height = z;
    return;
  }
  bool cleared = false;
  if (c.held == Held::kChanged || c.held == Held::kObstacle) {
    if (!rules_.continuous) cleared = 2 * (z - c.height) < rules_.height_threshold;
    else if (c.held == Held::kChanged) cleared = c.height - z > rules_.height_threshold;
    else cleared = c.obstacle_height - z > rules_.height_threshold && z - c.height <= rules_.height_threshold;
    if (!cleared && c.held == Held::kObstacle) return;
    if (cleared) c.held = Held::kSet;
  }
  if (rules_.continuous && measured) c.height = z;
  else if (rules_.continuous || cleared) c.height = std::min(c.height, z);
}

void ReferenceMonitor::merge(ReferenceCell& c, Verdict verdict) const {
  const int z = c.seen_height();
  if (verdict == Verdict::kNothing) {
    merge_calm(c);
  } else if (c.held == Held::kObstacle) {
    c.obstacle_height = std::max(c.obstacle_height, z);
  } else {
    c.held = verdict == Verdict::kChanged ? Held::kChanged : Held::kObstacle;
    c.obstacle_height = z;
    if (verdict == Verdict::kChanged && rules_.continuous) c.height = z;
  }
  c.fresh = Fresh::kEmpty;
  c.points.clear();
}

void ReferenceMonitor::update(std::int64_t now) {
  std::vector<std::pair<ReferenceCell*, Verdict>> judged;
  std::vector<ReferenceCell*> in_progress;
  for (auto& [place, c] : cells_) {
    const bool late = now - c.since >= rules_.wait || now < c.since;
    if (c.fresh == Fresh::kNotVisited || (c.fresh == Fresh::kSet && late)) judged.emplace_back(&c, judge(place.first, place.second));
    else if (c.fresh == Fresh::kInterpolatedNotVisited) judged.emplace_back(&c, Verdict::kNothing);
    else if (c.fresh != Fresh::kEmpty) in_progress.push_back(&c);
  }
  for (const auto& [c, verdict] : judged) {
    if (verdict == Verdict::kDoubtful) c->fresh = Fresh::kInterpolatedNotVisited;
    merge(*c, verdict == Verdict::kDoubtful ? Verdict::kNothing : verdict);
  }
  for (ReferenceCell* c : in_progress) c->fresh = c->fresh == Fresh::kSet ? Fresh::kNotVisited : Fresh::kInterpolatedNotVisited;
}

}  // namespace berm::core_test
