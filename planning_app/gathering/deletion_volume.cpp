#include "gathering/deletion_volume.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

// Ranges moved towards the scanner: a steep strip is uncertain in range by its slope times the deviation of the angle, at most by the step itself.
void DeletionVolume::shrink(std::span<const PolarReturn> scan, const DeletionRule& rule, std::vector<double>& out) const {
  out.resize(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    double aslant = 0.0;
    for (const std::size_t j : {i == 0 ? i : i - 1, i + 1 == scan.size() ? i : i + 1}) {
      const double gap = std::abs(scan[j].angle_rad - scan[i].angle_rad), drop = std::abs(scan[i].range_m - scan[j].range_m);
      if (j != i && gap <= rule.max_gap_rad) aslant = std::max(aslant, std::min(drop, rule.quantile * rule.along_rad * drop / gap));
    }
    out[i] = std::max(1e-3, scan[i].range_m - rule.shrink_m - std::hypot(rule.quantile * rule.range_m, aslant));
  }
}

void DeletionVolume::build(const Eigen::Isometry3d& first_frame, std::span<const PolarReturn> first, const Eigen::Isometry3d& second_frame,
                           std::span<const PolarReturn> second, const DeletionRule& rule) {
  edges_.clear();
  const double turn = Eigen::AngleAxisd(Eigen::Matrix3d(second_frame.linear() * first_frame.linear().transpose())).angle();
  if (first.empty() || second.empty() || turn > rule.max_turn_rad) return;
  origin_first_ = first_frame.translation();
  origin_second_ = second_frame.translation();
  origin_step_ = origin_second_ - origin_first_;
  x_first_ = first_frame.linear().col(0);
  y_first_ = first_frame.linear().col(1);
  normal_first_ = first_frame.linear().col(2);
  normal_second_ = second_frame.linear().col(2);
  x_step_ = second_frame.linear().col(0) - x_first_;
  y_step_ = second_frame.linear().col(1) - y_first_;
  origin_ = origin_first_ + 0.5 * origin_step_;
  normal_ = (normal_first_ + normal_second_).normalized();
  aside_ = rule.quantile * rule.across_rad;
  slab_offset_ = 1e-3 + origin_step_.norm();
  slab_slope_ = aside_ + turn;

  shrink(first, rule, range_first_);
  shrink(second, rule, range_second_);
  box_.setEmpty();
  box_.extend(origin_first_);
  box_.extend(origin_second_);
  reach_ = 0.0;
  const auto extend = [&](const Eigen::Isometry3d& frame, std::span<const PolarReturn> scan) {
    for (const PolarReturn& p : scan) {
      reach_ = std::max(reach_, p.range_m);
      box_.extend(frame * Eigen::Vector3d(p.range_m * std::cos(p.angle_rad), p.range_m * std::sin(p.angle_rad), 0.0));
    }
  };
  extend(first_frame, first);
  extend(second_frame, second);
  // Wide enough for the planes moved apart; a straight edge between two returns of the hull stays within it.
  const Eigen::Vector3d wider = Eigen::Vector3d::Constant(1e-3 + reach_ * aside_);
  box_ = Eigen::AlignedBox3d(box_.min() - wider, box_.max() + wider);

  std::size_t i = 0, j = 0;
  while (true) {
    const double across = std::max(turn, 1e-9);
    double a = range_first_[i], b = range_second_[j];
    const double pull = std::min(std::abs(a - b), rule.quantile * rule.across_rad * std::abs(a - b) / across);
    (a > b ? a : b) -= pull;
    const bool last_first = i + 1 == first.size(), last_second = j + 1 == second.size();
    Edge edge{static_cast<float>(first[i].angle_rad), static_cast<float>(second[j].angle_rad), static_cast<float>(1.0 / a),
              static_cast<float>(1.0 / b), std::abs(first[i].angle_rad - second[j].angle_rad) > rule.max_gap_rad};
    if (!edges_.empty() && edge.open) edges_.back().open = true;
    if (last_first && last_second) {
      edges_.push_back(edge);
      break;
    }
    const bool advance_first = !last_first && (last_second || first[i + 1].angle_rad <= second[j + 1].angle_rad);
    const double gap = advance_first ? first[i + 1].angle_rad - first[i].angle_rad : second[j + 1].angle_rad - second[j].angle_rad;
    edge.open = edge.open || gap > rule.max_gap_rad;
    edges_.push_back(edge);
    ++(advance_first ? i : j);
  }
}

bool DeletionVolume::contains(double x, double y, double z) const {
  if (edges_.size() < 2) return false;
  const Eigen::Vector3d p(x, y, z);
  const double to_first = normal_first_.dot(p - origin_first_), to_second = normal_second_.dot(p - origin_second_);
  const double reach = (p - origin_).squaredNorm();
  if (to_first * to_second > 0.0) {  // on one side of both planes
    const double near = std::min(std::abs(to_first), std::abs(to_second));
    if (near * near > aside_ * aside_ * reach) return false;
  }
  if (reach > (reach_ + slab_offset_) * (reach_ + slab_offset_)) return false;
  // Which share of the way from the first scan to the second; behind the axis of the turn both signs change and the share stays.
  const double span = to_first - to_second;
  const double share = std::abs(span) < 1e-9 ? 0.5 : std::clamp(to_first / span, 0.0, 1.0);
  const Eigen::Vector3d ray = p - origin_first_ - share * origin_step_;
  const double right = ray.dot(x_first_ + share * x_step_), up = ray.dot(y_first_ + share * y_step_);
  const double measured = std::atan2(up, right), range = std::hypot(up, right);
  const auto at_share = [share](float first, float second) { return static_cast<double>(first) + share * static_cast<double>(second - first); };
  const auto angle_of = [&](const Edge& e) { return at_share(e.angle_first, e.angle_second); };
  // A place on the outermost beam is within, whichever way it is rounded.
  const double lowest = angle_of(edges_.front()), highest = angle_of(edges_.back());
  if (measured < lowest - 1e-6 || measured > highest + 1e-6) return false;
  const double angle = std::clamp(measured, lowest, std::max(lowest, highest - 1e-9));
  const auto above = std::upper_bound(edges_.begin(), edges_.end(), angle, [&](double value, const Edge& e) { return value < angle_of(e); });
  if (above == edges_.begin() || above == edges_.end()) return false;
  const Edge &low = *(above - 1), &high = *above;
  if (low.open) return false;
  const auto inverse_of = [&](const Edge& e) { return at_share(e.inverse_first, e.inverse_second); };
  const double from = angle_of(low), to = angle_of(high);
  const double part = to > from ? (angle - from) / (to - from) : 0.0;
  const double inverse = inverse_of(low) + part * (inverse_of(high) - inverse_of(low));
  return range * inverse < 1.0;  // on a plane the inverse range is linear in the direction: this is the triangle
}

}  // namespace berm::app
