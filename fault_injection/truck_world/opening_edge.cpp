#include "truck_world/opening_edge.hpp"

#include <algorithm>
#include <cmath>

namespace berm::truck_world {

std::vector<EdgePoint> edge_points(const std::array<Vector3d, 4>& corners, bool rear_wall) {
  constexpr std::array<Surface, 4> walls{Surface::wall_left, Surface::wall_rear, Surface::wall_right, Surface::wall_front};  // from corner i on
  std::vector<EdgePoint> edge;
  for (std::size_t i = 0; i < 4; ++i) {
    if (walls[i] == Surface::wall_rear && !rear_wall) continue;
    const Vector3d &from = corners[i], &to = corners[(i + 1) % 4];
    const int count = static_cast<int>(std::ceil((to - from).norm() / edge_spacing));
    for (int k = 0; k < count; ++k) edge.push_back({from + (to - from) * ((k + 0.5) / count), walls[i]});
  }
  return edge;
}

bool hides(const BoundingTree& tree, const Sweep& sweep, const Vector3d& point) {
  // A little above the edge, so that a ray that grazes the wall's own top is not stopped by rounding.
  const Vector3d target = point + Vector3d(0, 0, 0.02), from = sweep.head_seeing(target), way = target - from;
  const double length = way.norm();
  return tree.first(from, way / length, length - 0.05).has_value();
}

std::vector<bool> hidden_points(const BoundingTree& tree, const Sweep& sweep, const std::vector<EdgePoint>& edge) {
  std::vector<bool> hidden;
  hidden.reserve(edge.size());
  for (const EdgePoint& p : edge) hidden.push_back(hides(tree, sweep, p.at));
  return hidden;
}

bool every_end_in_sight(const std::vector<EdgePoint>& edge, const std::vector<bool>& hidden) {
  const auto share_of = [&](Surface wall) {
    std::size_t all = 0, unseen = 0;
    for (std::size_t i = 0; i < edge.size(); ++i)
      if (edge[i].wall == wall) ++all, unseen += hidden[i] ? 1 : 0;
    return all == 0 ? 0.0 : static_cast<double>(unseen) / static_cast<double>(all);
  };
  const auto has = [&](Surface wall) { return std::any_of(edge.begin(), edge.end(), [&](const EdgePoint& p) { return p.wall == wall; }); };
  for (const Surface wall : {Surface::wall_left, Surface::wall_rear, Surface::wall_right, Surface::wall_front})
    if (share_of(wall) > hidden_of_wall_most) return false;
  if (has(Surface::wall_rear)) return true;
  // Corners lie in order round the opening: the left side's points end at the rear, the right side's begin there.
  const auto end_seen = [&](Surface side, bool at_last) {
    double way = 0.0;
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < edge.size(); ++i)
      if (edge[i].wall == side) own.push_back(i);
    if (at_last) std::reverse(own.begin(), own.end());
    for (std::size_t k = 0; k < own.size() && way < open_end_seen; ++k) {
      if (hidden[own[k]]) return false;
      if (k + 1 < own.size()) way += (edge[own[k + 1]].at - edge[own[k]].at).norm();
    }
    return true;
  };
  return end_seen(Surface::wall_left, true) || end_seen(Surface::wall_right, false);
}

double share(const std::vector<bool>& flags) {
  return flags.empty() ? 0.0 : static_cast<double>(std::count(flags.begin(), flags.end(), true)) / static_cast<double>(flags.size());
}

std::vector<bool> points_without_return(const std::vector<app::ScanPoint>& cloud, const std::vector<EdgePoint>& edge) {
  if (edge.empty()) return {};
  Vector3d low = edge.front().at, high = low;
  for (const EdgePoint& p : edge) low = low.cwiseMin(p.at), high = high.cwiseMax(p.at);
  std::vector<Vector3d> near;
  for (const app::ScanPoint& p : cloud) {
    const Vector3d at(p.x, p.y, p.z);
    if (((at - low).array() >= -edge_reach).all() && ((high - at).array() >= -edge_reach).all()) near.push_back(at);
  }
  std::vector<bool> without;
  without.reserve(edge.size());
  for (const EdgePoint& p : edge)
    without.push_back(std::none_of(near.begin(), near.end(), [&](const Vector3d& q) { return (q - p.at).squaredNorm() <= edge_reach * edge_reach; }));
  return without;
}

}  // namespace berm::truck_world
