#include "truck_world/bounding_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace berm::truck_world {
namespace {

constexpr std::size_t leaf_triangles = 3;
constexpr int bins = 12;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double box_margin = 1e-9;   // m: rounding in the slab test never loses a triangle that lies in a face of its box
constexpr double edge_margin = 1e-9;  // of the barycentric coordinates: no gap between triangles that share an edge

double half_area(const Vector3d& size) { return size.x() * size.y() + size.y() * size.z() + size.z() * size.x(); }

}  // namespace

BoundingTree::BoundingTree(const Mesh& mesh) : mesh_(&mesh) {
  std::vector<Work> work;
  work.reserve(mesh.size());
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Triangle& t = mesh[i];
    const Box box{t.a.cwiseMin(t.b).cwiseMin(t.c).array() - box_margin, t.a.cwiseMax(t.b).cwiseMax(t.c).array() + box_margin};
    work.push_back({box, (box.low + box.high) / 2, static_cast<std::uint32_t>(i)});
  }
  nodes_.reserve(mesh.size());
  faces_.reserve(mesh.size());
  if (!work.empty()) build(work, 0, work.size());
  mesh_ = nullptr;
}

void BoundingTree::build(std::vector<Work>& work, std::size_t begin, std::size_t end) {
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  Box all{Vector3d::Constant(infinity), Vector3d::Constant(-infinity)};
  Vector3d low = all.low, high = all.high;  // of the centres
  for (std::size_t i = begin; i < end; ++i) {
    all.low = all.low.cwiseMin(work[i].box.low);
    all.high = all.high.cwiseMax(work[i].box.high);
    low = low.cwiseMin(work[i].centre);
    high = high.cwiseMax(work[i].centre);
  }
  nodes_[self].box = all;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const double extent = high[axis] - low[axis];
  if (end - begin <= leaf_triangles) {
    nodes_[self].first = static_cast<std::uint32_t>(faces_.size());
    nodes_[self].count = static_cast<std::uint32_t>(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = (*mesh_)[work[i].number];
      faces_.push_back({t.a, t.b - t.a, t.c - t.a, work[i].number});
    }
    return;
  }
  std::size_t middle = begin + (end - begin) / 2;
  const auto bin_of = [&](const Work& w) { return std::min(bins - 1, static_cast<int>((w.centre[axis] - low[axis]) / extent * bins)); };
  if (extent > 0.0) {
    std::array<Box, bins> box;
    std::array<std::size_t, bins> count{};
    box.fill({Vector3d::Constant(infinity), Vector3d::Constant(-infinity)});
    for (std::size_t i = begin; i < end; ++i) {
      const auto b = static_cast<std::size_t>(bin_of(work[i]));
      box[b].low = box[b].low.cwiseMin(work[i].box.low);
      box[b].high = box[b].high.cwiseMax(work[i].box.high);
      ++count[b];
    }
    std::array<double, bins> right_cost{};
    Box grown{Vector3d::Constant(infinity), Vector3d::Constant(-infinity)};
    std::size_t held = 0;
    for (std::size_t b = bins - 1; b > 0; --b) {
      grown = {grown.low.cwiseMin(box[b].low), grown.high.cwiseMax(box[b].high)};
      held += count[b];
      right_cost[b] = held == 0 ? 0.0 : static_cast<double>(held) * half_area(grown.high - grown.low);
    }
    grown = {Vector3d::Constant(infinity), Vector3d::Constant(-infinity)};
    held = 0;
    double best = infinity;
    int split = 0;
    for (std::size_t b = 0; b + 1 < bins; ++b) {
      grown = {grown.low.cwiseMin(box[b].low), grown.high.cwiseMax(box[b].high)};
      held += count[b];
      if (held == 0 || held == end - begin) continue;
      const double cost = static_cast<double>(held) * half_area(grown.high - grown.low) + right_cost[b + 1];
      if (cost < best) best = cost, split = static_cast<int>(b);
    }
    const auto from = work.begin() + static_cast<std::ptrdiff_t>(begin), to = work.begin() + static_cast<std::ptrdiff_t>(end);
    const auto cut = std::partition(from, to, [&](const Work& w) { return bin_of(w) <= split; });
    if (cut != from && cut != to) middle = static_cast<std::size_t>(cut - work.begin());
  }
  nodes_[self].axis = axis;
  build(work, begin, middle);
  nodes_[self].first = static_cast<std::uint32_t>(nodes_.size());
  build(work, middle, end);
}

std::optional<Hit> BoundingTree::first(const Vector3d& origin, const Vector3d& direction, double range_max) const {
  if (nodes_.empty()) return std::nullopt;
  Vector3d inverse;
  for (int k = 0; k < 3; ++k) inverse[k] = 1.0 / (std::abs(direction[k]) < 1e-200 ? 1e-200 : direction[k]);
  Hit best{range_max, std::numeric_limits<std::uint32_t>::max()};
  bool met = false;
  std::array<std::uint32_t, 128> open;  // nodes yet to visit; at() refuses a deeper tree
  std::size_t depth = 0;
  open[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[open[--depth]];
    const Vector3d enter = (node.box.low - origin).cwiseProduct(inverse), leave = (node.box.high - origin).cwiseProduct(inverse);
    const double near = std::max(enter.cwiseMin(leave).maxCoeff(), 0.0), far = enter.cwiseMax(leave).minCoeff();
    if (near > far || near > best.range) continue;
    if (node.count == 0) {
      const auto left = static_cast<std::uint32_t>(&node - nodes_.data() + 1);
      const bool left_first = direction[node.axis] >= 0.0;
      open.at(depth++) = left_first ? node.first : left;
      open.at(depth++) = left_first ? left : node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {  // Moeller and Trumbore 1997
      const Face& f = faces_[i];
      const Vector3d p = direction.cross(f.edge2);
      const double determinant = f.edge1.dot(p);
      if (determinant == 0.0) continue;
      const Vector3d s = origin - f.corner;
      const double u = s.dot(p) / determinant;
      if (u < -edge_margin || u > 1.0 + edge_margin) continue;
      const Vector3d q = s.cross(f.edge1);
      const double v = direction.dot(q) / determinant;
      if (v < -edge_margin || u + v > 1.0 + edge_margin) continue;
      const double range = f.edge2.dot(q) / determinant;
      if (range > 0.0 && (range < best.range || (met && range == best.range && f.number < best.triangle))) best = {range, f.number}, met = true;
    }
  }
  if (!met) return std::nullopt;
  return best;
}

}  // namespace berm::truck_world
